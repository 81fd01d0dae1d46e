// A calibration: what the guide of the box says, and the keys that it takes. The box stops the motor when no browser looks on.
import { post, read } from "/box.js";
import { keypad } from "/numbers.js";
import { act, html, useEffect, useEvery, useRef, useState } from "/ui.js";

const LOOK_MS = 250;
const TURNS = { azimuth: [["l", "◀ CCW"], ["r", "CW ▶"]], elevation: [["d", "▼ down"], ["u", "up ▲"]] };
const ANSWERS = [["y", "Yes"], ["n", "No"], ["\r", "Read here (Enter)"], ["b", "One back"], ["f", "No more points"], ["q", "Leave, save nothing"]];

/** `least`: the lowest angle of the axis. */
export function Calibrate({ axis, settings, least, moving, say, onEnd }) {
  const [told, setTold] = useState(null), [number, setNumber] = useState(""), lines = useRef(null);
  const running = told?.axis === axis;
  useEvery(LOOK_MS, () => read("calibration").then((now) => setTold((before) => (before?.axis && !now.axis && onEnd(), now))));
  const count = told?.lines.length ?? 0;
  useEffect(() => lines.current?.scrollTo(0, lines.current.scrollHeight), [count]);
  const press = (keys) => act(post("calibration/press", { keys }), say);
  const enter = (event) => {
    event.preventDefault();
    press(`${number.trim().slice(0, 10)}\r`);
    setNumber("");
  };
  const begin = () => settings.change("calibrate", { axis, stop: moving });
  if (told?.axis && !running) return html`<p>The ${told.axis} is being calibrated now.</p>`;
  return html`${count > 0 && html`<pre class="guide-lines" ref=${lines} role="log" tabindex="0" aria-label=${`What the calibration of the ${told.axis ?? "axis"} says`}>${told.lines.join("\n")}</pre>`}
    ${!running && html`<button type="button" class="go" disabled=${settings.busy !== ""} onClick=${begin}>Calibrate the ${axis}</button>
      <p class="about">The box starts anew for it: the antenna stops, programs are kept away, and the ${axis} turns by your presses alone, 2 s at most, or as far as you agree to.</p>`}
    ${running && html`<p class="prompt" role="status"><b>${told.prompt}</b></p><p class="state">${told.state}</p>
      <div class="chips" role="group" aria-label=${`Turn the ${axis}`}>${TURNS[axis].flatMap(([key, name]) => [[key, `${name} a little`], [key.toUpperCase(), `${name} 2 s`]]).map(([key, name]) => html`<button type="button" onClick=${() => press(key)}>${name}</button>`)}
        <button type="button" onClick=${() => press("s")}>Stand still</button></div>
      <form class="fields" onSubmit=${enter}><label>Degrees<input inputmode=${keypad(least)} autocomplete="off" value=${number} onInput=${(event) => setNumber(event.target.value)} /></label>
        <button type="submit">Enter the degrees</button></form>
      <div class="chips" role="group" aria-label="Answer">${ANSWERS.map(([key, name]) => html`<button type="button" onClick=${() => press(key)}>${name}</button>`)}</div>`}`;
}
