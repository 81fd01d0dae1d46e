// Two dials: where each axis stands on the rotor's own scale, its range with the overlap, its target, and the way it turns.
import { degrees, html, useMemo } from "/ui.js";

const rad = (deg) => (deg * Math.PI) / 180;
const at = (deg, radius) => [radius * Math.sin(rad(deg)), -radius * Math.cos(rad(deg))].map((value) => value.toFixed(2));

function arc(from, to, radius) {
  const whole = Math.min(to - from, 359.9), [x1, y1] = at(from, radius), [x2, y2] = at(from + whole, radius);
  return `M${x1},${y1} A${radius},${radius} 0 ${whole > 180 ? 1 : 0} 1 ${x2},${y2}`;
}

function Turn({ drive, names }) {
  return drive ? html`<tspan class="turning">${drive > 0 ? names[0] : names[1]}</tspan>` : null;
}

export function AzimuthDial({ range, angle, target, drive }) {
  const scale = useMemo(() => {
    const overlap = Math.max(0, range.max_deg - range.min_deg - 360);
    return html`<g>
      <path class="range" d=${arc(range.min_deg, range.max_deg - overlap, 84)} />
      ${overlap > 0 && html`<path class="overlap" d=${arc(range.min_deg + 360, range.max_deg, 95)} />`}
      ${[...Array(36).keys()].map((step) => html`<line class="tick" x1=${at(step * 10, 78)[0]} y1=${at(step * 10, 78)[1]}
        x2=${at(step * 10, step % 3 ? 75 : 71)[0]} y2=${at(step * 10, step % 3 ? 75 : 71)[1]} />`)}
      ${[0, 90, 180, 270].map((each) => html`<text class="number" x=${at(each, 60)[0]} y=${+at(each, 60)[1] + 4}>${each}</text>`)}
    </g>`;
  }, [range]);
  const over = angle != null && angle - range.min_deg > 360;
  return html`<svg class="dial" viewBox="-104 -104 208 208" role="img"
      aria-label=${`Azimuth ${degrees(angle)}${over ? ", in the overlap" : ""}, range ${range.min_deg}° to ${range.max_deg}°`}>
    ${scale}
    ${target != null && html`<path class="mark" transform=${`rotate(${target})`} d="M0,-72 5,-60 -5,-60Z" />`}
    ${angle != null && html`<g transform=${`rotate(${angle})`}><line class="needle" y1="-34" y2=${over ? -95 : -84} /><circle
      class="tip" cy=${over ? -95 : -84} r="5" /></g>`}
    <text class="what" y="-4">azimuth</text>
    <text class="turn" y="14"><${Turn} drive=${drive} names=${["CW ↻", "CCW ↺"]} />${!drive && over ? "overlap" : ""}</text>
  </svg>`;
}

export function ElevationDial({ range, angle, target, drive }) {
  const over = range.max_deg > 90;
  // The horizon is on the right, the zenith above: as one sees the antenna from its side.
  const turned = (deg) => 90 - deg;
  const scale = useMemo(() => html`<g>
    <path class="range" d=${arc(turned(range.max_deg), turned(range.min_deg), 84)} />
    ${[0, 30, 60, 90, 120, 150, 180].filter((each) => each <= Math.max(90, range.max_deg)).map((each) => html`<g>
      <line class="tick" x1=${at(turned(each), 78)[0]} y1=${at(turned(each), 78)[1]} x2=${at(turned(each), 71)[0]} y2=${at(turned(each), 71)[1]} />
      <text class="number" x=${at(turned(each), 58)[0]} y=${+at(turned(each), 58)[1] + 4}>${each}</text></g>`)}
  </g>`, [range]);
  return html`<svg class="dial" viewBox=${over ? "-104 -104 208 140" : "-30 -104 134 140"} role="img"
      aria-label=${`Elevation ${degrees(angle)}, range ${range.min_deg}° to ${range.max_deg}°`}>
    ${scale}
    ${target != null && html`<path class="mark" transform=${`rotate(${turned(target)})`} d="M0,-72 5,-60 -5,-60Z" />`}
    ${angle != null && html`<g transform=${`rotate(${turned(angle)})`}><line class="needle" y1="-34" y2="-84" /><circle class="tip" cy="-84" r="5" /></g>`}
    <text class="what" y="15">elevation</text>
    <text class="turn" y="32"><${Turn} drive=${drive} names=${["up ↑", "down ↓"]} /></text>
  </svg>`;
}
