// The sky over the station: north up, the zenith in the middle. Draws the antenna with its beam, where it shall point,
// where it has been, the pass, and all that is in the way. A press tells a direction.
import { degrees, html, useMemo } from "/ui.js";

const RADIUS = 100, TRAIL_STEP_DEG = 0.7;
const rad = (deg) => (deg * Math.PI) / 180, deg = (angle) => (angle * 180) / Math.PI;

/** Where an antenna at these axis angles points: on another turn, or over the top. */
export const direction = (az, el) => (el > 90 ? [(((az + 180) % 360) + 360) % 360, 180 - el] : [((az % 360) + 360) % 360, el]);

const place = ([az, el]) => {
  const out = (RADIUS * (90 - Math.max(el, 0))) / 90;
  return [out * Math.sin(rad(az)), -out * Math.cos(rad(az))];
};
const clock = (text) => new Date(text).toLocaleTimeString(undefined, { hour: "2-digit", minute: "2-digit" });
const point = (way) => place(way).map((value) => value.toFixed(2)).join(",");
const line = (ways) => ways.map(point).join(" ");

/** The edge of the beam: every direction that is so far from the middle. */
function beam([az, el], halfDeg) {
  const ways = [];
  for (let step = 0; step <= 48; step++) {
    const turn = rad(step * 7.5), half = rad(halfDeg), up = rad(el);
    const sine = Math.sin(up) * Math.cos(half) + Math.cos(up) * Math.sin(half) * Math.cos(turn);
    const east = Math.sin(turn) * Math.sin(half) * Math.cos(up);
    const north = Math.cos(half) - Math.sin(up) * sine;
    ways.push([az + deg(Math.atan2(east, north)), deg(Math.asin(Math.max(-1, Math.min(1, sine))))]);
  }
  return line(ways);
}

function box({ azimuth: [west, east], elevation: [low, high] }) {
  const ways = [], step = Math.max(1, (east - west) / 40);
  for (let az = west; az <= east; az += step) ways.push(direction(az, low));
  ways.push(direction(east, low));
  for (let az = east; az >= west; az -= step) ways.push(direction(az, high));
  ways.push(direction(west, high));
  return line(ways);
}

/** Where the park position is drawn: inside the edge, so that it covers no letter. */
function parked([az, el]) {
  const way = direction(az, el);
  return [way[0], Math.max(way[1], 7)];
}

function horizon(points) {
  if (!points.length) return "";
  const around = [[points.at(-1)[0] - 360, points.at(-1)[1]], ...points, [points[0][0] + 360, points[0][1]]];
  const inner = [];
  for (let az = 0; az < 360; az += 2) {
    const next = around.findIndex(([at]) => at > az), [a, b] = [around[next - 1], around[next]];
    inner.push([az, a[1] + ((az - a[0]) / (b[0] - a[0] || 1)) * (b[1] - a[1])]);
  }
  return `M${line(inner)}Z M-100,0 A100,100 0 1 1 100,0 A100,100 0 1 1 -100,0Z`;
}

function Backdrop({ station }) {
  const { azimuth, elevation } = station, short = azimuth.max_deg - azimuth.min_deg < 360;
  return html`<g>
    <circle r="100" class="sky" />
    ${[30, 60].map((el) => html`<circle r=${(RADIUS * (90 - el)) / 90} class="ring" />`)}
    ${[...Array(12).keys()].map((at) => html`<line class="spoke" x1=${8 * Math.sin(rad(30 * at))} y1=${-8 * Math.cos(rad(30 * at))}
      x2=${100 * Math.sin(rad(30 * at))} y2=${-100 * Math.cos(rad(30 * at))} />`)}
    <path class="horizon" d=${horizon(station.horizon)} fill-rule="evenodd" />
    ${elevation.max_deg < 90 && html`<circle class="limit" r=${(RADIUS * (90 - elevation.max_deg)) / 90} />`}
    ${elevation.min_deg > 0 && html`<circle class="limit" r=${(RADIUS * (90 - elevation.min_deg)) / 90} />`}
    ${short && [azimuth.min_deg, azimuth.max_deg].map((az) => html`<polyline class="limit" points=${line([[az, 0], [az, 90]])} />`)}
    ${station.sectors.map((sector) => html`<polygon class="sector" points=${box(sector)}><title>${sector.name}</title></polygon>`)}
    ${[["N", 0], ["E", 90], ["S", 180], ["W", 270]].map(([name, az]) => html`<text class="compass" x=${109 * Math.sin(rad(az))}
      y=${-109 * Math.cos(rad(az)) + 4}>${name}</text>`)}
    ${[30, 60].map((el) => html`<text class="height" x="2" y=${-(RADIUS * (90 - el)) / 90 - 1.5}>${el}°</text>`)}
    <g transform=${`translate(${point(parked(station.park))})`} class="park"><title>park position</title><circle r="5" /><path d="M-1.4,3 V-3 H0.6 A1.8,1.8 0 0 1 .6,.7 H-1.4" /></g>
  </g>`;
}

function trail(past) {
  const ways = [];
  for (const [, az, , el] of past) {
    if (az === null || el === null) continue;
    const way = direction(az, el), last = ways.at(-1);
    if (!last || Math.hypot(way[0] - last[0], way[1] - last[1]) > TRAIL_STEP_DEG) ways.push(way);
  }
  return line(ways);
}

/** In place of the sky, for an antenna that turns in azimuth alone: north up. A press tells a bearing. */
function Rose({ station, now, path, draft, onPick }) {
  const { antenna, target } = now, half = station.beam_deg / 2, { min_deg: low, max_deg: high } = station.azimuth;
  const at = (az, radius) => [radius * Math.sin(rad(az)), -radius * Math.cos(rad(az))].map((value) => value.toFixed(2));
  const ray = (az, name, from = 0) => html`<line class=${name} x1=${at(az, from)[0]} y1=${at(az, from)[1]} x2=${at(az, 100)[0]} y2=${at(az, 100)[1]} />`;
  const pick = (event) => {
    const to = new DOMPoint(event.clientX, event.clientY).matrixTransform(event.currentTarget.getScreenCTM().inverse());
    if (Math.hypot(to.x, to.y) < 116) onPick([Math.round((deg(Math.atan2(to.x, -to.y)) + 360) % 360), 0]);
  };
  const told = `Compass. Antenna ${antenna ? `at ${degrees(antenna[0])}` : "not known"}${target ? `; target at ${degrees(target[0])}` : "; no target"}`;
  return html`<figure class="skyview">
    <svg viewBox="-122 -120 244 240" role="img" aria-label=${told} onClick=${pick}>
      <circle r="100" class="sky" />
      ${station.sectors.map((sector) => html`<path class="sector" d=${`M0,0 L${at(sector.azimuth[0], 100)} A100,100 0 ${sector.azimuth[1] - sector.azimuth[0] > 180 ? 1 : 0} 1 ${at(sector.azimuth[1], 100)}Z`}><title>${sector.name}</title></path>`)}
      ${[...Array(36).keys()].map((step) => ray(step * 10, "spoke", step % 3 ? 95 : 90))}
      ${[...Array(12).keys()].map((step) => html`<text class=${step % 3 ? "height" : "compass"} text-anchor="middle" x=${at(step * 30, 109)[0]} y=${+at(step * 30, 109)[1] + 4}>${step % 3 ? step * 30 : "NESW"[step / 3]}</text>`)}
      ${high - low < 360 && [low, high].map((az) => ray(az, "limit"))}
      ${path && html`<polyline class="pass" points=${path.points.map(([az]) => at(az, 92)).join(" ")} />`}
      ${antenna && html`<path class="beam" d=${`M0,0 L${at(antenna[0] - half, 100)} A100,100 0 ${half > 90 ? 1 : 0} 1 ${at(antenna[0] + half, 100)}Z`} />`}
      ${draft && ray(draft[0], "gap")}
      ${target && html`${ray(target[0], "gap")}<g transform=${`translate(${at(target[0], 84)})`}><path class="target" d="M0,-6 6,0 0,6 -6,0Z" /></g>`}
      ${antenna && html`${ray(antenna[0], "trail")}<g transform=${`translate(${at(antenna[0], 84)})`}><circle class="antenna" r="4" /></g>`}
    </svg>
    <figcaption><span class="key antenna">antenna, its beam ${station.beam_deg}°</span><span class="key target">target</span>
      ${path && html`<span class="key pass">${path.name}</span>`}</figcaption>
  </figure>`;
}

export function Sky(parts) {
  return parts.station.elevation.fitted ? html`<${Dome} ...${parts} />` : html`<${Rose} ...${parts} />`;
}

function Dome({ station, now, past, path, next, draft, onPick }) {
  const backdrop = useMemo(() => html`<${Backdrop} station=${station} />`, [station]);
  const behind = useMemo(() => html`<polyline class="trail" points=${trail(past)} />`, [past]);
  const { antenna, target } = now, follows = next && next.name !== path?.name ? next : null;
  const pick = (event) => {
    const svg = event.currentTarget, to = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
    const out = Math.hypot(to.x, to.y);
    if (out > 104) return;
    onPick([Math.round((deg(Math.atan2(to.x, -to.y)) + 360) % 360), Math.max(0, Math.round(90 - (out * 90) / RADIUS))]);
  };
  const told = `The sky. Antenna ${antenna ? `at azimuth ${degrees(antenna[0])}, elevation ${degrees(antenna[1])}` : "not known"}` +
    (target ? `; target at azimuth ${degrees(target[0])}, elevation ${degrees(target[1])}` : "; no target");
  return html`<figure class="skyview">
    <svg viewBox="-122 -120 244 240" role="img" aria-label=${told} onClick=${pick}>
      ${backdrop}${behind}
      ${follows?.points.length > 0 && html`<g class="next"><polyline points=${line(follows.points)} /><circle cx=${place(follows.points[0])[0]} cy=${place(follows.points[0])[1]} r="2.4" /></g>`}
      ${path && html`<polyline class="pass" points=${line(path.points)} />`}
      ${antenna && html`<polygon class="beam" points=${beam(antenna, station.beam_deg / 2)} />`}
      ${antenna && target && html`<line class="gap" x1=${place(antenna)[0]} y1=${place(antenna)[1]} x2=${place(target)[0]} y2=${place(target)[1]} />`}
      ${draft && html`<g transform=${`translate(${point(draft)})`}><path class="draft" d="M-8,0H-3M3,0H8M0,-8V-3M0,3V8" /></g>`}
      ${target && html`<g transform=${`translate(${point(target)})`}><path class="target" d="M0,-6 6,0 0,6 -6,0Z" /></g>`}
      ${antenna && html`<g transform=${`translate(${point(antenna)})`}><circle class="antenna" r="4" /></g>`}
    </svg>
    <figcaption><span class="key antenna">antenna, its beam ${station.beam_deg}°</span><span class="key target">target</span>
      ${path && html`<span class="key pass">${path.name}</span>`}
      ${follows && html`<span class="key next">next: ${follows.name}, ${clock(follows.aos)}</span>`}
      ${station.sectors.length > 0 && html`<span class="key sector">forbidden</span>`}<span class="key park">park position</span></figcaption>
  </figure>`;
}
