// The last minutes as a strip chart: the antenna and its target on one axis, and how far it is off.
import { html, useState } from "/ui.js";

const SECONDS = 600, HIGH = 100, LINES = 4, MARGIN_DEG = 3, LEAST_OFF_DEG = 5, STEPS_DEG = [1, 2, 5, 10, 15, 30, 45, 90, 180];
const AXES = { azimuth: [1, 2], elevation: [3, 4] }, OFF = 5;

/** From the bottom to the top of the chart: where an angle is, and the angles that are named. */
function scale(low, high) {
  const step = STEPS_DEG.find((each) => (high - low) / each <= LINES) ?? 180, marks = [];
  for (let at = Math.ceil(low / step) * step; at <= high; at += step) marks.push(at);
  return { y: (angle) => HIGH * (1 - (angle - low) / (high - low)), marks };
}

/** A line through one column of the rows; it breaks where nothing was known. */
function line(past, column, { y }) {
  let path = "", broken = true;
  for (const row of past) {
    if (row[column] != null) path += `${broken ? "M" : "L"}${(SECONDS + row[0]).toFixed(1)},${y(row[column]).toFixed(2)}`;
    broken = row[column] == null;
  }
  return path;
}

const Marks = ({ name, of }) => html`<div class=${name} aria-hidden="true">${of.marks.map((mark) => html`<span
  style=${{ top: `${of.y(mark)}%` }}>${mark}°</span>`)}</div>`;

export function Chart({ past, axes }) {
  const [axis, setAxis] = useState(axes[0]), columns = AXES[axis];
  const angles = past.flatMap((row) => columns.map((column) => row[column])).filter((angle) => angle != null),
    offs = past.map((row) => row[OFF] ?? 0);
  const angle = scale(Math.min(...(angles.length ? angles : [0])) - MARGIN_DEG, Math.max(...(angles.length ? angles : [0])) + MARGIN_DEG),
    off = scale(0, Math.max(LEAST_OFF_DEG, ...offs));
  const area = line(past.map((row) => [row[0], row[OFF] ?? 0]), 1, off);
  return html`<section class="chart"><div class="choice" role="group" aria-label="Axis of the chart">
      ${axes.length > 1 && axes.map((each) => html`<button type="button" aria-pressed=${axis === each} onClick=${() => setAxis(each)}>${each}</button>`)}
      <span class="key antenna">antenna</span><span class="key target">target</span><span class="key off">off target</span></div>
    <div class="plot" role="img" aria-label=${`The ${axis} of antenna and target in the last ten minutes, and how far off the antenna was`}>
      <${Marks} name="left" of=${angle} /><svg viewBox=${`0 0 ${SECONDS} ${HIGH}`} preserveAspectRatio="none" aria-hidden="true">
        ${angle.marks.map((mark) => html`<path class="grid"
          d=${`M0,${angle.y(mark)}H${SECONDS}`} />`)}${[1, 2, 3, 4].map((part) => html`<path class="grid"
          d=${`M${part * 120},0V${HIGH}`} />`)}
        ${area && html`<path class="off" d=${`${area}L${SECONDS},${HIGH}L${SECONDS + past[0][0]},${HIGH}Z`} />`}
        <path class="aim" d=${line(past, columns[1], angle)} /><path class="turned" d=${line(past, columns[0], angle)} /></svg>
          <${Marks} name="right" of=${off} />
      <p aria-hidden="true"><span>−10 min</span><span>−5 min</span><span>now</span></p></div></section>`;
}
