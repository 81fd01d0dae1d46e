// The passes that the box has flown, week by week so that wear shows; a picture and the samples of the latest to keep.
import { read } from "/box.js";
import { html, useEvery, useState } from "/ui.js";

const EVERY_MS = 15_000, DAY_MS = 86_400_000;
const time = (seconds) => new Date(seconds * 1000).toLocaleString(undefined, { dateStyle: "short", timeStyle: "short" });
const figure = (value, digits, unit) => (value == null ? "" : `${value.toFixed(digits)}${unit}`);
const sum = (passes, of) => passes.reduce((total, pass) => total + (of(pass) ?? 0), 0);

/** The Monday of a pass, by the browser's calendar. */
function monday(pass) {
  const day = new Date(pass.begin_utc_s * 1000);
  day.setHours(12, 0, 0, 0);
  return new Date(day - ((day.getDay() + 6) % 7) * DAY_MS).toLocaleDateString(undefined, { dateStyle: "medium" });
}

const off = (pass) => `off by ${pass.rms_deg.toFixed(1)}° rms, ${pass.max_deg.toFixed(1)}° at worst`;

/** What is kept of a pass, for a person to keep: the picture and its samples. */
export const Keeps = ({ file, children }) => html`<div class="chips">
  <a class="button" href=${`/api/flown/picture?file=${file}`} download=${file}>Keep the picture</a>
  <a class="button" href=${`/api/flown/table?file=${file}`} download=${file.replace(/svg$/, "csv")}>Keep the figures</a>${children}</div>`;

/** `tracked`: a change of what is tracked may mean that a pass is over. */
export function Flown({ tracked }) {
  const [{ flown, pictures }, setFlown] = useState({ flown: [], pictures: 0 }), [shown, show] = useState(null);
  useEvery(EVERY_MS, () => read("flown").then(setFlown), [tracked]);
  const weeks = [...new Set(flown.map(monday))].map((week) => [week, flown.filter((pass) => monday(pass) === week)]);
  const pictured = new Set(flown.slice(0, pictures).map((pass) => pass.file));
  return html`<section class="log flown"><h2>Passes flown</h2>
    ${!flown.length && html`<p>When the box has flown a pass that it knows, its picture is here.</p>`}
    ${flown.length > 0 && html`<table><thead><tr><th>begin</th><th>target</th><th class="more">highest</th><th>off, rms</th><th
      class="more">95 % within</th><th>motor starts</th><th class="more">motors ran</th><th>faults</th><th><span
      class="only-read">what is kept</span></th></tr></thead>
    ${weeks.map(([week, passes]) => html`<tbody key=${week}><tr class="week"><th scope="rowgroup"
      colspan="9">Week of ${week}: passes: ${passes.length}, motor starts: ${sum(passes, (pass) => pass.relay_starts)}, motors ran ${(sum(passes, (pass) => pass.motor_s) / 60).toFixed(0)} min, faults: ${sum(passes, (pass) => pass.faults?.length)}</th></tr>
      ${passes.map((pass) => html`<tr key=${pass.file}><td>${time(pass.begin_utc_s)}</td><td><b>${pass.name}</b></td><td
        class="more">${figure(pass.max_el_deg, 0, "°")}</td><td data-label="off, rms ">${figure(pass.rms_deg, 1, "°")}</td>
        <td class="more">${figure(pass.p95_deg, 1, "°")}</td><td data-label="motor starts ">${pass.relay_starts ?? ""}</td><td
          class="more">${figure(pass.motor_s, 0, " s")}</td><td class="error">${pass.faults?.join("; ")}</td>
        <td class="kept">${pictured.has(pass.file) && html`<button type="button" aria-expanded=${shown === pass.file}
          aria-label=${`Picture of ${pass.name}, ${time(pass.begin_utc_s)}`}
          onClick=${() => show(shown === pass.file ? null : pass.file)}>Picture</button>`}</td></tr>
      ${shown === pass.file && html`<tr><td class="picture" colspan="9"><img src=${`/api/flown/picture?file=${pass.file}`}
        alt=${`The sky with the path of ${pass.name} and of the antenna; below, how far the antenna was off, and each start of a motor: ${off(pass)}`} />
        <${Keeps} file=${pass.file} /></td></tr>`}`)}</tbody>`)}</table>`}</section>`;
}
