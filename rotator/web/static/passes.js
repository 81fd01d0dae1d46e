// The sky of the next day: what to track by a press, which satellite rises when and how high, and how far its elements
// may be off.
import { boxTime, post, read, send } from "/box.js";
import { Elements } from "/elements.js";
import { Flown } from "/flown.js";
import { Track } from "/hand.js";
import { number, NumberField } from "/numbers.js";
import { Followed, PlanTable } from "/plan.js";
import { act, html, useEffect, useRef, useState } from "/ui.js";

const EVERY_MS = 600_000, COMPUTES_MS = 1500, FAILED_MS = 15_000, ROWS = 12, MOST_ROWS = 100;
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
    <td class="figure">${up ? "is up" : `in ${until(rises - now)}`}</td>
    <td class="figure wide">${rises ? clock(rises) : ""}</td>
    <td class="figure wide">${sets ? (up ? `${until(sets - now)} more` : until(sets - rises)) : "does not set"}</td>
    <td class="figure">${round(pass.max_el_deg)}</td>
    <td class="figure wide">${round(pass.aos_az_deg)} → ${round(pass.los_az_deg)}</td>
    <td class=${`figure ${pass.expected_error_deg > beam / 2 ? "warning" : ""}`}>${pass.expected_error_deg == null ? "" : `${pass.expected_error_deg.toFixed(1)}°`}</td>
    <td>${paired && html`<button type="button" aria-pressed=${tracked} onClick=${() => track(pass.name)} aria-label=${`Track ${pass.name}`}>${tracked ? "tracked" : "Track"}</button>`}</td></tr>`;
}

/** The passes, asked for again until they are computed. Null: not yet. `again` asks anew. */
function usePasses(say) {
  const [passes, setPasses] = useState(null), [waits, setWaits] = useState(true), again = useRef(() => {});
  useEffect(() => {
    let timer, gone = false;
    const load = () => {
      clearTimeout(timer);
      read("passes").then((told) => {
        if (gone) return;
        say("");
        setWaits(!told);
        if (told) setPasses(told.passes);
        timer = setTimeout(load, told ? EVERY_MS : COMPUTES_MS);
      }, (fault) => {
        if (gone) return;
        setWaits(false);
        say(fault.message);
        timer = setTimeout(load, FAILED_MS);
      });
    };
    again.current = load;
    load();
    return () => ((gone = true), clearTimeout(timer));
  }, []);
  return [passes, waits, () => again.current()];
}

export function Passes({ now: box, station, hello, say }) {
  const { paired } = hello, [leastDeg, setLeastDeg] = useState("10"), [fault, tellFault] = useState(""), [now, setNow] = useState(boxTime), [rows, setRows] = useState(ROWS);
  const [passes, waits, again] = usePasses(tellFault);
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
    <p><span role="status">${tracks ? html`Tracks <b>${tracks.name}</b>` : STATES[box.tracking.split(":")[0]] ?? `Tracking has ${box.tracking}`}</span>${tracks && html`, ${box.rise_or_set}`}</p>
    ${paired && html`<div class="chips" role="group" aria-label="Track">
      ${BODIES.map((name) => html`<button type="button" aria-pressed=${tracks?.name === name} onClick=${() => track(name)} aria-label=${`Track ${name}`}>${name}</button>`)}
      <button type="button" onClick=${() => track("plan")}>Follow the plan</button>
      <button type="button" onClick=${() => track("off")}>Track nothing</button></div>
      <${Track} now=${box} known=${station.where} say=${say} />
      <label class="file">Track a table of directions: CSV with t,az,el<input type="file" onChange=${trackTable} accept=".csv,.txt" /></label>`}
    </section>
    <section class="log"><h2>The plan</h2>
      <${Followed} hello=${hello} paired=${paired} changed=${again} say=${say} />
      ${passes && html`<div class=${waits ? "old" : ""}><${PlanTable} passes=${passes} /></div>`}
      <p role="status">${waits ? "The box computes passes and plan …" : ""}</p></section>
    <section class="log passes"><h2>Passes of the next day</h2>
    <p>Error: how far a satellite may be off, from the age of its elements.</p>
    <${NumberField} label="Passes that reach, in degrees" least="0" value=${leastDeg} onInput=${setLeastDeg} />
    <p class="said" role="status">${station.where ? fault : html`The box does not know where it stands: <a href="#setup">Setup, step 8</a>.`}</p>
    ${shown.length > 0 && html`<table><thead><tr><th scope="col">satellite</th><th scope="col">rises</th><th scope="col" class="wide">at</th>
      <th scope="col" class="wide">for</th><th scope="col">highest</th><th scope="col" class="wide">from, to</th><th scope="col">error</th><th scope="col">track</th></tr></thead>
      <tbody>${shown.slice(0, rows).map((pass) => html`<${Row} key=${pass.name + pass.tca} pass=${pass} now=${now} paired=${paired} tracked=${tracks?.name === pass.name} track=${track} beam=${station.beam_deg} />`)}</tbody></table>`}
    ${shown.length > rows && html`<p><button type="button" onClick=${() => setRows(MOST_ROWS)}>All ${Math.min(shown.length, MOST_ROWS)} passes</button></p>`}
    ${passes !== null && !shown.length && html`<p>No pass is that high.</p>`}</section>
    <${Flown} tracked=${tracks?.name} />
    <${Elements} paired=${paired} changed=${again} /></div>`;
}
