// In place of the sky, for an antenna that turns in azimuth alone: a compass with north up. A press tells a bearing.
import { deg, rad } from "/sky.js";
import { degrees, html } from "/ui.js";

export function Rose({ station, now, path, draft, onPick }) {
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
      ${station.sectors.map((sector) => html`<path class="sector"
        d=${`M0,0 L${at(sector.azimuth[0], 100)} A100,100 0 ${sector.azimuth[1] - sector.azimuth[0] > 180 ? 1 : 0} 1 ${at(sector.azimuth[1], 100)}Z`}>
        <title>${sector.name}</title></path>`)}
      ${[...Array(36).keys()].map((step) => ray(step * 10, "spoke", step % 3 ? 95 : 90))}
      ${[...Array(12).keys()].map((step) => html`<text class=${step % 3 ? "height" : "compass"} text-anchor="middle"
        x=${at(step * 30, 109)[0]} y=${+at(step * 30, 109)[1] + 4}>${step % 3 ? step * 30 : "NESW"[step / 3]}</text>`)}
      ${high - low < 360 && [low, high].map((az) => ray(az, "limit"))}
      ${path && html`<polyline class="pass" points=${path.points.map(([az]) => at(az, 92)).join(" ")} />`}
      ${antenna && html`<path class="beam" d=${`M0,0 L${at(antenna[0] - half, 100)} A100,100 0 ${half > 90 ? 1 : 0} 1 ${at(antenna[0] + half, 100)}Z`} />`}
      ${draft && ray(draft[0], "gap")}
      ${target && html`${ray(target[0], "gap")}<g transform=${`translate(${at(target[0], 84)})`}><g transform="scale(.45)"><path
        class="target" d="M0,-13 13,0 0,13 -13,0Z" /></g></g>`}
      ${antenna && html`${ray(antenna[0], "trail")}<g transform=${`translate(${at(antenna[0], 84)})`}><circle class="antenna" r="4" /></g>`}
    </svg>
    <figcaption><span class="key antenna">antenna, its beam ${station.beam_deg}°</span><span class="key target">target</span>
      ${path && html`<span class="key pass">${path.name}</span>`}</figcaption>
  </figure>`;
}
