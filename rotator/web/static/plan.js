// What the box follows, in the order that counts, and the plan of the next day that comes of it. The order is dragged by
// a finger or a mouse, moved by the arrow keys, or by the two buttons of each row.
import { boxTime, post, read } from "/box.js";
import { act, html, useEffect, useRef, useState } from "/ui.js";

const ROWS = 10;
const clock = (text) => new Date(text).toLocaleTimeString(undefined, { hour: "2-digit", minute: "2-digit" });
const moved = (list, from, to) => {
  const next = list.filter((_, index) => index !== from);
  next.splice(to, 0, list[from]);
  return next;
};

function Target({ one, place, count, onMove, onDrag, dragged }) {
  const turn = { ArrowUp: -1, ArrowDown: 1 };
  const key = (event) => {
    if (!(event.key in turn)) return;
    event.preventDefault();
    onMove(place, place + turn[event.key]);
  };
  return html`<li class=${dragged ? "dragged" : ""} data-place=${place}>
    <button type="button" class="handle" aria-label=${`${one.target}, place ${place + 1} of ${count}: drag, or move with the arrow keys`} onKeyDown=${key} onPointerDown=${(event) => onDrag(event, place)}><span aria-hidden="true">⠿</span></button>
    <b>${one.target}</b><span>${one.fault || `priority ${+one.priority.toPrecision(3)}${one.priority !== one.written ? `, in the file ${one.written}` : ""}${one.least_deg ? `, from ${one.least_deg}° up` : ""}`}</span>
    <button type="button" aria-label=${`${one.target} up`} disabled=${place === 0} onClick=${() => onMove(place, place - 1)}>▲</button>
    <button type="button" aria-label=${`${one.target} down`} disabled=${place === count - 1} onClick=${() => onMove(place, place + 1)}>▼</button></li>`;
}

/** `changed`: the plan is another one now. `hello`: another one after each start of the box, with another file perhaps. */
export function Followed({ hello, paired, changed, say }) {
  const [followed, setFollowed] = useState([]), [drag, setDrag] = useState(null), [told, tell] = useState(""), list = useRef(null), shown = useRef([]);
  const load = () => act(read("followed").then((answer) => setFollowed(answer.followed)), say);
  useEffect(load, [hello]);
  shown.current = followed;
  const send = (order) => act(post("followed", { order }).then(changed).finally(load), say);
  const place = (from, to) => {
    if (to < 0 || to >= followed.length || to === from) return;
    const next = moved(followed, from, to);
    setFollowed(next);
    tell(`${followed[from].target} is now ${to + 1} of ${followed.length}`);
    send(next.map((one) => one.name));
  };
  const begin = (event, from) => {
    if (event.button > 0) return;
    event.preventDefault();
    event.currentTarget.focus();
    const before = followed, name = before[from].name;
    setDrag(name);
    const rows = () => [...(list.current?.querySelectorAll("li") ?? [])];
    const move = (at) => {
      const over = rows().findIndex((row) => at.clientY < row.getBoundingClientRect().bottom);
      const now = shown.current.findIndex((one) => one.name === name), to = over < 0 ? before.length - 1 : over;
      if (to !== now) setFollowed(moved(shown.current, now, to));
    };
    const end = (at) => {
      removeEventListener("pointermove", move);
      ["pointerup", "pointercancel"].forEach((each) => removeEventListener(each, end));
      setDrag(null);
      const to = shown.current.findIndex((one) => one.name === name);
      if (at.type === "pointercancel") setFollowed(before);
      else if (to !== from) {
        tell(`${before[from].target} is now ${to + 1} of ${before.length}`);
        send(shown.current.map((one) => one.name));
      }
    };
    addEventListener("pointermove", move);
    ["pointerup", "pointercancel"].forEach((each) => addEventListener(each, end));
  };
  if (!followed.length) return html`<p>The file follows nothing. <a href="#setup">Setup, step 8</a>, <code>sky.follow</code>: a target whose passes the box flies by itself.</p>`;
  const other = followed.some((one) => one.priority !== one.written);
  return html`<div class="followed"><p>${paired ? "Drag what matters more to the top." : "What stands further up counts more."} Where two are up at once, a minute at priority 2 is worth two at priority 1.</p>
    <ol ref=${list}>${followed.map((one, index) => (paired ? html`<${Target} key=${one.name} one=${one} place=${index} count=${followed.length} onMove=${place} onDrag=${begin} dragged=${drag === one.name} />`
      : html`<li key=${one.name}><b>${one.target}</b><span>${one.fault || `priority ${+one.priority.toPrecision(3)}`}</span></li>`))}</ol>
    ${other && html`<p>This order is kept beside the file, which stays as it is. A later change of the file counts again. ${paired && html`<button type="button" onClick=${() => send(null)}>The file's order again</button>`}</p>`}
    ${paired && html`<p>Another satellite: <a href="#setup">Setup, step 8</a>, <code>sky.follow</code>.</p>`}
    <p class="only-read" role="status">${told}</p></div>`;
}

function how({ flown, set_off: leaves, wait_az_deg: az, over_the_top: over, lost_s: lost, reason }) {
  if (!flown) return `left out: ${reason}`;
  return `sets off ${clock(leaves)} to ${Math.round(az)}°${az >= 360 ? " (overlap)" : ""}${over ? ", over the top" : ""}${lost >= 1 ? `, loses ${Math.round(lost)} s` : ""}${reason ? `; ${reason}` : ""}`;
}

export function PlanTable({ passes }) {
  const [rows, setRows] = useState(ROWS);
  const planned = passes.filter((pass) => pass.plan && !(pass.los && new Date(pass.los) < boxTime()));
  if (!planned.length) return null;
  const from = (pass) => pass.plan.from ?? pass.aos, until = (pass) => pass.plan.until ?? pass.los;
  return html`<table class="plan"><thead><tr><th scope="col">from</th><th scope="col" class="wide">until</th><th scope="col">satellite</th><th scope="col" class="wide">highest</th><th scope="col">the antenna</th></tr></thead>
    <tbody>${planned.slice(0, rows).map((pass) => html`<tr key=${pass.name + pass.tca} class=${pass.plan.flown ? "" : "out"}>
      <td class="figure">${from(pass) ? clock(from(pass)) : "is up"}</td><td class="figure wide">${until(pass) ? clock(until(pass)) : "stays"}</td><td>${pass.name}</td>
      <td class="figure wide">${Math.round(pass.max_el_deg)}°</td><td>${how(pass.plan)}</td></tr>`)}</tbody></table>
    ${planned.length > rows && html`<p><button type="button" onClick=${() => setRows(planned.length)}>All ${planned.length} passes of the plan</button></p>`}`;
}
