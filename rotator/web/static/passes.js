// The sky of the next day: what to track by a press, which satellite rises when and how high, and how far its elements
// may be off.
import { boxTime, post, send } from "/box.js";
import { Elements } from "/elements.js";
import { Flown } from "/flown.js";
import { planRests, Track } from "/hand.js";
import { number, NumberField } from "/numbers.js";
import { PlanTable, usePasses } from "/plan.js";
import { Timeline } from "/timeline.js";
import { Orders } from "/orders.js";
import { act, html, useEffect, useState } from "/ui.js";

const ROWS = 12, MOST_ROWS = 100;
const BODIES = ["Sun", "Moon", "Mercury", "Venus", "Mars", "Jupiter", "Saturn"];
const STATES = { off: "The box tracks nothing.", planning: "The box plans the next pass …", tracking: "The box tracks.", refused: "The box goes on with what it tracked.", rests: "The plan is not flown now." };

function until(ms) {
  const minutes = Math.max(0, Math.round(ms / 60_000));
  return minutes < 60 ? `${minutes} min` : `${Math.floor(minutes / 60)} h ${String(minutes % 60).padStart(2, "0")} min`;
}

const clock = (at) => at.toLocaleTimeString(undefined, { hour: "2-digit", minute: "2-digit" });
const round = (deg) => (deg == null ? "" : `${Math.round(deg)}°`);

function Row({ pass, now, paired, tracked, track, beam }) {
  const rises = pass.aos && new Date(pass.aos), sets = pass.los && new Date(pass.los), up = !rises || rises <= now;
  return html`<tr class=${up ? "now" : ""}><td>${pass.name}</td>
    <td class="figure">${up ? "is up" : html`in ${until(rises - now)}`}</td>
    <td class="figure wide">${rises ? clock(rises) : ""}</td>
    <td class="figure wide">${sets ? (up ? html`${until(sets - now)} more` : until(sets - rises)) : "does not set"}</td>
    <td class="figure">${round(pass.max_el_deg)}</td>
    <td class="figure wide">${round(pass.aos_az_deg)} → ${round(pass.los_az_deg)}</td>
    <td class=${`figure ${pass.expected_error_deg > beam / 2 ? "warning" : ""}`}>
      ${pass.expected_error_deg == null ? "" : `${pass.expected_error_deg.toFixed(1)}°`}</td>
    <td>${paired && html`<button type="button" aria-pressed=${tracked} onClick=${() => track(pass.name)}
      aria-label=${`Track ${pass.name}`}>${tracked ? "tracked" : "Track"}</button>`}</td></tr>`;
}

export function Passes({ now: box, station, hello, say }) {
  const { paired } = hello, [leastDeg, setLeastDeg] = useState("10"), [now, setNow] = useState(boxTime), [rows, setRows] = useState(ROWS);
  const coming = usePasses(), { passes, waits, fault, again } = coming;
  useEffect(() => {
    const tick = setInterval(() => setNow(boxTime()), 5000);
    return () => clearInterval(tick);
  }, []);
  const track = (target) => act(post("track", { target }), say), tracks = box.status.tracks;
  const trackTable = (event) => {
    const [file] = event.target.files;
    event.target.value = "";
    if (file) act(send(`track-table?name=${encodeURIComponent(file.name)}`, file), say);
  };
  const shown = (passes ?? []).filter((pass) => pass.max_el_deg >= (number(leastDeg) ?? 0) && !(pass.los && new Date(pass.los) < now));
  return html`<div class="views"><section class="log"><h2>Track</h2>
    <p><span role="status">${tracks ? html`Tracks <b>${tracks.name}
      </b>` : STATES[box.tracking.split(":")[0]] ?? `Tracking has ${box.tracking}`}</span>
      ${tracks && html`, ${box.rise_or_set}`}</p>
    ${paired && html`<${Orders} now=${box} hello=${hello}><div class="chips" role="group" aria-label="Track">
      ${BODIES.map((name) => html`<button type="button" disabled=${!station.where} aria-pressed=${tracks?.name === name}
        onClick=${() => track(name)} aria-label=${`Track ${name}`}>${name}</button>`)}
      ${passes?.some((pass) => pass.plan) && !planRests(box) && html`<button type="button" onClick=${() => track("plan")}>Follow the plan</button>`}
      ${!/^(off|ended)/.test(box.tracking) && html`<button type="button" onClick=${() => track("off")}>Track nothing</button>`}</div>
      <${Track} now=${box} known=${station.where} say=${say} />
      <label class="file">Track a table of directions: CSV with t,az,el<input type="file" onChange=${trackTable} accept=".csv,.txt" /></label><//>`}
    </section>
    <section class="log"><${Timeline} now=${box} station=${station} hello=${hello} say=${say} coming=${coming} />
      ${passes && html`<details class=${waits ? "old" : ""}><summary>The plan as a list</summary><${PlanTable} passes=${passes} /></details>`}</section>
    <section class="log passes"><h2>Passes of the next day</h2>
    ${passes?.length > 0 && html`<p>Error: how far a satellite may be off, from the age of its elements.</p>
    <${NumberField} label="Passes that reach, in degrees" least="0" value=${leastDeg} onInput=${setLeastDeg} />`}
    <p role="status">${station.where ? fault : html`The box does not know where it stands: <a href="#setup">tell it</a>.`}</p>
    ${shown.length > 0 && html`<${Orders} now=${box} hello=${hello} quiet><table><thead><tr><th scope="col">satellite</th><th
      scope="col">rises</th><th scope="col" class="wide">at</th>
      <th scope="col" class="wide">for</th><th scope="col">highest</th><th scope="col" class="wide">from, to</th><th
        scope="col">error</th><th scope="col">track</th></tr></thead>
      <tbody>${shown.slice(0, rows).map((pass) => html`<${Row} key=${pass.name + pass.tca} pass=${pass} now=${now}
        paired=${paired} tracked=${tracks?.name === pass.name} track=${track} beam=${station.beam_deg} />`)}</tbody></table><//>`}
    ${shown.length > rows && html`<p><button type="button" onClick=${() => setRows(MOST_ROWS)}>All ${Math.min(shown.length, MOST_ROWS)} passes</button></p>`}
    ${passes !== null && !shown.length && html`<p>No pass is that high.</p>`}</section>
    <${Flown} tracked=${tracks?.name} />
    <${Elements} now=${box} paired=${paired} changed=${again} /></div>`;
}
