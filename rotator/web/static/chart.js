// The last minutes as a strip chart: the antenna and its target on one axis, and how far it is off.
import { html, said, useEffect, useRef, useState } from "/ui.js";

const DARK = matchMedia("(prefers-color-scheme: dark)");
const AXES = { azimuth: [1, 2], elevation: [3, 4] };

function columns(past, axis) {
  const [angle, target] = AXES[axis];
  return [past.map((row) => row[0] / 60), past.map((row) => row[target]), past.map((row) => row[angle]), past.map((row) => row[5])];
}

export function Chart({ past, axes }) {
  const [axis, setAxis] = useState(axes[0]), [dark, setDark] = useState(DARK.matches), place = useRef(null), plot = useRef(null);
  useEffect(() => {
    const style = getComputedStyle(document.documentElement), colour = (name) => style.getPropertyValue(name).trim();
    const lines = { stroke: colour("--muted"), grid: { stroke: colour("--line"), width: 1 }, ticks: { stroke: colour("--line") }, font: "12px system-ui" };
    const made = new uPlot({
      width: place.current.clientWidth, height: 180, cursor: { show: false }, legend: { show: false },
      scales: { x: { time: false, range: [-10, 0] }, off: { range: (_, __, most) => [0, Math.max(5, most ?? 0)] }, y: { range: (_, low, high) => [(low ?? 0) - 3, (high ?? 0) + 3] } },
      axes: [{ ...lines, values: (_, at) => at.map((each) => (each ? `${each} min` : said("now"))) }, { ...lines, size: 46, values: (_, at) => at.map((each) => `${each}°`) },
        { ...lines, side: 1, scale: "off", size: 52, grid: { show: false }, values: (_, at) => at.map((each) => `${each}°`) }],
      series: [{}, { stroke: colour("--target"), width: 2, dash: [6, 4], spanGaps: false }, { stroke: colour("--antenna"), width: 2 },
        { stroke: colour("--muted"), fill: colour("--shade"), width: 1, scale: "off" }],
    }, columns(past, axis), place.current);
    plot.current = made;
    const watch = new ResizeObserver(() => place.current && made.setSize({ width: place.current.clientWidth, height: 180 }));
    watch.observe(place.current);
    return () => (watch.disconnect(), made.destroy());
  }, [axis, dark]);
  useEffect(() => {
    const change = () => setDark(DARK.matches);
    DARK.addEventListener("change", change);
    return () => DARK.removeEventListener("change", change);
  }, []);
  useEffect(() => plot.current?.setData(columns(past, axis)), [past]);
  return html`<section class="chart"><div class="choice" role="group" aria-label="Axis of the chart">
      ${axes.length > 1 && axes.map((each) => html`<button type="button" aria-pressed=${axis === each} onClick=${() => setAxis(each)}>${each}</button>`)}
      <span class="key antenna">antenna</span><span class="key target">target</span><span class="key off">off target</span></div>
    <div class="plot" ref=${place} role="img" aria-label=${`The ${axis} of antenna and target in the last ten minutes, and how far off the antenna was`}></div></section>`;
}
