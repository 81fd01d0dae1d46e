// The sky over the station: north up, the zenith in the middle. Draws the antenna with its beam, where it shall point,
// where it has been, and all that is in the way. What flies there is drawn by overhead.js. A press tells a direction.
import { read } from "/box.js";
import { Rose } from "/rose.js";
import { degrees, html, useEffect, useMemo, useRef, useState } from "/ui.js";

const RADIUS = 100, HALF = 112, TRAIL_STEP_DEG = 0.7;
export const rad = (deg) => (deg * Math.PI) / 180, deg = (angle) => (angle * 180) / Math.PI;

/** Where an antenna at these axis angles points: on another turn, or over the top. */
export const direction = (az, el) => (el > 90 ? [(((az + 180) % 360) + 360) % 360, 180 - el] : [((az % 360) + 360) % 360, el]);

/** Where a direction is in the picture, and the way back. */
export const place = ([az, el]) => {
  const out = (RADIUS * (90 - Math.max(el, 0))) / 90;
  return [out * Math.sin(rad(az)), -out * Math.cos(rad(az))];
};
export const wayAt = ([x, y]) => [(deg(Math.atan2(x, -y)) + 360) % 360, Math.max(0, 90 - (Math.hypot(x, y) * 90) / RADIUS)];
export const clock = (text) => new Date(text).toLocaleTimeString(undefined, { hour: "2-digit", minute: "2-digit" });
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

/** A part of the sky between two azimuths and two elevations. */
function area([west, east, low, high]) {
  const ways = [], steps = Math.max(1, Math.ceil((east - west) / 4));
  for (let step = 0; step <= steps; step++) ways.push([west + ((east - west) * step) / steps, low]);
  for (let step = steps; step >= 0; step--) ways.push([west + ((east - west) * step) / steps, high]);
  return `M${ways.map(point).join("L")}Z`;
}

/** Where the antenna cannot point, as the box's mount decides. */
function useUnreached(station) {
  const [areas, setAreas] = useState([]);
  useEffect(() => {
    read("unreached").then((told) => setAreas(told.areas), () => {});
  }, [station]);
  return areas;
}

function Backdrop({ station, unreached }) {
  return html`<g>
    <defs>
      <radialGradient id="air" cx="0" cy="0" r="100" gradientUnits="userSpaceOnUse"><stop class="zenith" /><stop class="high"
        offset=".62" /><stop class="level" offset="1" /></radialGradient>
      <pattern id="hatch" width="3" height="3" patternUnits="userSpaceOnUse" patternTransform="rotate(45)"><line y2="3" class="hatch" /></pattern>
    </defs>
    <circle r="100" class="sky" />
    ${unreached.length > 0 && html`<path class="unreached" d=${unreached.map(area).join("")}><title>out of the antenna's reach</title></path>`}
    ${[30, 60].map((el) => html`<circle r=${(RADIUS * (90 - el)) / 90} class="ring" />`)}
    ${[...Array(12).keys()].map((at) => html`<line
      class="spoke" x1=${(at % 3 ? 33.3 : 0) * Math.sin(rad(30 * at))} y1=${-(at % 3 ? 33.3 : 0) * Math.cos(rad(30 * at))}
      x2=${100 * Math.sin(rad(30 * at))} y2=${-100 * Math.cos(rad(30 * at))} />`)}
    <path class="horizon" d=${horizon(station.horizon)} fill-rule="evenodd" />
    ${station.sectors.map((sector) => html`<polygon class="sector" points=${box(sector)}><title>${sector.name}</title></polygon>`)}
    <circle r="100" class="edge" />
    ${[...Array(36).keys()].map((at) => html`<line class="tick" transform=${`rotate(${at * 10})`} y1="-100" y2=${at % 3 ? -101.3 : -102.2} />`)}
    ${[...Array(12).keys()].map((at) => html`<text class=${at % 3 ? "bearing" : "compass"} x=${107 * Math.sin(rad(30 * at))}
      y=${-107 * Math.cos(rad(30 * at))}>${at % 3 ? at * 30 : "NESW"[at / 3]}</text>`)}
    ${[30, 60].map((el) => html`<text class="height" x="1.2" y=${-(RADIUS * (90 - el)) / 90 - 1.2}>${el}°</text>`)}
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

export function Sky(parts) {
  return parts.station.elevation.fitted ? html`<${Dome} ...${parts} />` : html`<${Rose} ...${parts} />`;
}

/** Units of the picture in a pixel of the screen: letters and dots keep their size in a small picture and in a large one. */
function useScale(picture) {
  const [px, setPx] = useState(0.5);
  useEffect(() => {
    const watch = new ResizeObserver(() => {
      if (!picture.current) return;
      const { width, height } = picture.current.getBoundingClientRect(), least = Math.min(width, height);
      if (least > 0) setPx((2 * HALF) / least);
    });
    watch.observe(picture.current);
    return () => watch.disconnect();
  }, []);
  return px;
}

/** A sign in the sky, in pixels of the screen. */
const Sign = ({ at, px, children }) => html`<g transform=${`translate(${point(at)}) scale(${px.toFixed(4)})`}>${children}</g>`;
const AntennaMark = ({ antenna, beamDeg, px }) => html`<g><polygon class="beam" points=${beam(antenna, beamDeg / 2)} />
  <${Sign} at=${antenna} px=${px}><path class="cross" d="M-13,0H13M0,-13V13" /><circle class="antenna" r="7" /></${Sign}></g>`;
const TargetMark = ({ target, px }) => html`<${Sign} at=${target} px=${px}><path class="target" d="M0,-13 13,0 0,13 -13,0Z" /></${Sign}>`;
const DraftMark = ({ draft, px }) => html`<${Sign} at=${draft} px=${px}><path class="draft" d="M-16,0H-5M5,0H16M0,-16V-5M0,5V16" /></${Sign}>`;
const ParkMark = ({ park, px }) => html`<${Sign} at=${parked(park)} px=${px}><g class="park"><circle r="9" /><path
  d="M-2.5,5.5 V-5.5 H1.3 A3.2,3.2 0 0 1 1.3,1.2 H-2.5" /><title>park position</title></g></${Sign}>`;

/** `flying`: draws what is up there, with the scale. `onPick`: a direction in whole degrees, where in the picture, and units in a pixel. */
function Dome({ station, now, past, path, next, draft, onPick, flying }) {
  const picture = useRef(null), px = useScale(picture), unreached = useUnreached(station);
  const backdrop = useMemo(() => html`<${Backdrop} station=${station} unreached=${unreached} />`, [station, unreached]);
  const behind = useMemo(() => html`<polyline class="trail" points=${trail(past)} />`, [past]);
  const { antenna, target } = now, follows = next && next.name !== path?.name ? next : null;
  const pick = (event) => {
    const { x, y } = new DOMPoint(event.clientX, event.clientY).matrixTransform(picture.current.getScreenCTM().inverse());
    if (Math.hypot(x, y) < 104) onPick(wayAt([x, y]).map(Math.round).map((value, axis) => (axis ? value : value % 360)), [x, y], px);
  };
  const told = `The sky. Antenna ${antenna ? `at azimuth ${degrees(antenna[0])}, elevation ${degrees(antenna[1])}` : "not known"}` +
    (target ? `; target at azimuth ${degrees(target[0])}, elevation ${degrees(target[1])}` : "; no target");
  return html`<figure class="skyview">
    <svg viewBox=${`${-HALF} ${-HALF} ${2 * HALF} ${2 * HALF}`} role="img" aria-label=${told} onClick=${pick} ref=${picture} style=${{ "--px": px }}>
      ${backdrop}${behind}
      ${follows?.points.length > 0 && html`<g class="next"><polyline points=${line(follows.points)} /><circle
        cx=${place(follows.points[0])[0]} cy=${place(follows.points[0])[1]} r="1.6" /></g>`}
      ${path && html`<polyline class="pass" points=${line(path.points)} />`}
      ${antenna && target && html`<line class="gap" x1=${place(antenna)[0]} y1=${place(antenna)[1]} x2=${place(target)[0]} y2=${place(target)[1]} />`}
      <${ParkMark} park=${station.park} px=${px} />
      ${antenna && html`<${AntennaMark} antenna=${antenna} beamDeg=${station.beam_deg} px=${px} />`}
      ${flying(px)}
      ${draft && html`<${DraftMark} draft=${draft} px=${px} />`}
      ${target && html`<${TargetMark} target=${target} px=${px} />`}
    </svg>
    <figcaption><span class="key park">park position</span>${station.sectors.length > 0 && html`<span class="key sector">forbidden</span>`}
      ${unreached.length > 0 && html`<span class="key unreached">out of reach</span>`}
      ${target && html`<span class="key target">target</span>`}
      <span class="key antenna">antenna, its beam ${station.beam_deg}°</span>
      ${path && html`<span class="key pass">${path.name}</span>`}
      ${follows && html`<span class="key next">next: ${follows.name}, ${clock(follows.aos)}</span>`}</figcaption>
  </figure>`;
}
