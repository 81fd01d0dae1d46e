// What only a person at the antenna may order: homing, and the word that relays have been looked at. Each asks first.
import { post } from "/box.js";
import { Asks } from "/hand.js";
import { number, NumberField } from "/numbers.js";
import { act, fitted, html, useState } from "/ui.js";

/** At an end stop a motor with current stands as one without: the box cannot see whether the relay has opened. */
function Doubt({ now, axis, say }) {
  if (!now.status[axis].relays_in_doubt) return null;
  return html`<p>The box could not see whether a relay of the ${axis} has opened. Turn it the same way again for a second, away from its stop; or look at both relays:</p>
    <${Asks} label=${`Both relays of the ${axis} are open`}
      question=${`Have you seen that both relays of the ${axis} are open? A relay that sticks turns the antenna.`} yes="I have seen it"
      onYes=${() => act(post("relays-checked", { axis }), say)} />`;
}

/** Nothing but a count tells where such an axis stands: it is homed after a calibration, and when the count is doubted. */
function Homes({ now, axis, say }) {
  const state = now.status[axis];
  if (!state.homeable) return null;
  if (state.homing) return html`<p role="status">The ${axis} looks for its low end stop. STOP ends it.</p>`;
  const way = axis === "azimuth" ? "CCW" : "down";
  return html`<${Asks} label=${`Home the ${axis}`}
    question=${`The motor turns ${way} to the end stop, a little back, and there again, whatever is in its way: watch the antenna. Home the ${axis}?`} yes="Home it"
    onYes=${() => act(post("home", { axis }), say)} />`;
}

/** An axis without a sensor, or one that counts: a person reads its angle off the mast and enters it. */
function Confirms({ now, axis, say }) {
  const [angle, setAngle] = useState("");
  if (!now.status[axis].confirmable) return null;
  const confirm = (event) => {
    event.preventDefault();
    act(post("confirm", { axis, angle_deg: number(angle) }).then(() => setAngle("")), say);
  };
  return html`<details><summary>Tell the box where the ${axis} stands</summary><form class="fields" onSubmit=${confirm}>
    <${NumberField} label=${`The ${axis} stands at, in degrees`} required least=${now.status[axis].min_deg} value=${angle} onInput=${setAngle} />
    <button type="submit">It stands there</button></form></details>`;
}

export function Errands({ now, say, axes = fitted(now.status) }) {
  return axes.map((axis) => html`<${Doubt} now=${now} axis=${axis} say=${say} /><${Homes} now=${now} axis=${axis} say=${say} />
    <${Confirms} now=${now} axis=${axis} say=${say} />`);
}
