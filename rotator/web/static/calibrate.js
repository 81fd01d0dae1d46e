// A calibration: one question of the box a screen, with its buttons above STOP, its picture, and the reading as a needle.
// Where no browser asks for it, the box stops the motor. What is asked, the box says.
import { post, read } from "/box.js";
import { AzimuthDial, ElevationDial } from "/dials.js";
import { Errands } from "/errands.js";
import { Asks, JogPad } from "/hand.js";
import { number, NumberField } from "/numbers.js";
import { arc, Picture } from "/picture.js";
import { act, fitted, html, useEffect, useEvery, useRef, useState } from "/ui.js";

const LOOK_MS = 250, IDLE_MS = 1000;

/** Before it: what will happen. */
export function Begin({ axis, settings, moving }) {
  return html`<button type="button" class="go" disabled=${settings.busy !== ""}
    onClick=${() => settings.change("calibrate", { axis, stop: moving })}>Calibrate the ${axis}</button>
    <p class="about">It takes some minutes. Be where you see the antenna, and ready to cut the motors' supply: the box does not know the limits yet. It starts anew for it: the antenna stops, programs are kept away, and the ${axis} turns while you hold a button, or as far as you agree to.</p>`;
}

/** The raw reading of a sensor from the lowest to the highest, with the points that have been taken. */
function Needle({ scale: [lowest, highest], points, raw }) {
  const turn = (reading) => 180 * (Math.min(highest, Math.max(lowest, reading)) - lowest) / (highest - lowest) - 90;
  const place = (deg, radius) => [radius * Math.sin(deg * Math.PI / 180), -radius * Math.cos(deg * Math.PI / 180)].map((value) => value.toFixed(1));
  return html`<svg class="gauge" viewBox="-128 -112 256 130" aria-hidden="true"><path class="range" d=${arc(-90, 90, 78)} />
    ${[...Array(11).keys()].map((tenth) => html`<path class="tick" d=${`M${place(18 * tenth - 90, 72)} L${place(18 * tenth - 90, tenth % 5 ? 67 : 62)}`} />`)}
    ${points.map(([reading, deg]) => html`<g class="taken"><path
      d=${`M${place(turn(reading), 70)} L${place(turn(reading), 86)}`} /><text
      class=${turn(reading) < -30 ? "left" : turn(reading) > 30 ? "right" : ""} x=${place(turn(reading), 91)[0]}
      y=${+place(turn(reading), 91)[1] + 2}>${Math.round(deg)}°</text></g>`)}
    ${raw != null && html`<g class="moves" style=${{ transform: `rotate(${turn(raw)}deg)` }}><line class="needle" y2="-74" />
      </g>`}<circle class="tip" r="6" /></svg>`;
}

function Reading({ told, now }) {
  const at = told.axis === "azimuth" ? 0 : 1, raw = now.readings[at], { drive } = now.status[told.axis],
    range = { min_deg: told.scale[0], max_deg: told.scale[1] };
  if (told.runs_s != null) return html`<div class="meter"><p class="watch">${told.runs_s.toFixed(1)} s</p></div>`;
  const needle = !told.degrees ? html`<${Needle} scale=${told.scale} points=${told.points}
    raw=${raw} />` : at ? html`<${ElevationDial} range=${range} angle=${raw} drive=${drive} />` : html`<${AzimuthDial}
    range=${range} angle=${raw} drive=${drive} />`;
  return html`<div class="meter">${needle}<p class="reading">reads <b>${told.reading}</b></p></div>`;
}

function Angle({ proposed, answer }) {
  const [typed, setTyped] = useState(proposed ?? "");
  const enter = (event) => {
    event.preventDefault();
    answer(`${number(typed)}\r`);
  };
  return html`<form class="fields" onSubmit=${enter}><${NumberField} label="Degrees" required value=${typed}
    onInput=${setTyped} /><button type="submit" class="go">Take this angle</button></form>`;
}

function Asked({ told, now, station, live, answer, say, title }) {
  const { title: text, hint, picture, choices, turns, number: asksNumber, proposed } = told.question;
  return html`<h2 tabindex="-1" ref=${title}>${text}</h2>
    <div class="guide-see"><div class="sights"><${Picture} name=${picture} axis=${told.axis} /><${Reading} told=${told} now=${now} /></div>
      ${hint.map((line) => html`<p>${line}</p>`)}
      <div class="remarks" role="status">${told.remarks.map((line) => html`<p
        class=${/^Refused|cannot be saved/.test(line) || (told.fault && line.endsWith(told.fault)) ? "mistake" : ""}>${line}</p>`)}</div></div>
    <div class="guide-answers">
      ${turns && html`<${JogPad} station=${station} live=${live} axes=${[told.axis]} say=${say} />`}
      ${asksNumber && html`<${Angle} key=${told.asked} proposed=${proposed} answer=${answer} />`}
      ${choices.length > 0 && html`<div class="answers">${choices.map(({ words, keys }, at) => html`<button type="button"
        class=${at || asksNumber ? "" : "go"} onClick=${() => answer(keys)}>${words}</button>`)}</div>`}</div>`;
}

function Outcome({ latest, now, settings, onDone, say, title }) {
  const next = latest.halfway ? latest.axis : fitted(now.status).find((axis) => axis !== latest.axis && now.status[axis].missing.length > 0);
  return html`<h2 tabindex="-1" ref=${title}>
    ${latest.saved ? (latest.halfway ? "The compass has learnt the iron around it." : `The ${latest.axis} is calibrated.`) : `The ${latest.axis} is as it was before.`}</h2>
    <div class="guide-see">${latest.saved && html`<div class="sights"><${Picture} name="save" /></div>`}${latest.said.map((line) => html`<p>${line}</p>`)}
      ${latest.saved && now.status[latest.axis].missing.join() === "homing" && html`<p>One thing is left: it does not know yet where it stands.</p>
        <${Errands} now=${now} axes=${[latest.axis]} say=${say} />`}</div>
    <div class="guide-answers"><div class="answers"><button type="button" class="go" onClick=${onDone}>Done</button>
      ${latest.saved && next && html`<button type="button"
        onClick=${() => settings.change("calibrate", { axis: next, stop: now.status.moving })}>Calibrate the ${next} next</button>`}</div></div>`;
}

/** All of the screen above STOP, also while a phone's keyboard is open. */
function useSeenHeight() {
  const [seen, setSeen] = useState(visualViewport.height);
  useEffect(() => {
    const look = () => setSeen(visualViewport.height);
    visualViewport.addEventListener("resize", look);
    return () => visualViewport.removeEventListener("resize", look);
  }, []);
  return `${seen}px`;
}

/** While a calibration runs, and until what came of it has been read, it takes the whole view. */
export function Guide({ now, station, live, fresh, settings }) {
  const [told, setTold] = useState(null), [lost, lose] = useState(false), [said, say] = useState(""),
    [hurry, setHurry] = useState(0), ran = useRef(false), title = useRef(null);
  const runs = told?.axis != null, height = useSeenHeight();
  useEvery(runs ? LOOK_MS : IDLE_MS, () => read("calibration").then((here) => {
    if (told?.axis && !here.axis) settings.load();
    ran.current ||= here.axis != null;
    setTold(here);
    lose(false);
  }, () => lose(true)), [runs, hurry]);
  const asked = runs ? told.asked : told?.latest;
  useEffect(() => (title.current?.focus(), say("")), [asked]);
  if (!ran.current || !told || (!runs && !told.latest)) return null;
  const answer = (keys) => act(post("calibration/press", { keys, asked: told.asked }).then(() => setHurry((count) => count + 1)), say);
  const done = () => ((ran.current = false), setHurry(hurry + 1));
  return html`<section class="guide" style=${{ "--seen": height }} aria-label=${`Calibration of the ${told.axis ?? told.latest.axis}`}>
    <div class="guide-top"><p><b>${told.axis ?? told.latest.axis}</b>
      ${runs && told.step > 0 && html`: step ${told.step} of ${told.steps} <span>${told.stage}</span>`}</p>
      ${runs && html`<${Asks} label="Leave" question="Leave the calibration? The motor stops, and nothing of it is saved."
        yes="Leave" onYes=${() => answer("q")} />
        ${told.step > 0 && html`<progress max=${told.steps} value=${told.step} aria-label="Steps" />`}`}
      ${(lost || !fresh || said || settings.busy) && html`<p class="said" role="status">
        ${lost || !fresh ? "The box starts anew, or does not answer: the motor stands." : said || settings.busy}</p>`}</div>
    ${runs ? html`<${Asked} told=${told} now=${now} station=${station} live=${live} answer=${answer} say=${say}
      title=${title} />` : html`<${Outcome} latest=${told.latest} now=${now} settings=${settings} onDone=${done} say=${say}
      title=${title} />`}</section>`;
}
