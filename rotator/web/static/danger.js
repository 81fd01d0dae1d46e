// What is wrong, in words, with what to do first, and the buttons that let it go on: only where that would help. An
// antenna that the box cannot stop fills the view in red. Knows the picture of the box. STOP is in stop.js.
import { resume } from "/box.js";
import { act, degrees, fitted, html, useEffect } from "/ui.js";

const WAYS = { azimuth: ["clockwise", "counter-clockwise"], elevation: ["up", "down"] };

const faulty = (now) => fitted(now.status).filter((axis) => now.status[axis].fault);

/** The axes that the box cannot stop, or that turn in spite of their fault. */
const runaways = (now) => faulty(now).filter((axis) => now.status[axis].fault.act_now || now.status[axis].by_itself_dps);

/** What `go-on` goes on with, as a person says it; empty: nothing. */
const before = (now) => (now.goes_on_with === "plan" ? "the plan" : now.goes_on_with);

/** Go on with what a stop, a fault or a jog has ended. Not without a person: so it is a button of its own. */
export function GoesOn({ now, say }) {
  return before(now) && html`<button type="button" class="go" onClick=${() => act(resume(now, "go-on"), say)}>Go on with ${before(now)}</button>`;
}

/** A release ends no fault whose cause is still there: then no button promises it. A stop can always be released, but
    not while the antenna runs away. */
function Releases({ now, paired, say }) {
  const faults = faulty(now), lasting = faults.filter((axis) => now.status[axis].fault_present), { tracks } = now.status;
  const helps = faults.length > lasting.length || (now.stopper && !runaways(now).some((axis) => lasting.includes(axis)));
  if (!now.stopper && now.passes) return html`<p>This ends by itself when the cause is gone.</p>`;
  return html`${lasting.map((axis) => (runaways(now).includes(axis)
    ? html`<p>The ${axis} still turns though its relays are off: it can go on when it stands.</p>`
    : html`<p>What is wrong with the ${axis} is still there: it can go on when that is gone.</p>`))}
    ${helps && html`<div class="releases">
      <button type="button" class="go" disabled=${!paired} onClick=${() => act(resume(now), say)}>
        ${now.stopper ? "Let it move again" : tracks && !tracks.recognised ? `Repaired: go on with ${tracks.name}` : "Repaired: go on"}</button>
      ${paired && (now.stopper || !tracks) && html`<${GoesOn} now=${now} say=${say} />`}</div>${!paired && html`<small>for a paired browser</small>`}`}`;
}

const stopped = (now) => now.stopper && (now.status.storm_park ? html`<p>
  <b>Storm park by ${now.stopper}.</b> It goes to the park position and stays there; nothing else moves it until a person lets it.</p>`
  : html`<p><b>Stopped by ${now.stopper}.</b> Nothing moves until a person lets it; then programs that send orders move it, too.</p>`);

function Runaway({ now, axis }) {
  const { by_itself_dps: speed, ordered_deg: ordered, fault_present } = now.status[axis];
  return html`<p class="runs"><b>${degrees(now[`${axis}_deg`])}</b>
    ${speed ? html`<span>The ${axis} turns ${WAYS[axis][speed > 0 ? 0 : 1]} at ${Math.abs(speed).toFixed(1)}° a second, and the box cannot stop it.</span>`
      : fault_present ? html`<span>The ${axis} still turns, and the box cannot stop it.</span>`
      : html`<span>The ${axis} stands. At its end it stands with current, too: the supply must be off.</span>`}
    ${ordered != null && html`<span>It was ordered to ${degrees(ordered)}.</span>`}</p>`;
}

function Emergency({ now, axes, paired, say }) {
  useEffect(() => scrollTo(0, 0), []);
  const turns = axes.some((axis) => now.status[axis].by_itself_dps || now.status[axis].fault_present);
  return html`<section class="emergency" aria-label="Emergency"><div>
    <div role="alert"><b>Act now</b><h2>${now.status[axes[0]].fault.act_now ?? now.headline}</h2></div>
    <ol><li>${turns ? "Switch the motors' supply off by hand, now." : "Make sure that the motors' supply is off."}</li>
      <li>Keep everybody away from the antenna until it stands.</li>
      <li>Then look for the cause, and repair it.</li></ol>
    ${axes.map((axis) => html`<${Runaway} now=${now} axis=${axis} />`)}
    ${faulty(now).map((axis) => html`<p class="measured">${now.status[axis].fault.text.replace(`${now.status[axis].fault.act_now} `, "")}</p>`)}
    ${stopped(now)}<${Releases} now=${now} paired=${paired} say=${say} /></div></section>`;
}

/** Stops and faults, over every view. */
export function Troubles({ now, paired, say }) {
  const axes = runaways(now), faults = faulty(now);
  if (axes.length) return html`<${Emergency} now=${now} axes=${axes} paired=${paired} say=${say} />`;
  if (!now.stopper && !faults.length) return null;
  return html`<section class="troubles" role="alert" aria-label="What is wrong">
    ${faults.map((axis) => html`<p><b>Fault:</b> ${now.status[axis].fault.text}</p>`)}
    ${stopped(now)}<${Releases} now=${now} paired=${paired} say=${say} /></section>`;
}
