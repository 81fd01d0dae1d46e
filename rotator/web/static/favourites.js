// The favourites: a button for each satellite, place or direction that a person uses again. The box keeps them, so every
// browser has the same ones, in an order and with names of one's own.
import { post, read } from "/box.js";
import { drag, keyed, moved } from "/drag.js";
import { number } from "/numbers.js";
import { hindrance } from "/orders.js";
import { act, html, useEffect, useEvery, useRef, useState } from "/ui.js";

const EVERY_MS = 15_000, CHANGED = "rotator-favourites";

/** Change the list as it is at the box now. Throws an Error with the box's own sentence. */
export async function change(edit) {
  const { favourites: before } = await read("favourites"), { favourites } = await post("favourites", { favourites: edit(before), before });
  dispatchEvent(new CustomEvent(CHANGED, { detail: { favourites, before } }));
}

export const keep = (name, target) => change((list) => [...list, { name, target }]);

/** The direction of these words, `143 5`; null: they name something else. */
function direction(target) {
  const parts = target.split(" ").map(number);
  return parts.length === 2 && !parts.includes(null) ? parts : null;
}

function press(target) {
  const there = direction(target);
  if (target === "park") return post("park");
  return there ? post("point", { azimuth_deg: there[0], elevation_deg: there[1] }) : post("track", { target });
}

/** Those that an earlier version kept in this browser alone. */
function takeOver(say) {
  const kept = JSON.parse(localStorage.getItem("presets") ?? "[]").slice(4);
  localStorage.removeItem("presets");
  const added = kept.map(([name, az, el]) => ({ name, target: `${az} ${el}` }));
  if (added.length) act(change((list) => [...list, ...added.filter((one) => !list.some((each) => each.name === one.name))]), say);
}

/** What is typed is not drawn anew with each picture of the box: it counts once the field is left. */
function Edited({ one, place, list, grab, put }) {
  const set = (key) => (event) => {
    const value = event.target.value.trim();
    if (value !== one[key]) put(list.map((each) => (each === one ? { ...each, [key]: value } : each)), () => (event.target.value = one[key]));
  };
  return html`<li>
    <button type="button" class="handle" aria-label=${`${one.name}, place ${place + 1} of ${list.length}: drag, or move with the arrow keys`}
      onPointerDown=${(event) => grab(event, place)}
        onKeyDown=${(event) => keyed(event, place, list.length, (to) => put(moved(list, place, to)))}><span
        aria-hidden="true">⠿</span></button>
    <input aria-label=${`What ${one.name} points at`} maxlength="100" defaultValue=${one.target} onChange=${set("target")} />
    <input aria-label=${`Name of ${one.name}`} maxlength="30" defaultValue=${one.name} onChange=${set("name")} />
    <button type="button" aria-label=${`${one.name} up`} disabled=${place === 0} onClick=${() => put(moved(list, place, place - 1))}>▲</button>
    <button type="button" aria-label=${`Remove ${one.name}`} onClick=${() => put(list.filter((each) => each !== one))}>×</button></li>`;
}

export function Favourites({ now, hello, station, say }) {
  const why = hindrance(now, hello);
  const [list, setList] = useState([]), [edits, setEdits] = useState(false), [name, setName] = useState(""),
    [target, setTarget] = useState(""), [undo, setUndo] = useState(null), rows = useRef(null), changes = useRef(0),
    atBox = useRef([]), last = useRef(Promise.resolve());
  // An answer that a change of this browser has overtaken shows nothing.
  const took = (favourites, begun) => {
    atBox.current = favourites;
    if (begun === changes.current) setList(favourites);
  };
  const load = async (begun = changes.current) => {
    const { favourites } = await read("favourites");
    if (begun === changes.current) took(favourites, begun);
  };
  useEvery(EVERY_MS, async () => document.hidden || load());
  useEffect(() => {
    const hear = ({ detail }) => (took(detail.favourites, (changes.current += 1)), setUndo(detail.before));
    addEventListener(CHANGED, hear);
    takeOver(say);
    return () => removeEventListener(CHANGED, hear);
  }, []);
  // Shown at once, and sent one after the other. Where another browser was quicker the box says so, and this one reads anew.
  const put = (favourites, refused = () => {}) => {
    const mine = (changes.current += 1);
    setUndo(list);
    setList(favourites);
    const sent = last.current.then(() => post("favourites", { favourites, before: atBox.current })).then((answer) => took(answer.favourites, mine));
    last.current = sent.catch(() => (refused(), setUndo(null), load().catch(() => {})));
    act(sent, say);
  };
  const add = (event) => {
    event.preventDefault();
    act(keep(name.trim() || target.trim(), target.trim()).then(() => (setName(""), setTarget(""))), say);
  };
  const lost = (each) => !station.where && !direction(each.target) && !["park", "plan"].includes(each.target);
  const grab = (event, from) => drag(event, () => [...rows.current.children], list, from, setList, (order) => put(order));
  return html`<section class="favourites" aria-label="Favourites"><div class="chips">
    ${!edits && list.map((each) => html`<button type="button" key=${each.name} class="favourite"
      disabled=${lost(each) || why !== ""} title=${why || (lost(each) ? "The box does not know where it stands" : each.target)}
      aria-pressed=${now.status.tracks?.name.toLowerCase() === each.target.toLowerCase()} onClick=${() => act(press(each.target), say)}>${each.name}</button>`)}
    <button type="button" class="quiet" aria-expanded=${edits} onClick=${() => setEdits(!edits)}>${edits ? "Done" : "Edit favourites"}</button>
    ${edits && undo && html`<button type="button" class="quiet" onClick=${() => (put(undo), setUndo(null))}>Undo</button>`}</div>
    ${edits && html`<form class="fields" onSubmit=${add}>
        <label>Satellite, place, direction or park<input required maxlength="100" placeholder="ISS, JO70fc, Japan, 143 5"
          value=${target} onInput=${(event) => setTarget(event.target.value)} /></label>
        <label>Name of the button<input maxlength="30" placeholder=${target.trim() || "Prague"} value=${name}
          onInput=${(event) => setName(event.target.value)} /></label>
        <button type="submit">Add</button></form>
      <ol ref=${rows}>${list.map((one, place) => html`<${Edited} key=${`${one.name} ${one.target}`} one=${one} place=${place}
        list=${list} grab=${grab} put=${put} />`)}</ol>`}</section>`;
}
