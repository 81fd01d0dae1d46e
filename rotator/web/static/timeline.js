// The next 24 hours as broadcasters show theirs: a row for each satellite, a bar for each pass, filled where the antenna
// flies it. Rows are dragged by a finger or a mouse, or moved by the arrow keys: what stands further up counts more.
import { boxTime, post } from "/box.js";
import { drag, keyed, moved } from "/drag.js";
import { keep } from "/favourites.js";
import { clock, how, useFollowed, usePasses } from "/plan.js";
import { Orders } from "/orders.js";
import { act, html, intoSight, useEffect, useMemo, useRef, useState } from "/ui.js";

const HOUR_MS = 3_600_000, HOURS = 25, LOOK_MS = 600_000, LEAST_DEG = 10, OTHERS = 8;
const rad = (deg) => (deg * Math.PI) / 180;
/** Whether the Sun is down there, to a quarter of a degree. */
function isNight(ms, [latitude, longitude]) {
  const days = ms / 86_400_000 - 10_957.5, anomaly = rad(357.529 + 0.98560028 * days), tilt = rad(23.439);
  const along = rad(280.459 + 0.98564736 * days + 1.915 * Math.sin(anomaly) + 0.02 * Math.sin(2 * anomaly));
  const ascension = Math.atan2(Math.cos(tilt) * Math.sin(along), Math.cos(along)), declination = Math.asin(Math.sin(tilt) * Math.sin(along));
  const hour = rad(280.46062 + 360.98564737 * days + longitude) - ascension, up = rad(latitude);
  return Math.sin(up) * Math.sin(declination) + Math.cos(up) * Math.cos(declination) * Math.cos(hour) < Math.sin(rad(-0.83));
}

/** The nights of the shown time, each from and until. */
function nights(begin, where) {
  const found = [];
  for (let ms = begin; where && ms < begin + HOURS * HOUR_MS; ms += LOOK_MS) {
    if (!isNight(ms, where)) continue;
    if (found.at(-1)?.[1] === ms) found.at(-1)[1] += LOOK_MS;
    else found.push([ms, ms + LOOK_MS]);
  }
  return found;
}

/** The rows: what is followed first, in its order, then the other satellites that rise high enough. */
function rowsOf(passes, followed) {
  const by = new Map(followed.map((one) => [one.target, { name: one.target, one, passes: [] }]));
  for (const pass of passes) {
    if (pass.los && new Date(pass.los) < boxTime()) continue;
    if (!by.has(pass.name) && pass.max_el_deg < LEAST_DEG) continue;
    if (!by.has(pass.name)) by.set(pass.name, { name: pass.name, passes: [] });
    by.get(pass.name).passes.push(pass);
  }
  return [...by.values()];
}

const keyOf = (pass) => pass.name + pass.tca;
/** `ISS (ZARYA)` is ISS where there is little room. */
const brief = (name) => name.replace(/\s*\(.*\)$/, "");
const state = ({ plan }) => (!plan ? "" : plan.flown ? "flown" : "out");
const when = ({ aos, los }) => `${aos ? clock(aos) : "is up"}${los ? `–${clock(los)}` : ", does not set"}`;

function Bar({ pass, begin, chosen, reached, onChoose, onKey, onGrab }) {
  const share = (at, or) => Math.min(100, Math.max(0, ((at ? new Date(at) - begin : or) / (HOURS * HOUR_MS)) * 100));
  const left = share(pass.aos, 0), right = share(pass.los, HOURS * HOUR_MS), { plan } = pass, length = right - left || 1;
  const from = plan?.flown ? (share(plan.from, 0) - left) / length : 0,
    until = plan?.flown ? (share(plan.until, HOURS * HOUR_MS) - left) / length : 0;
  return html`<button type="button" class=${`bar ${state(pass)}`} data-key=${keyOf(pass)} tabindex=${reached ? 0 : -1} aria-pressed=${chosen}
      style=${{ left: `${left}%`, width: `${length}%`, "--high": pass.max_el_deg / 90 }} title=${plan ? how(plan) : null}
      aria-label=${`${pass.name}, ${when(pass)}, ${Math.round(pass.max_el_deg)}° high${plan ? `, ${plan.flown ? "planned" : how(plan)}` : ""}`}
      onClick=${() => onChoose(pass)} onFocus=${() => onChoose(pass)} onKeyDown=${onKey} onPointerDown=${onGrab}>
    <span class="whole"><span class="part" style=${{ left: `${100 * from}%`, width: `${100 * (until - from)}%` }}></span></span>
    <small aria-hidden="true">${Math.round(pass.max_el_deg)}°</small></button>`;
}

/** What is known of a pass, and what one may do with it. */
function Chosen({ pass, rivals, follows, now, hello, onFly, say }) {
  const { paired } = hello, tracked = now.status.tracks?.name === pass.name, card = useRef(null);
  useEffect(() => intoSight(card.current), [keyOf(pass)]);
  return html`<div class="chosen" ref=${card}><p role="status"><b>${pass.name}
    </b> ${when(pass)}, ${Math.round(pass.max_el_deg)}° high${pass.aos_az_deg == null ? "" : `, from ${Math.round(pass.aos_az_deg)}°`}${pass.los_az_deg == null ? "" : ` to ${Math.round(pass.los_az_deg)}°`}. ${pass.plan ? html`<span
    class=${state(pass)}>${pass.plan.flown ? html`In the plan: ${how(pass.plan)}.` : html`Left out: ${pass.plan.reason}.`}
    </span>` : html`${"Not in the plan."} ${paired && !follows && html`The box flies each of its passes once you name it in <a
      href="#setup/8">Setup, step 8</a>, <code>sky.follow</code>.`}`}</p>
    ${paired && html`<div class="chips"><${Orders} now=${now} hello=${hello}><button type="button" aria-pressed=${tracked}
      onClick=${() => act(post("track", { target: pass.name }), say)}>
      ${tracked ? `${pass.name} is tracked` : `Track ${pass.name}`}</button><//>
      <button type="button" onClick=${() => act(keep(pass.name.slice(0, 30), pass.name), say)}>Keep as a favourite</button>
      ${rivals.map((name) => html`<button type="button" key=${name} onClick=${() => onFly(name)}>
        ${pass.plan.flown ? `Rather fly ${name}` : `Fly it rather than ${name}`}</button>`)}</div>`}</div>`;
}

/** Those of the plan that are up at the same time, and flown where this one is left out, or left out where it is flown. */
function rivalsOf(pass, passes) {
  if (!pass.plan) return [];
  const from = (each) => (each.aos ? new Date(each.aos) : 0), until = (each) => (each.los ? new Date(each.los) : Infinity);
  const beside = passes.filter((each) => each.plan && each.plan.flown !== pass.plan.flown && each.name !== pass.name && from(each) < until(pass) && until(each) > from(pass));
  return [...new Set(beside.map((each) => each.name))];
}

export function Timeline({ now, station, hello, say, coming = usePasses() }) {
  const { paired } = hello, { passes, waits, fault, again } = coming, { followed, show, send } = useFollowed(hello, again, say);
  const [at, setAt] = useState(boxTime), [chosen, choose] = useState(null), [dragged, setDragged] = useState(null),
    [all, showAll] = useState(false), [undo, setUndo] = useState(null), [told, tell] = useState("");
  const list = useRef(null);
  useEffect(() => {
    const tick = setInterval(() => setAt(boxTime()), 10_000);
    return () => clearInterval(tick);
  }, []);
  const begin = Math.floor(at / HOUR_MS) * HOUR_MS, dark = useMemo(() => nights(begin, station.where), [begin, station.where]);
  const share = (ms) => `${((ms - begin) / (HOURS * HOUR_MS)) * 100}%`;
  const every = rowsOf(passes ?? [], followed), most = followed.length ? followed.length : OTHERS, rows = all ? every : every.slice(0, most);
  const pass = (passes ?? []).find((each) => keyOf(each) === chosen), first = rows.find((row) => row.passes.length)?.passes[0];

  const change = (before, order, says) => {
    const untouched = before.every((one) => one.priority === one.written);
    setUndo({ order: untouched ? null : before.map((one) => one.name), says });
    tell(says);
    send(order.map((one) => one.name));
  };
  const nowAt = (one, to) => `${one.target} is now ${to + 1} of ${followed.length}`;
  const place = (from, to) => {
    const next = moved(followed, from, to);
    show(next);
    change(followed, next, nowAt(followed[from], to));
  };
  /** Let the one count more than the other, and as little more than today as that needs. */
  const prefer = (better, worse) => {
    const from = followed.findIndex((one) => one.target === better), to = followed.findIndex((one) => one.target === worse);
    if (from > to) place(from, to);
    else tell(`${better} counts more already`);
  };
  const asWritten = () => (setUndo({ order: followed.map((one) => one.name), says: "the file's order" }), send(null));
  const takeBack = () => (send(undo.order), tell("taken back"), setUndo(null));
  const grab = (event, from) => paired && drag(event, () => [...list.current.children].slice(0, followed.length), followed, from,
    (order, one) => (show(order), setDragged(one)), (order, to) => change(followed, order, nowAt(followed[from], to)));
  /** One bar is reached by Tab, the others from it by the arrows: in time, and to the nearest in the next row. */
  const barKey = (event, row, index) => {
    const bars = (which) => [...(list.current.children[which]?.querySelectorAll(".bar") ?? [])], mine = event.currentTarget.offsetLeft;
    const turn = { ArrowUp: -1, ArrowDown: 1 }[event.key],
      near = (found) => found.sort((one, other) => Math.abs(one.offsetLeft - mine) - Math.abs(other.offsetLeft - mine))[0];
    let to = { ArrowLeft: bars(row)[index - 1], ArrowRight: bars(row)[index + 1] }[event.key];
    for (let next = row + turn; turn && !to && list.current.children[next]; next += turn) to = near(bars(next));
    if (event.key.startsWith("Arrow")) event.preventDefault();
    to?.focus();
  };
  const other = followed.some((one) => one.priority !== one.written);
  return html`<section class="timeline" aria-label="The next 24 hours">
    <div class="above"><h2>The next 24 hours</h2>
      ${rows.length > 0 && html`<p class="legend">${followed.length > 0 && html`<span class="flown">planned</span><span
        class="out">left out</span>`}${rows.some((row) => !row.one) && html`<span>not in the plan</span>`}</p>`}
      ${undo && html`<button type="button" onClick=${takeBack}>Undo: ${undo.says}</button>`}
      ${paired && other && !undo && html`<button type="button" onClick=${asWritten}>The file's order again</button>`}</div>
    ${rows.length > 0 && html`<div tabindex="0" class=${`scroller ${waits ? "old" : ""}`}><div class="day">
      <div class="ruler" aria-hidden="true">${[...Array(HOURS).keys()].map((hour) => html`<span key=${hour}>
        ${new Date(begin + hour * HOUR_MS).toLocaleTimeString(undefined, { hour: "numeric" })}</span>`)}</div>
      <div class="behind" aria-hidden="true">${dark.map(([from, until]) => html`<i class="night"
        style=${{ left: share(from), width: `${((until - from) / (HOURS * HOUR_MS)) * 100}%` }}></i>`)}</div>
      <ol ref=${list}>${rows.map((row, index) => html`<li key=${row.name} class=${dragged && dragged === row.one ? "dragged" : ""}>
        ${row.one && paired && followed.length > 1 ? html`<button type="button" class="name handle"
          aria-label=${`${row.name}, place ${index + 1} of ${followed.length}: drag, or move with the arrow keys`}
          onPointerDown=${(event) => grab(event, followed.indexOf(row.one))}
            onKeyDown=${(event) => keyed(event, followed.indexOf(row.one), followed.length, (to) => place(followed.indexOf(row.one), to))}>
            <span aria-hidden="true">⠿</span><span>${brief(row.name)}</span></button>`
        : html`<b class="name">${brief(row.name)}</b>`}
        <div class="lane">${row.one?.fault ? html`<p>${row.one.fault}</p>` : row.passes.map((each, number) => html`<${Bar}
          key=${keyOf(each)} pass=${each} begin=${begin} chosen=${keyOf(each) === chosen} reached=${each === (pass ?? first)}
          onChoose=${() => choose(keyOf(each))} onKey=${(event) => barKey(event, index, number)}
            onGrab=${(event) => row.one && event.pointerType === "mouse" && grab(event, followed.indexOf(row.one))} />`)}</div></li>`)}</ol>
      <div class="behind front" aria-hidden="true"><i class="now" style=${{ left: share(at) }}></i></div>
    </div></div>`}
    ${every.length > most && html`<p><button type="button" aria-expanded=${all} onClick=${() => showAll(!all)}>
      ${all ? "Fewer satellites" : `Other satellites: ${every.length - most}`}</button></p>`}
    ${pass ? html`<${Chosen} pass=${pass} rivals=${rivalsOf(pass, passes)}
      follows=${followed.some((one) => one.target === pass.name)} now=${now} hello=${hello} say=${say}
      onFly=${(name) => (pass.plan.flown ? prefer(name, pass.name) : prefer(pass.name, name))} />`
    : rows.length > 0 && html`<p class="about">Press a bar to see more of a pass.${paired && followed.length > 1 ? " Drag the satellite that counts more to the top: where two are up at once, a minute of the first is worth more." : ""}</p>`}
    ${!followed.length && station.where && html`<p class="about">The box flies passes by itself once it follows satellites: <a
      href="#setup/8">Setup, step 8</a>, <code>sky.follow</code>.</p>`}
    <p class="about" role="status">
      ${waits ? "The box computes passes and plan …" : !station.where ? html`The box does not know where it stands: <a
      href="#setup">tell it</a>.` : fault || (passes && !rows.length ? "No pass is high enough." : "")}</p>
    <p class="only-read" role="status">${told}</p></section>`;
}
