// Small drawings of what a calibration asks for: the antenna from above, or from its side for the elevation. No word in them.
import { html } from "/ui.js";

const rad = (deg) => (deg * Math.PI) / 180;
const at = (deg, radius) => [radius * Math.sin(rad(deg)), -radius * Math.cos(rad(deg))].map((value) => +value.toFixed(1));

/** Clockwise from `from` to `to`, or the other way where `to` is less. */
export function arc(from, to, radius) {
  return `M${at(from, radius)} A${radius},${radius} 0 ${Math.abs(to - from) > 180 ? 1 : 0} ${to > from ? 1 : 0} ${at(to, radius)}`;
}

const ELEMENTS = [[16, 20], [-2, 17], [-20, 15], [-36, 13]];
const YAGI = html`<g class="yagi"><path d="M0,18 V-40" />${ELEMENTS.map(([y, half]) => html`<path d=${`M${-half},${y} H${half}`} />`)}</g>`;
const BESIDE = html`<g class="yagi"><path d="M0,18 V-40" />${ELEMENTS.map(([y]) => html`<circle cy=${y} r="3.2" />`)}</g>`;

/** Per name: where the antenna points and where the arrow goes, as shares of the range from its middle; -1 is the low end. */
const VIEWS = {
  plus: { points: 0, arrow: [0.08, 0.5] }, minus: { points: 0, arrow: [-0.08, -0.5] },
  low: { points: -1, arrow: [-0.45, -0.86], stop: -1 }, high: { points: 1, arrow: [0.45, 0.86], stop: 1 },
  home: { points: -0.35, arrow: [-0.45, -0.9], stop: -1 }, between: { points: 0.3, marks: [-1, 1], asks: 0.3 },
  angle: { points: 0.3, marks: [-1, -0.5, 0, 0.5, 1], asks: 0.3 }, reading: { points: 0.3, marks: [-1, 1] }, limits: { points: 0, limits: true },
};

function Stopwatch() {
  return html`<g class="yagi"><circle r="44" /><path d="M-9,-60 H9 M0,-58 V-46 M34,-42 L40,-48" /><path class="way"
    d=${arc(0, 250, 34)} /><path d="M0,0 L18,-20" /></g>`;
}

function Written() {
  return html`<g class="yagi"><rect x="-40" y="-52" width="80" height="104" rx="8" /><path d="M-24,-30 H24 M-24,-12 H10" /><path
    class="way" d="M-20,22 L-6,36 24,4" /></g>`;
}

export function Picture({ name, axis }) {
  const beside = axis === "elevation", view = VIEWS[name];
  // From above the ends are behind the mast; from the side the low end is the horizon, on the right.
  const turn = (share) => (beside ? -90 * share : 150 * share), [low, high] = [turn(-1), turn(1)];
  const drawn = name === "times" ? html`<${Stopwatch} />` : name === "save" ? html`<${Written} />` : view && html`
    <path class="ring" d=${arc(low, high, 66)} />
    ${view.limits && html`<path class="way wide" d=${arc(turn(-0.85), turn(0.85), 66)} />`}
    ${view.marks?.map((share) => html`<circle class="mark" cx=${at(turn(share), 66)[0]} cy=${at(turn(share), 66)[1]} r="4" />`)}
    ${view.stop && html`<path class="block"
      d=${`M${at(turn(view.stop) + (beside ? -7 : 7) * view.stop, 50)} L${at(turn(view.stop) + (beside ? -7 : 7) * view.stop, 80)}`} />`}
    ${beside && html`<path class="mast" d="M0,4 V46" />`}
    <g transform=${`rotate(${turn(view.points)})`}>${beside ? BESIDE : YAGI}</g><circle class="hub" r=${beside ? 6 : 8} />
    ${view.arrow && html`<path class="way" marker-end="url(#tip)" d=${arc(turn(view.arrow[0]), turn(view.arrow[1]), 66)} />`}
    ${view.asks !== undefined && html`<text class="asked" x=${at(turn(view.asks), 82)[0]} y=${at(turn(view.asks), 82)[1] + 8}>?</text>`}`;
  return html`<svg class="picture" viewBox=${beside ? "-84 -88 168 136" : "-88 -88 176 176"} aria-hidden="true"><defs><marker
    id="tip" viewBox="0 0 10 10" refX="6" refY="5" markerWidth="4" markerHeight="4" orient="auto"><path class="tip"
    d="M0,0 L10,5 0,10Z" /></marker></defs>${drawn}</svg>`;
}
