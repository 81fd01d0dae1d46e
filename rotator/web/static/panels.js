// The parts of the box as it stands: what it does, who moves it, its display, its relays, its links, what is wrong.
import { boxTime, post } from "/box.js";
import { Troubles } from "/danger.js";
import { act, degrees, fitted, html, useEffect, useState } from "/ui.js";

function minutes(text) {
  const left = Math.max(0, Math.round((new Date(text) - boxTime()) / 60_000));
  return left < 60 ? `${left} min` : `${Math.floor(left / 60)} h ${String(left % 60).padStart(2, "0")} min`;
}

/** An angle that is reckoned by time, with how far it may be off. */
function about(now, axis) {
  const { angle_source, homeable, error_deg } = now.status[axis], angle = degrees(now[`${axis}_deg`]);
  return angle_source === "modelled" && homeable ? `≈ ${angle} ± ${error_deg == null ? "?" : `${Math.ceil(error_deg)}°`}` : angle;
}

export function Headline({ now, hello, next }) {
  const { tracks, azimuth, elevation } = now.status, who = mover(now, hello);
  return html`<section class=${`headline ${now.mood}`} aria-label="What the box does">
    <div role="status"><h2>${now.headline}</h2></div>
    <dl class="angles">
      ${fitted(now.status).map((axis) => html`<div><dt>${axis}</dt><dd>${about(now, axis)}</dd>
        <dd class="to">${now[`${axis}_target_deg`] != null ? `aim ${degrees(now[`${axis}_target_deg`])}` : " "}</dd></div>`)}
    </dl>
    <p class="facts">
      ${hello.box.calibrates ? html`<span>a calibration runs: <a href="#setup">go on with it</a>
        </span>` : azimuth.missing.length + elevation.missing.length > 0 && html`<span>a new box begins with <a
        href="#setup">Setup</a></span>`}
      ${now.off_deg != null && html`<span>off by <b>${now.off_deg.toFixed(1)}°</b></span>`}
      ${tracks && html`<span>${tracks.name} <b>${now.rise_or_set}</b></span>`}
      ${next && next.name !== tracks?.name && html`<span>next ${next.name} <b>in ${minutes(next.aos)}
        </b>, ${Math.round(next.max_el_deg)}° high${next.plan?.flown ? "" : ", not in a plan"}</span>`}
      ${who && html`<span>moved by <b>${who}</b></span>`}
      ${tracks && now.starts != null && now.off_deg != null && html`<span><b>${now.starts}</b> motor starts in this pass</span>`}
    </p>
    <${Lamps} now=${now} again />
  </section>`;
}

/** Whose orders move the antenna; empty: there is no order. */
const mover = (now, hello) => (now.mover && now.status.moved_by === hello.source ? "this browser" : now.mover);

export function Control({ now, hello, paired, say }) {
  const { status } = now, mine = status.held_by === hello.source;
  const who = mover(now, hello);
  const holder = holderOf(now, hello);
  return html`<div class="control">
    <p>${who && who === holder ? html`Moved and held by <b>${who}</b>`
      : html`${who ? html`Moved by <b>${who}</b>` : "No orders"}${holder && html`, held by <b>${holder}</b>`}`}</p>
    ${paired && !mine && html`<button type="button" onClick=${() => act(post("take"), say)}>
      ${now.holder || now.mover ? `Take over from ${now.holder || who}` : "Take the antenna"}</button>`}
    ${paired && status.held_by && html`<button type="button" onClick=${() => act(post("give-back"), say)}>Give it back to the programs</button>`}
  </div>`;
}

const MODES = {
  auto: ["AUTO", (_, holder) => (holder ? `While ${holder} holds it, programs and the plan wait.` : "Programs and the plan move the antenna.")],
  manual: ["MANUAL", (who) => `Only ${who} points and turns it.`],
  jog: ["JOG", (who) => `Only buttons that ${who} holds turn it.`],
  park: ["PARK", () => "It stays where it is, and obeys nobody."],
};

/** Who has taken the antenna and not given it back; empty: nobody. */
const holderOf = (now, hello) => (now.status.held_by === hello.source ? "this browser" : now.holder);

/** A box with a mode switch of its own shows where it stands; without one the page is the switch. */
export function Mode({ now, hello, paired, say }) {
  const { panel_mode: mode, mode_by: source } = now.status, who = source === hello.source ? "this browser" : now.mode_by || "the panel";
  const told = `${MODES[mode][1](who, holderOf(now, hello))}${mode === "auto" || !source ? "" : ` Chosen by ${who}.`}`;
  if (now.mode_switch || !paired) return html`<p class="mode">Mode <b>${MODES[mode][0]}</b>: ${told}</p>`;
  return html`<div class="mode"><div class="choice" role="group" aria-label="Mode">
    ${Object.entries(MODES).map(([each, [name]]) => html`<button type="button" aria-label=${`Mode ${name}`}
      aria-pressed=${mode === each} onClick=${() => act(post("mode", { mode: each }), say)}>${name}</button>`)}</div><p>${told}</p></div>`;
}

/** Over every view, also one that is scrolled: where the antenna points, what stopped it, why an order has no effect.
    `beside`: the headline is on this view, too, and as long as it is in sight it says enough. */
export function Strip({ now, paired, fresh, beside, said, say }) {
  const [inSight, setInSight] = useState(false);
  useEffect(() => {
    if (!beside) return undefined;
    const watch = new IntersectionObserver((seen) => setInSight(seen.at(-1).isIntersecting));
    watch.observe(document.querySelector(".headline"));
    return () => watch.disconnect();
  }, [beside]);
  const wrong = now.stopper || now.status.azimuth.fault || now.status.elevation.fault, quiet = beside && !said && !wrong;
  const shown = quiet ? (inSight ? "idle" : "afloat") : "";
  return html`<section class=${`strip ${beside ? "beside" : ""} ${shown}`} aria-label="Where the antenna points" tabindex=${wrong ? 0 : null}>
    <p class=${`glance ${now.mood} ${fresh ? "" : "old"}`} aria-hidden=${beside ? "true" : null}><b>${now.headline}</b>
      <span>${fitted(now.status).map((axis) => about(now, axis)).join(" / ")}</span></p>
    <${Troubles} now=${now} paired=${paired} say=${say} />
    <p class="said" role="status">${said}</p></section>`;
}

export function Notes({ now }) {
  if (!now.notes.length) return null;
  return html`<ul class="notes" aria-label="Notes">${now.notes.map((note) => html`<li>${note}</li>`)}</ul>`;
}

const LAMPS = { azimuth: [["ccw", "CCW"], ["cw", "CW"]], elevation: [["down", "DOWN"], ["up", "UP"]] };

/** `again`: a second time, where a narrow screen shows the front of the box further down. */
function Lamps({ now, again }) {
  return html`<ul class=${`lamps ${again ? "again" : ""}`} aria-label="Relays" aria-hidden=${again ? "true" : null}>
    ${fitted(now.status).flatMap((axis) => LAMPS[axis]).map(([lamp, name]) => html`<li class=${now.lamps[lamp]}>
    <i aria-hidden="true"></i>${name}<span class="only-read"> relay ${now.lamps[lamp]}</span></li>`)}</ul>`;
}

export function Front({ now }) {
  return html`<section class="front" aria-label="The front of the box">
    <pre class="lcd" aria-label="Display">${now.lcd.join("\n")}</pre>
    <${Lamps} now=${now} /></section>`;
}

export function Links({ now, station }) {
  return html`<section class="links"><h2>Links</h2><ul>
    ${now.links.map((link) => html`<li class=${link.out ? "out" : ""}><b>${link.name}</b> <span>${link.where}</span>
      <span class="state">${link.state}</span>${link.heard && html`<code>${link.heard}</code>`}</li>`)}
    ${!now.links.length && (station.calibrates ? html`<li>a calibration runs: it keeps programs away</li>` : html`<li>The file has no [[link]]: no program can connect. <a
      href="#setup/9">Setup, step 9</a></li>`)}</ul></section>`;
}
