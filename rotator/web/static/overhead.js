// What is up over the station, as the box computes it: dots that move along their passes, names where there is room, the
// pass of the one that a person has chosen, and the same as a list. Knows no rotor.
import { boxTime, post, read } from "/box.js";
import { trackingSaid } from "/hand.js";
import { Orders } from "/orders.js";
import { clock, place, wayAt } from "/sky.js";
import { act, html, said, useEffect, useMemo, useRef, useState, verbatim } from "/ui.js";

const EVERY_MS = 60_000, COMPUTES_MS = 1500, FAILED_MS = 15_000, NONE_MS = 2000, MOVES_MS = 200, TAIL_S = 75, ROWS = 60;
const TOUCH_PX = 22, LABEL_REM = 0.82, LINE = 1.25, EDGE = 103, POINTS = ["N", "NE", "E", "SE", "S", "SW", "W", "NW"];
// What the backdrop has written there: the heights of its two rings.
const HEIGHTS = [30, 60].map((el) => ({ textX: 4, textY: (-100 * (90 - el)) / 90 - 3, text: "00°" }));
const seconds = () => boxTime() / 1000;
const key = (one) => one.number ?? one.name;
export const isOne = (one, chosen) => chosen !== null && key(one) === chosen;
const moment = (text_s) => clock(text_s * 1000);

/** Minutes and seconds; from an hour on, hours and minutes. */
function span(s) {
  const whole = Math.max(0, Math.round(s)), two = (value) => String(value).padStart(2, "0");
  return whole < 3600 ? `${Math.floor(whole / 60)}:${two(whole % 60)} min` : `${Math.floor(whole / 3600)} h ${two(Math.floor((whole % 3600) / 60))} min`;
}

/** The sky as the box tells it, asked for again before it ends. `fault`: why there is none; both empty: it is computed. */
export function useOverhead(wanted) {
  const [told, setTold] = useState({ sky: null, fault: "" });
  useEffect(() => {
    let timer, gone = false;
    const load = () => read("sky").then((sky) => {
      if (gone) return;
      sky?.up.forEach((one) => (one.ways = one.points.map(place)));
      // One of an earlier evening is computed anew.
      const holds = sky && sky.until_s > seconds();
      if (holds) setTold({ sky, fault: "" });
      timer = setTimeout(load, !holds ? COMPUTES_MS : sky.satellites ? EVERY_MS : NONE_MS);
    }, (fault) => {
      if (gone) return;
      setTold((before) => ({ ...before, fault: fault.message }));
      timer = setTimeout(load, FAILED_MS);
    });
    if (wanted) load();
    return () => ((gone = true), clearTimeout(timer));
  }, [wanted]);
  return told;
}

/** Where it is in the picture at that time; null: it is not up. Between the box's points by a smooth curve. */
function where({ ways, from_s: from, step_s: step }, at) {
  const along = (at - from) / step, index = Math.min(Math.floor(along), ways.length - 2), part = along - index;
  if (along < 0 || along > ways.length - 1) return null;
  const [a, b, c, d] = [-1, 0, 1, 2].map((each) => ways[Math.min(Math.max(index + each, 0), ways.length - 1)]);
  return [0, 1].map((axis) => b[axis] + 0.5 * part * (c[axis] - a[axis] + part * (2 * a[axis] - 5 * b[axis] + 4 * c[axis] - d[axis] + part * (3 * (b[axis] - c[axis]) + d[axis] - a[axis]))));
}

const pen = document.createElement("canvas").getContext("2d"), widths = new Map();
pen.font = `600 100px ${getComputedStyle(document.documentElement).fontFamily}`;

/** How wide a text is, in heights of its letters. */
function width(text) {
  if (!widths.has(text)) widths.set(text, pen.measureText(text).width / 100);
  return widths.get(text);
}

const meets = (a, b) => a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3];

/** Names that touch no other, no dot that counts and nothing that is `written` there; what stands first comes first. `kept`: on which
    side each name stood. */
function labels(shown, px, kept, written) {
  const font = px * LABEL_REM * parseFloat(getComputedStyle(document.documentElement).fontSize), gap = 5 * px + 1, found = [];
  const most = Math.min(40, Math.max(8, Math.round(18 / px)));
  const around = (x, y, wide) => [x - wide / 2, y - (LINE * font) / 2, x + wide / 2, y + (LINE * font) / 2];
  const taken = written.map(({ textX, textY, text }) => around(textX, textY, width(text) * font));
  const dots = shown.filter(({ counts }) => counts).map(({ x, y }) => [x - gap / 2, y - gap / 2, x + gap / 2, y + gap / 2]);
  for (const { one, x, y, flown } of shown) {
    if (found.length === most) break;
    const wide = width(one.short) * font, high = LINE * font, off = one.rank === "body" ? gap + 5 * px : flown ? gap + 10 * px : gap;
    const sides = [["start", x + off, y], ["end", x - off, y], ["middle", x, y - off - high / 2], ["middle", x, y + off + high / 2]];
    const order = [kept.get(key(one)) ?? 0, 0, 1, 2, 3];
    const side = order.find((each) => {
      const [anchor, at, middle] = sides[each],
        here = around(anchor === "start" ? at + wide / 2 : anchor === "end" ? at - wide / 2 : at, middle, wide), [left] = here;
      const furthest = Math.hypot(Math.max(-left, left + wide), Math.max(Math.abs(here[1]), Math.abs(here[3])));
      if (furthest > EDGE || taken.some((other) => meets(here, other)) || dots.some((dot) => meets(here, dot))) return false;
      taken.push(here);
      return true;
    });
    if (side === undefined) continue;
    kept.set(key(one), side);
    found.push([one, ...sides[side]]);
  }
  return found;
}

const polyline = (ways) => ways.filter(Boolean).map((way) => way.map((value) => value.toFixed(2)).join(",")).join(" ");

/** Where a pass begins, ends and is highest, with what is written there; not where the satellite itself stands. */
function marks(one, at, px) {
  const here = where(one, at), { aos_s: rises, los_s: sets, tca_s: top } = one;
  const all = [[rises, one.ways[0], 0.93, 0], [sets, one.ways.at(-1), 0.93, 0], [top, where(one, top), 1, 11 * px]];
  return all.filter(([s, way]) => s && way && !(here && Math.hypot(way[0] - here[0], way[1] - here[1]) < 45 * px))
    .map(([s, [x, y], inwards, up]) => ({ x, y, textX: x * inwards, textY: y * inwards - up, text: s === top ? `${Math.round(one.max_el_deg)}°` : moment(s) }));
}

function Arc({ one, at, px }) {
  const { ways, from_s: from, step_s: step, aos_s: rises, los_s: sets } = one, here = where(one, at), minutes = [];
  const gone = ways.filter((_, index) => from + index * step < at), left = ways.filter((_, index) => from + index * step >= at);
  for (let s = Math.ceil((rises ?? at) / 60) * 60; sets && sets - rises < 2400 && s < sets; s += 60) minutes.push(where(one, s));
  return html`<g class="arc"><polyline class="gone" points=${polyline([...gone, here])} /><polyline points=${polyline([here, ...left])} />
    ${minutes.map((way) => way && html`<circle cx=${way[0]} cy=${way[1]} r=${1.6 * px} />`)}
    ${marks(one, at, px).map(({ x, y, textX, textY, text }) => html`<g><circle cx=${x} cy=${y} r=${3 * px} /><text class="when"
      x=${textX} y=${textY}>${text}</text></g>`)}</g>`;
}

/** All that is up, drawn for the scale of the picture. `chosen` and `tracked`: keys; `favourites`: what they track. */
export function Flying({ sky, px, chosen, tracked, favourites = [] }) {
  const kept = useRef(new Map()), tick = Math.floor(boxTime() / MOVES_MS);
  return useMemo(() => {
    if (!sky) return null;
    const at = seconds(), shown = [];
    for (const one of sky.up) {
      const way = where(one, at), mine = key(one) === chosen, flown = one.name === tracked;
      if (way) shown.push({ one, x: way[0], y: way[1], mine, flown, kept: [one.name, one.short, `${one.number}`].some((each) => favourites.includes(each.toLowerCase())) });
    }
    shown.forEach((each) => (each.counts = each.mine || each.flown || each.kept || each.one.rank !== ""));
    shown.sort((a, b) => b.mine - a.mine || b.flown - a.flown || b.kept - a.kept || b.counts - a.counts);
    const choice = sky.up.find((one) => key(one) === chosen);
    return html`<g class="flying">
      ${choice && html`<${Arc} one=${choice} at=${at} px=${px} />`}
      ${[...shown].reverse().map(({ one, x, y, mine, flown, counts }) => html`<g key=${key(one)}
        class=${`up ${one.rank || "other"} ${mine ? "mine" : ""} ${flown ? "flown" : ""}`}>
        ${one.rank === "body" ? html`<g class=${one.name.toLowerCase()}
          transform=${`translate(${x.toFixed(2)},${y.toFixed(2)})`}><circle class="glow" r=${18 * px} /><circle class="disc" r=${8 * px} /></g>`
          : html`${(counts || shown.length < 120) && html`<polyline class="tail"
            points=${polyline([3, 2, 1, 0].map((part) => where(one, at - (part * TAIL_S) / 3)))} />`}
          <circle cx=${x.toFixed(2)} cy=${y.toFixed(2)} r=${(counts ? 4.2 : 2.4) * px} />`}<title>${one.name}</title></g>`)}
      ${labels(shown, px, kept.current, [...HEIGHTS, ...(choice ? marks(choice, at, px) : [])]).map(([one, anchor, x, y]) => html`<text
        key=${`name ${key(one)}`} class=${`name ${one.rank || "other"} ${key(one) === chosen ? "mine" : ""}`}
        text-anchor=${anchor} x=${x.toFixed(2)} y=${y.toFixed(2)}>${one.short}</text>`)}
    </g>`;
  }, [tick, sky, px, chosen, tracked, favourites]);
}

/** The key of the one that a finger means: the nearest within its reach, rather one that counts. Null: a direction is meant. */
export function touched(sky, [x, y], px) {
  const at = seconds();
  const near = (sky?.up ?? []).map((one) => [one, where(one, at)]).filter(([, way]) => way)
    .map(([one, way]) => [one, Math.hypot(way[0] - x, way[1] - y) / px]).filter(([, off]) => off < TOUCH_PX);
  const [met] = near.sort(([one, off], [other, further]) => off - (one.rank ? 8 : 0) - further + (other.rank ? 8 : 0));
  return met ? key(met[0]) : null;
}

function facts(one, at) {
  const { aos_s: rises, los_s: sets, tca_s: top } = one, high = `${Math.round(one.max_el_deg)}°`;
  if (rises && at < rises) return [["AOS in", span(rises - at)], ["highest", `${high} at ${moment(top)}`], ["LOS", sets ? moment(sets) : "not today"]];
  if (sets && at > sets) return [["LOS was", moment(sets)], ["was highest", high]];
  return [["LOS in", sets ? span(sets - at) : "not today"], [at < top ? "highest in" : "was highest", at < top ? `${span(top - at)}, ${high}` : `${high} at ${moment(top)}`]];
}

/** What a person has chosen: its pass in figures, and Track. */
export function Chosen({ one, now, hello, say, onClose }) {
  const card = useRef(null), at = seconds(), way = where(one, at), [az, el] = way ? wayAt(way) : [], tracks = now.status.tracks?.name === one.name;
  useEffect(() => card.current.scrollIntoView({ block: "nearest" }), [key(one)]);
  const track = (target) => act(post("track", { target }), say), became = trackingSaid(now.tracking);
  return html`<section class="picked" ref=${card} aria-label=${one.name}><h2>${one.name}</h2>
    <button type="button" class="close quiet" aria-label=${`Close ${one.name}`} onClick=${onClose}>×</button>
    <dl>${facts(one, at).map(([name, value]) => html`<div><dt>${name}</dt><dd>${value}</dd></div>`)}
      ${way && html`<div><dt>azimuth, elevation</dt><dd>${az.toFixed(0)}° / ${el.toFixed(0)}°</dd></div>`}</dl>
    ${hello.paired ? html`<${Orders} now=${now} hello=${hello}><p>${tracks ? html`<button type="button"
      onClick=${() => track("off")}>End ${one.short}</button>` : html`<button type="button" class="go"
      onClick=${() => track(String(key(one)))}>Track<span class="only-read"> ${one.name}</span></button>`}</p><//>`
      : html`<p class="hint-line">A paired browser can track it.</p>`}
    ${became && html`<p class="hint-line">${became}</p>`}</section>`;
}

/** The same as a list: for the keyboard, for who hears the page, and to find a name. */
export function UpNow({ sky, fault, known, clockKnown, chosen, choose }) {
  const at = Math.floor(seconds());
  const rows = useMemo(() => (sky?.up ?? []).filter((one) => !(one.los_s < at)).map((one) => [one, where(one, at)])
    .sort(([one, way], [other, that]) => !way - !that || !one.rank - !other.rank || one.aos_s - other.aos_s), [sky, at]);
  const up = rows.filter(([, way]) => way).length;
  return html`<section class="upnow" aria-label="Up now"><h2>${sky ? `${up} up now` : "Up now"}</h2>
    ${!known ? html`<p>The box does not know where it stands: <a href="#setup">tell it</a>.</p>` : fault ? html`<p>${fault}
      </p>` : !sky && html`<p role="status">The box computes the sky …</p>`}
    ${sky && !sky.satellites && html`<p>${!sky.unfetched ? html`${`${sky.why_none}.`} <a
      href="#setup/8">Setup, step 8</a>` : clockKnown ? html`No satellites are known yet: <a
      href="#sky/elements">why, and how to send a file</a>` : html`${"The box has reached no time server. It fetches no elements, and tracks nothing with a real rotor, before a person says that its time is right:"} <a
      href="#setup/8">Setup, step 8</a>`}</p>`}
    <ul>${rows.slice(0, ROWS).map(([one, way]) => html`<li key=${key(one)}><button type="button"
      class=${way ? one.rank || "other" : "soon"} aria-pressed=${key(one) === chosen} onClick=${() => choose(key(one))}>
      <b>${one.short}</b><span>${way
        ? verbatim(`${Math.round(wayAt(way)[1])}° ${said(POINTS[Math.round(wayAt(way)[0] / 45) % 8])}`) : html`in ${span(one.aos_s - at)}`}
        </span></button></li>`)}</ul>
    ${rows.length > ROWS && html`<p class="hint-line">and ${rows.length - ROWS + sky.left_out} more on the sky</p>`}</section>`;
}
