// Setting up: the steps from a bare box to a calibrated rotor, in one list. Each may be skipped, and done again.
import { post, read } from "/box.js";
import { Begin, Guide } from "/calibrate.js";
import { Errands } from "/errands.js";
import { Asks } from "/hand.js";
import { plain } from "/fields.js";
import { Header } from "/header.js";
import { Place } from "/place.js";
import { Missing, NoFile, Settings, ready, useChange, useSettings } from "/settings.js";
import { act, fitted, html, intoSight, useEffect, useRef, useState } from "/ui.js";

const JUST_MS = 5000, ASKS = /^(C2?|B|p|\\?get_pos|AZ EL|AI1;?|:GZ#|\?)$/i;
const RELAYS = [["cw", "azimuth CW"], ["ccw", "azimuth CCW"], ["up", "elevation up"], ["down", "elevation down"]];

/** The questions that make a new file: what an answer changes is asked anew. */
function Rotor({ settings, now }) {
  const [questions, setQuestions] = useState(null), [answers, setAnswers] = useState({}),
    { proposed, check, forget, view } = useChange(settings, now.status.moving);
  useEffect(() => {
    let late = false;
    if (ready(settings)) post("setup/questions", { answers }).then((told) => late || setQuestions(told.questions), (fault) => late || settings.lose(fault.message));
    return () => (late = true);
  }, [answers, ready(settings) && settings.file]);
  if (!questions || !ready(settings)) return html`<${Missing} settings=${settings} />`;
  const all = { ...Object.fromEntries(questions.map(({ name, answer }) => [name, answer])), ...answers };
  const set = (name, answer) => (forget(), setAnswers((before) => ({ ...before, [name]: answer })));
  return html`${questions.map(({ name, text, help, choices, open, answer: old, mistake }) => [all[name] ?? old, name, text, help, choices, open, mistake]).map(([answer, name, text, help, choices, open, mistake]) => html`<div
    class="field" key=${name}>
      <label for=${`ask-${name}`}>${text}</label>
      ${choices.length > 0 && html`<select id=${`ask-${name}`} aria-describedby=${`ask-${name}-help`}
        value=${choices.some((each) => each.answer === answer) ? answer : ""}
        onInput=${(event) => set(name, event.target.value)}>
        ${choices.map((each) => html`<option value=${each.answer}>${each.words}
          </option>`)}${open && !choices.some((each) => each.answer === answer) && html`<option value="">${answer}</option>`}</select>`}
      ${(!choices.length || (open && name !== "rotor")) && html`<input id=${choices.length ? null : `ask-${name}`}
        aria-label=${choices.length ? `${text} Another answer` : null} aria-describedby=${`ask-${name}-help`}
        placeholder=${choices.length ? "or another one" : ""}
        value=${choices.some((each) => each.answer === answer) ? "" : answer}
        onInput=${(event) => set(name, event.target.value)} />`}
      <p class="about" id=${`ask-${name}-help`}>${plain(help)}</p>${mistake && html`<p class="mistake" role="alert">${mistake}</p>`}</div>`)}
    ${view}${!proposed && html`<button type="button" class="go"
      disabled=${settings.busy !== "" || questions.some((each) => each.mistake)}
      onClick=${() => check({ answers: all })}>See the new file</button>
        ${questions.some((each) => each.mistake) && html`<p class="mistake">First mend what stands in red above.</p>`}<p
          class="about">It begins as the shipped file of that rotor, in place of the one that is there. What it says of this page stays.</p>`}`;
}

function Wiring({ settings, say }) {
  const [wiring, setWiring] = useState(null), run = settings.file?.digest;
  useEffect(() => void act(read("setup/wiring").then(setWiring), say), [run]);
  return wiring && html`<${Header} wiring=${wiring} />`;
}

function Relays({ now, hello, say }) {
  const mine = now.status.held_by === hello.source;
  return html`<p>Take the antenna first: then no program moves it. Each press closes one relay for 0.2 s. Watch the lamps of the relay board, and the motor.</p>
    ${!mine && html`<button type="button" class="go" onClick=${() => act(post("take"), say)}>Take the antenna</button>`}
    <div class="chips" role="group" aria-label="Close one relay for 0.2 s">
      ${RELAYS.filter(([, name]) => fitted(now.status).includes(name.split(" ")[0])).map(([turn, name]) => html`<button
      type="button" disabled=${!mine || now.status.moving}
      onClick=${() => act(post("pulse", { turn }), say)}>Pulse ${name} <span class=${`pulse ${now.lamps[turn]}`}>
      ${now.lamps[turn]}</span></button>`)}</div>
    ${mine && html`<button type="button" onClick=${() => act(post("give-back"), say)}>Give it back to the programs</button>`}
    <${Errands} now=${now} say=${say} />
    <p class="about">The wrong relay, or none: change its GPIO in <code>[relays]</code> below. The antenna turns the wrong way: exchange the two numbers of that axis.</p>`;
}

function Sensor({ now, axis, at }) {
  const state = now.status[axis], reading = now.readings[at];
  return html`<p class="reading">${axis}: reads <b>${reading == null ? "nothing" : reading.toFixed(4)}</b>
    ${state.angle_deg != null && html`, that is <b>${state.angle_deg.toFixed(1)}°</b>`}${state.fault && html` <span
    class="mistake">${state.fault.text}</span>`}
    ${state.missing.length > 0 && html` <span>needs ${state.missing.join(", ")}</span>`}</p>`;
}

/** A link, and whether its program has just been heard. */
function Heard({ link, program }) {
  const first = useRef(link.count), [at, setAt] = useState(0);
  useEffect(() => {
    // A box that has been started anew counts from the beginning.
    if (link.count > first.current) setAt(performance.now());
    first.current = link.count;
  }, [link.count]);
  const just = at && performance.now() - at < JUST_MS, who = program || "A program";
  const said = ASKS.test(link.heard) ? `${who} has ${just ? "just " : ""}asked for the position` : `${who} has ${just ? "just " : ""}sent`;
  return html`<li class=${just ? "just" : ""}><b>${link.name}</b> ${link.where} <span role="status">
    ${link.heard ? html`${said}: <code>${link.heard}</code>` : "nothing heard yet"}</span></li>`;
}

/** The programs with their own settings, and whether one has been heard. */
function Links({ now, say, settings }) {
  const [programs, setPrograms] = useState([]), [name, setName] = useState("");
  useEffect(() => void act(read("setup/programs").then((told) => setPrograms(told.programs)), say), []);
  const links = settings.file?.in_force?.link ?? [], one = programs.find((each) => each.name === name),
    fits = one ? links.filter((link) => one.protocols.includes(link.protocol)) : [];
  return html`<label>Your tracking program<select value=${name} onInput=${(event) => setName(event.target.value)}><option
    value="">choose it</option>${programs.map((each) => html`<option value=${each.name}>${each.name}</option>`)}</select></label>
    ${one && html`<p>Set in it: ${plain(one.settings)}.</p>
      <p>${fits.length ? html`It fits ${fits.map((link) => html`<code>${link.protocol} ${place(link)}
        </code> `)}` : html`It needs a link with <code>${one.protocols.join(" or ")}</code>
        ${one.where && html`, ${plain(one.where)}`}: one more <code>[[link]]</code> in all settings.`}</p>`}
    <h3>Is it heard?</h3><p>Let the program ask for the position, or send one, and watch its line here.</p>
    <ul class="heard">${now.links.map((link) => html`<${Heard} key=${link.name + link.where} link=${link}
      program=${fits.some((each) => each.protocol === link.protocol) ? one.name : ""} />`)}</ul>`;
}

function place({ tcp, udp, serial, baud, pty }) {
  return serial ? `${serial}, ${baud ?? 9600} baud` : pty ? `${pty} on the box itself` : (tcp ?? udp ?? "").replace("0.0.0.0", location.hostname);
}

function Network({ settings, now, say }) {
  const { file, busy } = settings, [allow, setAllow] = useState(null),
    { proposed, check, forget, view } = useChange(settings, now.status.moving), [offered, setOffered] = useState([]);
  useEffect(() => void act(post("setup/questions", { answers: {} }).then(({ questions }) => setOffered((questions.find((each) => each.name === "network")?.choices ?? []).map((each) => each.answer).filter((each) => each !== "here"))), say), []);
  const wanted = allow ?? offered[0] ?? "";
  const open = (file?.in_force?.link ?? []).filter((link) => link.protocol === "rotctld" && /^(0\.0\.0\.0|\[?::\]?):/.test(link.tcp ?? ""));
  return html`<p>${open.length ? html`rotctld is open: <code>${place(open[0])}
    </code>, for ${(open[0].allow ?? ["every machine"]).join(", ")}. Test it there: <code>rotctl -m 2 -r ${place(open[0])} p</code>, and watch “Is it heard?” above.` : "Programs of other computers do not reach rotctld now."}</p>
    <p>There is no password: every program that reaches it turns the antenna.</p>
    <label>The network that may turn it<input value=${wanted} placeholder="192.168.1.0/24"
      onInput=${(event) => (forget(), setAllow(event.target.value))} /></label>
    ${view}${!proposed && html`<button type="button" class="go" disabled=${!wanted || busy !== ""}
      onClick=${() => check({ open_to: wanted })}>Open it to ${wanted || "this network"}</button>`}`;
}

function Clock({ now, say }) {
  const [off, setOff] = useState(null);
  useEffect(() => void fetch("/api/me").then((answer) => setOff((new Date(answer.headers.get("Date")) - Date.now()) / 1000), () => {}), []);
  return html`${off != null && html`<p>${Math.abs(off) < 3 ? "The clocks of the box and of this browser agree." : html`<b
    class="mistake">The box's clock is ${Math.abs(Math.round(off))} s ${off > 0 ? "ahead of" : "behind"} this browser's.</b> One of them is wrong: satellites need the right time.`}</p>`}
    ${!now.clock_known && html`<p>The box has reached no time server. It fetches no elements, and tracks nothing with a real rotor, before a person says that its time is right:</p>
    <${Asks} label="The time of the box is right"
      question="Is the time of the box right, to a second? A satellite is elsewhere a second later." yes="It is right"
      onYes=${() => act(post("clock-is-right"), say)} />`}`;
}

/** `#setup/8` opens step 8. */
function Step({ number, title, done, children }) {
  const named = location.hash === `#setup/${number}`, [shown, show] = useState(named);
  useEffect(() => void (named && show(true)), [named]);
  return html`<details class="step" open=${shown} onToggle=${(event) => show(event.currentTarget.open)}><summary><b>
    ${number}. ${title}</b> <small>${done}</small></summary>${shown && html`<div>${children}</div>`}</details>`;
}

export function Setup({ now, hello, station, live, fresh, say }) {
  const settings = useSettings(say, hello);
  const { file } = settings, made = ready(settings), of = { settings, now, say }, moving = now.status.moving,
    needs = (axis) => now.status[axis].missing;
  const calibrated = (axis) => !now.status[axis].fitted ? "not fitted" : (needs(axis).length ? `needs ${needs(axis).join(", ")}` : "done");
  const missing = html`<${Missing} settings=${settings} />`, known = station.where !== null, begins = useRef(!known).current,
    asksTime = begins && known && !now.clock_known;
  const step = location.hash.split("/")[1];
  // What stands above it grows when the settings come.
  useEffect(() => void (made && step && intoSight(document.querySelector(`.step:nth-of-type(${step})`))), [made, step]);
  const placed = made && html`<${Place} ...${of} known=${known} />`;
  const some = (tables, keys) => html`<${Settings} ...${of} only=${tables} keys=${keys} />`;
  return html`<${Guide} now=${now} station=${station} live=${live} fresh=${fresh} settings=${settings} /><div class="setup">
    <h2>Setup</h2><p>From top to bottom for a new box; each step may be left out, and done again.${settings.busy && html` <b
    role="status">${settings.busy}</b>`}</p>
    <${NoFile} settings=${settings} moving=${moving} />
    ${begins && made && html`<section class="begin"><h3>Begin here: place and satellites</h3>
      ${placed}${asksTime && html`<${Clock} now=${now} say=${say} />`}</section>`}
    <${Step} number="1" title="Which rotor" done=${file?.values.rotor?.type}><${Rotor} ...${of} /><//>
    <${Step} number="2" title="Wiring" done=${file?.values.rotor?.hardware === "pi" ? "on this Pi" : "simulated"}><${Wiring}
      settings=${settings} say=${say} /><//>
    <${Step} number="3" title="Try each relay"><${Relays} now=${now} hello=${hello} say=${say} />${some(["relays"])}<//>
    <${Step} number="4" title="Read the sensors">${fitted(now.status).map((axis) => html`<${Sensor} now=${now} axis=${axis}
      at=${axis === "azimuth" ? 0 : 1} />`)}
      <p class="about">Turn the rotor by hand or by its own box: the reading follows smoothly, and stands with it.</p>
        ${some(["azimuth.sensor", "elevation.sensor", "adc"])}<//>
    ${["azimuth", "elevation"].map((axis, at) => html`<${Step} number=${5 + at} title=${`Calibrate the ${axis}`}
      done=${calibrated(axis)}>${!now.status[axis].fitted ? html`<p>This rotor has no ${axis}.</p>`
      : html`${made ? html`<${Begin} axis=${axis} settings=${settings} moving=${moving} />` : missing}<${Errands} now=${now}
        axes=${[axis]} say=${say} />`}<//>`)}
    <${Step} number="7" title="Limits">
      ${some(["azimuth", "elevation", "mount", "mount.forbidden"], ["endless", "min_deg", "max_deg", "park_azimuth_deg", "park_elevation_deg", "flip", "horizon", "name", "azimuth_deg", "elevation_deg"])}<//>
    <${Step} number="8" title="Place and time" done=${file?.values.station?.locator ?? (file?.values.station ? "set" : "")}>
      ${!begins && placed}${!asksTime && html`<${Clock} now=${now} say=${say} />`}${some(["station", "sky", "sky.follow"])}<//>
    <${Step} number="9" title="Your tracking program"><${Links} ...${of} /><//>
    <${Step} number="10" title="Open it to the network">${made ? html`<${Network} ...${of} />` : missing}<//>
    <${Step} number="11" title="All settings"><${Settings} ...${of} /><//><p><a href="#paired">Paired browsers and programs</a></p></div>`;
}
