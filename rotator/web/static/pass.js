// Pass mode: a phone in the hand of a person at the antenna. One look tells where the antenna, the target and the phone
// point, and how long it lasts; a thumb nudges while tracking stays on. What the browser does not give it says itself.
import { boxTime, post, read } from "/box.js";
import { hindrance } from "/orders.js";
import { act, degrees, fitted, html, said, useEffect, useEvery, useRef, useState, verbatim } from "/ui.js";

const STEP_DEG = 1, MOST_DEG = 20, NO_EVENT_MS = 3000, NEXT_MS = 10_000, SHOWN_MS = 600, UPRIGHT_DEG = 50;
const LOOKS = [["bright", "Sun"], ["dark", "Dark"], ["red", "Night"]];
const COMPASS = {
  own: "Up is where the phone points, by its own compass: magnetic north, and iron near it turns it.",
  ask: "North is up.",
  looks: "North is up. The phone's own compass is looked for …",
  https: "North is up: the phone's own compass needs HTTPS.",
  none: "North is up: this device has no compass, or does not tell.",
  refused: "North is up: the compass is not allowed. Allow it for this page in the browser's settings.",
};
const SCREEN = {
  on: "The screen stays on while this view is open.",
  https: "The screen may go dark: keeping it on needs HTTPS.",
  cannot: "The screen may go dark: this browser cannot keep it on.",
  refused: "The screen may go dark: the phone refuses to keep it on, as where it saves its battery.",
};
const rad = (deg) => (deg * Math.PI) / 180, deg = (angle) => (angle * 180) / Math.PI, around = (angle) => ((angle % 360) + 360) % 360;

function kept(name, other) {
  try {
    return localStorage.getItem(name) ?? other;
  } catch {
    return other;
  }
}

/** Where the phone points, [azimuth, elevation]: with its upper edge where it lies flat, with its back where it is held up.
    Null: this event does not tell. `turned`: by how much the picture is turned on the phone. */
function phonePoints({ alpha, beta, gamma, absolute, webkitCompassHeading: heading }, turned = 0) {
  if (beta == null || gamma == null) return null;
  // Safari tells the heading of the upper edge, and alpha from anywhere.
  if (heading != null) return [around(heading + turned), beta > UPRIGHT_DEG ? beta - 90 : beta];
  if (alpha == null || !absolute) return null;
  const [sa, sb, sg] = [alpha, beta, gamma].map((each) => Math.sin(rad(each))),
    [ca, cb, cg] = [alpha, beta, gamma].map((each) => Math.cos(rad(each)));
  const right = [ca * cg - sa * sb * sg, sa * cg + ca * sb * sg, -cb * sg], top = [-sa * cb, ca * cb, sb];
  const edge = top.map((each, axis) => each * Math.cos(rad(turned)) + right[axis] * Math.sin(rad(turned)));
  const back = [-(ca * sg + sa * sb * cg), -(sa * sg - ca * sb * cg), -cb * cg];
  const [east, north, up] = deg(Math.asin(Math.max(-1, Math.min(1, edge[2])))) > UPRIGHT_DEG ? back : edge;
  return [around(deg(Math.atan2(east, north))), deg(Math.asin(Math.max(-1, Math.min(1, up))))];
}

/** The phone's compass: where it points; a key of `COMPASS`; and what a press has to ask for on an iPhone. */
function useCompass() {
  const [points, setPoints] = useState(null), asks = typeof globalThis.DeviceOrientationEvent?.requestPermission === "function";
  const [state, setState] = useState(!matchMedia("(pointer: coarse)").matches ? "none" : !isSecureContext ? "https" : asks ? "ask" : "looks");
  useEffect(() => {
    // Some browsers tell without being asked.
    const hear = (event) => {
      const found = phonePoints(event, screen.orientation?.angle ?? 0);
      if (!found) return;
      setState("own");
      setPoints(found.map(Math.round));
    };
    const names = ["deviceorientationabsolute", "deviceorientation"];
    names.forEach((name) => addEventListener(name, hear));
    return () => names.forEach((name) => removeEventListener(name, hear));
  }, []);
  useEffect(() => {
    if (state !== "looks") return undefined;
    const none = setTimeout(() => setState("none"), NO_EVENT_MS);
    return () => clearTimeout(none);
  }, [state]);
  const ask = async () => setState((await DeviceOrientationEvent.requestPermission().catch(() => "")) === "granted" ? "looks" : "refused");
  return { points, state, ask };
}

/** The screen stays on as long as this view is open. Returns a key of `SCREEN`; empty: not known yet. */
function useAwake() {
  const [state, setState] = useState(!isSecureContext ? "https" : navigator.wakeLock ? "" : "cannot");
  useEffect(() => {
    if (!navigator.wakeLock) return undefined;
    let lock = null, gone = false;
    // The browser lets the screen sleep when another page is looked at, and needs to be asked again.
    const hold = async () => {
      if (document.hidden) return;
      lock = await navigator.wakeLock.request("screen").catch(() => null);
      if (gone) lock?.release();
      else setState(lock ? "on" : "refused");
    };
    hold();
    document.addEventListener("visibilitychange", hold);
    return () => ((gone = true), document.removeEventListener("visibilitychange", hold), lock?.release());
  }, []);
  return state;
}

const at = (az, radius) => [radius * Math.sin(rad(az)), -radius * Math.cos(rad(az))].map((value) => value.toFixed(2));

/** Where the phone tells where it points, up is that way: the needles then point as the antenna really does. */
function Compass({ now, beamDeg, phone }) {
  const { antenna, target } = now, up = phone ? phone[0] : 0, half = Math.min(beamDeg, 179) / 2;
  const told = [`Antenna ${antenna ? `at ${degrees(antenna[0], 0)}` : "not known"}`, target ? `target at ${degrees(target[0], 0)}` : "no target", phone && `the phone at ${degrees(phone[0], 0)}`];
  return html`<svg viewBox="-122 -122 244 244" role="img" aria-label=${`Compass. ${told.filter(Boolean).join("; ")}`}>
    <g transform=${`rotate(${-up})`}>
      <circle r="100" class="rim" />
      ${[...Array(36).keys()].map((step) => html`<line
        class="tick" x1=${at(step * 10, step % 3 ? 94 : 88)[0]} y1=${at(step * 10, step % 3 ? 94 : 88)[1]} x2=${at(step * 10, 100)[0]} y2=${at(step * 10, 100)[1]} />`)}
      ${[..."NESW"].map((name, quarter) => html`<g transform=${`translate(${at(quarter * 90, 111)}) rotate(${up})`}><text
        class="letter" y="5">${name}</text></g>`)}
      ${antenna && html`<path class="beam" d=${`M0,0 L${at(antenna[0] - half, 88)} A88,88 0 0 1 ${at(antenna[0] + half, 88)}Z`} />
        <g transform=${`rotate(${antenna[0]})`}><line class="needle" y2="-84" /><circle class="antenna" cy="-84" r="7" /></g>`}
      ${target && html`<g transform=${`rotate(${target[0]})`}><path class="target" d="M0,-100 11,-80 0,-60 -11,-80Z" /></g>`}
    </g>
    ${phone && html`<path class="phone" d="M0,-120 9,-102 -9,-102Z" />`}
  </svg>`;
}

/** By how much the target in force is shifted, and the buttons that shift it. The box keeps the sum, not this page. */
function Nudge({ now, paired, say }) {
  const { status } = now, shift = { azimuth: status.nudge_azimuth_deg, elevation: status.nudge_elevation_deg };
  const sent = useRef({}), axes = fitted(status), names = { azimuth: ["◀", "CCW", "▶", "CW"], elevation: ["▼", "down", "▲", "up"] };
  const set = (axis, offset) => {
    sent.current[axis] = [performance.now(), offset];
    act(post("nudge", { axis, offset_deg: offset }), say);
  };
  // A quick thumb presses again before the next picture shows the press before.
  const step = (axis, by) => {
    const [ms, latest] = sent.current[axis] ?? [-SHOWN_MS, 0], from = performance.now() - ms < SHOWN_MS ? latest : shift[axis];
    set(axis, Math.max(-MOST_DEG, Math.min(MOST_DEG, from + by)));
  };
  const signed = (angle) => `${angle > 0 ? "+" : angle < 0 ? "−" : ""}${Math.abs(angle)}°`;
  const idle = status.wanted_azimuth_deg == null && status.wanted_elevation_deg == null;
  const press = (axis, by, [arrow, name]) => html`<button type="button" disabled=${!paired || idle} aria-label=${`Nudge ${axis} by ${STEP_DEG}° ${name}`}
    onClick=${() => step(axis, by)}>${arrow}<small>${STEP_DEG}°</small></button>`;
  return html`<section class="nudge" aria-label="Nudge">
    ${axes.map((axis) => html`<div>${press(axis, -STEP_DEG, names[axis])}<p class=${shift[axis] ? "set" : ""}><small>${axis}
      </small><b>${signed(shift[axis])}</b></p>
      ${press(axis, STEP_DEG, names[axis].slice(2))}</div>`)}
    ${axes.some((axis) => shift[axis]) ? html`<button type="button" onClick=${() => axes.forEach((axis) => shift[axis] && set(axis, 0))}>End the nudge</button>`
      : html`<p>${!paired ? html`Only a paired browser can nudge: <a
        href="#">pair this one</a>.` : idle ? "Nothing is tracked, so there is nothing to nudge." : "A nudge rides on the tracking, and ends with the pass."}</p>`}
  </section>`;
}

/** What is tracked, or comes next, and the time until it rises or sets. */
function until(now, next) {
  const { tracks } = now.status;
  if (tracks) return [tracks.name, now.rise_or_set];
  if (!next?.name) return ["Nothing is tracked", ""];
  const left = Math.max(0, Math.round((new Date(next.aos) - boxTime()) / 1000)), minutes = Math.floor(left / 60),
    two = (count) => String(count).padStart(2, "0");
  return [verbatim(`${said("next")}: ${next.name}`), minutes < 60 ? `AOS ${minutes}:${two(left % 60)}` : `AOS ${Math.floor(minutes / 60)}h${two(minutes % 60)}`];
}

export function PassMode({ now, station, hello, fresh, say }) {
  const [look, setLook] = useState(() => kept("pass-look", matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "bright")),
    [next, setNext] = useState(null);
  useEvery(NEXT_MS, async () => document.hidden || setNext(await read("next")));
  const compass = useCompass(), awake = useAwake(), [name, told] = until(now, next), [time, ...more] = told.split(", "), phone = compass.points;
  const choose = (each) => {
    setLook(each);
    try {
      localStorage.setItem("pass-look", each);
    } catch { /* It counts until the page is left. */ }
  };
  const way = (where) => (where ? fitted(station).map((axis) => degrees(where[axis === "azimuth" ? 0 : 1], 0)).join(" / ") : "---");
  return html`<main class=${`passmode ${look}`}>
    <div class="bar"><a href="#">Leave</a>
      ${now.status.simulated && html`<strong class="sim">SIM</strong>`}
      <div class="choice" role="group" aria-label="Light">${LOOKS.map(([each, label]) => html`<button type="button"
        aria-pressed=${look === each} onClick=${() => choose(each)}>${label}</button>`)}</div></div>
    <div class="until"><h1>${name}</h1><b>${time}</b>${more.length > 0 && html`<small>${more.join(", ")}</small>`}
      ${hello.paired && !now.status.tracks && next?.name && hindrance(now, hello) === "" && html`<button type="button"
        class="go" onClick=${() => act(post("track", { target: next.name }), say)}>Track ${next.name}</button>`}</div>
    <${Compass} now=${now} beamDeg=${station.beam_deg} phone=${phone} />
    <dl class=${fresh ? "" : "old"}><div class="of-antenna"><dt>antenna</dt><dd>${way(now.antenna)}</dd></div><div
      class="of-target"><dt>target</dt><dd>${way(now.target)}</dd></div>
      <div><dt>off by</dt><dd>${now.off_deg == null ? "---" : degrees(now.off_deg)}</dd></div>
      ${phone && html`<div><dt>phone</dt><dd>${way(phone)}</dd></div>`}</dl>
    <${Nudge} now=${now} paired=${hello.paired} say=${say} />
    <ul class="gives">
      ${!fresh && html`<li class="lost">No connection to the box: this picture is old.</li>`}
      <li>${COMPASS[compass.state]} ${compass.state === "ask" && html`<button type="button" onClick=${compass.ask}>Use the phone's compass</button>`}</li>
      ${awake && html`<li>${SCREEN[awake]}</li>`}
      ${!isSecureContext && html`<li>How the page gets HTTPS is in the documents, under “HTTPS for the page”.</li>`}
    </ul>
  </main>`;
}
