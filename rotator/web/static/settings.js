// All that the file can say: a form for each of its tables, what would change, and the new start of the box with it.
import { command, post, read } from "/box.js";
import { Field, plain, shown, typed } from "/fields.js";
import { html, intoSight, Said, said, useEffect, useMemo, useRef, useState, verbatim } from "/ui.js";

const AGAIN_MS = 700, PATIENCE_MS = 60_000;
const later = (ms) => new Promise((done) => setTimeout(done, ms));

/** Read it again until the box has computed it. */
async function whole(path) {
  for (;;) {
    const told = await read(path);
    if (told) return told;
    await later(AGAIN_MS);
  }
}

/** The box has been asked to start anew: its settings once it runs again. Throws where it does not come back here. */
export async function back(run) {
  for (const until = performance.now() + PATIENCE_MS; performance.now() < until; ) {
    await later(AGAIN_MS);
    const told = await read("settings").catch(() => null);
    if (told && told.run !== run) return told;
  }
  throw new Error("the box does not answer at this address any more: it may have another one now");
}

/** The settings of the box and the tables of its file. `change`: has them written, and the box started anew. `hello`: of
    the connection, another one after each start of the box: the file may have been changed elsewhere. */
export function useSettings(say, hello) {
  const [file, setFile] = useState(null), [tables, setTables] = useState(null), [busy, setBusy] = useState(""), [lost, setLost] = useState("");
  const load = () => {
    setLost("");
    const both = [whole("settings").then(setFile), tables ?? whole("settings/form").then((told) => setTables(told.tables))];
    return Promise.all(both).catch((fault) => setLost(fault.message));
  };
  useEffect(() => void (busy || load()), [hello]);
  const change = async (path, values) => {
    setBusy("The box starts anew …");
    try {
      const { run } = await post(path, values), told = await back(run);
      setFile(told);
      say(told.refused ? `The new file could not be used, and the one before it is back: ${told.refused}` : "");
      return !told.refused;
    } catch (fault) {
      say(fault.message);
      return false;
    } finally {
      setBusy("");
    }
  };
  return { file, tables, busy, lost, lose: setLost, load, change };
}

/** In place of what needs the file, while it is read; or why it cannot be. */
export function Missing({ settings: { lost, load } }) {
  if (!lost) return html`<p>Reading the file …</p>`;
  return html`<p class="mistake" role="alert">${lost}</p><button type="button" onClick=${load}>Look again</button>`;
}

/** Whether the settings are here. */
export const ready = ({ file, tables }) => !!(file && tables);

/** A box that was started without a file gets one with the first change; or at once. */
export function NoFile({ settings: { file, busy, change }, moving }) {
  if (!file || file.used) return null;
  const begin = () => change("settings/file", { stop: moving });
  return html`<section class="no-file"><p>${file.there ? html`This box was started without its file. <code>${file.file}
    </code> is there: the next change is written to it, and the box starts anew with it.`
    : html`This box runs without a file, as a simulated rotor. The first change that you write makes one, <code>${file.file}
      </code>, and the box starts anew with it.`} Later <code>
      ${command} run</code> in that folder takes it by itself.${moving && html` <b>The antenna moves: a new start stops it.</b>`}</p>
    <button type="button" disabled=${busy !== ""} onClick=${begin}>${file.there ? "Start with it now" : "Make it now"}</button></section>`;
}

/** Lines that change: + and - at their beginning. */
function Diff({ rows, label }) {
  return html`<pre class="diff" tabindex="0" role="region" aria-label=${label}>${rows.map((row) => html`<span
    class=${row[0] === "+" ? "new" : row[0] === "-" ? "gone" : ""}>${row || " "}</span>`)}</pre>`;
}

const at = (values, place) => place.reduce((inner, part) => inner?.[part], values);
const name = (place) => place.reduce((text, part) => (typeof part === "number" ? `${text}[${part + 1}]` : text ? `${text}.${part}` : part), "");
const id = (within, place) => [within, ...place].join("-");

/** The changes in the order in which the box makes them: keys, then tables taken out from the last on, then new ones. */
function changesOf(draft, tables, values) {
  const changes = [], added = {}, gone = [];
  for (const [text, { of, value }] of Object.entries(draft)) {
    const place = JSON.parse(text), list = place.findIndex((part) => typeof part === "number"), key = JSON.stringify(place.slice(0, list + 1));
    if (value === GONE) gone.push(place);
    else if (list >= 0 && place[list] >= (at(values, place.slice(0, list))?.length ?? 0)) {
      if (draft[key]?.value !== GONE) (added[key] ??= {})[place.at(-1)] = typed(of, value);
    } else if (!(list >= 0 && draft[key]?.value === GONE)) changes.push({ place, value: typed(of, value) });
  }
  const count = {};
  for (const place of gone.sort((a, b) => b.at(-1) - a.at(-1))) {
    const list = place.slice(0, -1), had = at(values, list)?.length ?? 0;
    if (place.at(-1) < had) {
      changes.push({ place, value: null });
      count[name(list)] = (count[name(list)] ?? had) - 1;
    }
  }
  for (const [text, value] of Object.entries(added)) {
    const list = JSON.parse(text).slice(0, -1), index = (count[name(list)] ??= at(values, list)?.length ?? 0);
    count[name(list)] += 1;
    changes.push({ place: [...list, index], value: Object.fromEntries(Object.entries(value).filter(([, each]) => each != null)) });
  }
  return changes;
}

const GONE = { gone: true };
const same = (a, b) => JSON.stringify(a) === JSON.stringify(b);

function Keys({ table, place, within, file, draft, setDraft, mistakes, find }) {
  return table.keys.filter((of) => find(table, of)).map((of) => {
    const here = [...place, of.key], text = JSON.stringify(here), was = shown(of.kind, at(file.values, here));
    const set = (value) => setDraft(({ [text]: _, ...others }) => (value === was ? others : { ...others, [text]: { of, value } }));
    return html`<${Field} key=${text} id=${id(within, here)} of=${of} value=${draft[text]?.value ?? was}
      usual=${at(file.in_force, here)} changed=${text in draft}
      mistakes=${mistakes.filter((each) => each.places.some((one) => same(one, here))).map((each) => each.text)} onInput=${set} />`;
  });
}

function ListTable({ table, file, draft, setDraft, ...more }) {
  const had = at(file.values, table.path)?.length ?? 0,
    new_ = new Set(Object.keys(draft).map((text) => JSON.parse(text)).filter((place) => same(place.slice(0, -2), table.path) && place.at(-2) >= had).map((place) => place.at(-2)));
  const [more_, setMore] = useState(0), count = Math.max(had + more_, ...[...new_].map((each) => each + 1), 0);
  const take = (place) => setDraft((all) => ({ ...all, [JSON.stringify(place)]: { value: GONE } }));
  const keep = (place) => setDraft(({ [JSON.stringify(place)]: _, ...others }) => others);
  return html`${Array.from({ length: count }, (_, index) => {
    const place = [...table.path, index], gone = draft[JSON.stringify(place)]?.value === GONE, one = at(file.values, place) ?? {};
    const about = [one.name, one.protocol, one.tcp ?? one.serial ?? one.pty ?? one.udp].filter(Boolean).join(", ");
    return html`<details class="one" key=${index} open=${index >= had}><summary>
      ${verbatim(name(place))} ${verbatim(about)}${gone && html` <b>taken out</b>`}</summary>
      ${gone ? html`<button type="button" onClick=${() => keep(place)}>Keep ${name(place)}</button>` : html`
        <${Keys} table=${table} place=${place} file=${file} draft=${draft} setDraft=${setDraft} ...${more} />
        <button type="button" onClick=${() => take(place)}>Take ${name(place)} out</button>`}</details>`;
  })}<button type="button" onClick=${() => setMore(count - had + 1)}>One more: [[${name(table.path)}]]</button>`;
}

/** A value as a person reads it; a whole table of a list with all its keys. */
const worded = (value) => value != null && typeof value === "object" && !Array.isArray(value) ? Object.entries(value).map(([key, each]) => `${key} ${worded(each)}`).join(", ")
  : Array.isArray(value) && value.some((each) => Array.isArray(each)) ? JSON.stringify(value) : Array.isArray(value) ? value.join(", ") : String(value);

/** What would change: each key with both values and its meaning. The lines of the file are there for who wants them. */
export function Changes({ changes, diff, settings: { tables, file } }) {
  const about = (place) => tables?.find((table) => same(table.path, place.slice(0, -1).filter((part) => typeof part === "string")))?.keys.find((of) => of.key === place.at(-1));
  const without = (place, unit, usual = worded(at(file?.in_force ?? {}, place) ?? "")) => (usual === "" ? "not set" : `left out, so ${usual}${unit}`);
  return html`${changes.length ? html`<table class="changes"><thead><tr><th scope="col">setting</th><th scope="col">now</th><th
    scope="col">then</th></tr></thead>
    <tbody>${changes.map(({ place, before, after }) => {
      const of = about(place), whole = typeof place.at(-1) === "number", unit = !of?.unit ? "" : of.unit === "°" ? "°" : ` ${of.unit}`;
      return html`<tr><th scope="row">${verbatim(name(place))}${of && html`<small>${plain(of.meaning)}</small>`}</th>
        <td><span class="only-read">now </span>${before == null ? (whole ? "not there" : without(place, unit)) : `${worded(before)}${unit}`}</td>
        <td><span class="only-read">then </span><b>${after == null ? (whole ? "taken out" : "left out") : `${worded(after)}${unit}`}</b></td></tr>`;
    })}</tbody></table>` : html`<p>No value changes, only how the file writes it.</p>`}
    <details><summary>The lines of the file</summary><${Diff} rows=${diff} label="Lines that change" /></details>`;
}

/** A change in two presses: what it would be, then it is written and the box starts anew. `check` takes the values of the
    request. `view`: the question, or what came of it. `onDone`: it is written, and the box is back. */
export function useChange(settings, moving, onDone = () => {}) {
  const [proposed, propose] = useState(null), [told, tell] = useState({ text: "" }), asks = useRef(null), { file, busy, change } = settings;
  const forget = () => (propose(null), tell({ text: "" }));
  const check = (values) => {
    forget();
    post("settings/check", { digest: file.digest, ...values }).then((found) => {
      if (!found.mistakes.length && !found.diff.length) tell({ text: "Nothing changes.", good: true });
      else propose({ ...found, values });
    }, (fault) => tell({ text: fault.message }));
  };
  const write = () => change("settings/write", { digest: file.digest, ...proposed.values, stop: moving }).then((done) => {
    propose(null);
    if (!done) return;
    tell({ text: `Written to ${file.file}. The box runs with it now.`, good: true });
    onDone();
  });
  useEffect(() => void intoSight(asks.current), [proposed]);
  const fits = proposed && !proposed.mistakes.length;
  const view = html`${fits && html`<section class="asks proposed" role="group" aria-label="What would change" ref=${asks}>
    <${Changes} ...${proposed} settings=${settings} />
    <p>The box writes this to <code>${file.file}</code>
      ${file.there ? ", keeps the file before beside it," : ""} and starts anew: that takes a few seconds.${moving && html` <b>The antenna moves: it stops.</b>`}</p>
    <button type="button" class="go" disabled=${busy !== ""} onClick=${write}>Write it and start anew</button> <button
      type="button" disabled=${busy !== ""} onClick=${forget}>Not yet</button>
    <span role="status">${busy}</span></section>`}<${Said} ...${told} />`;
  return { proposed, check, forget, tell, view, mistakes: proposed?.mistakes ?? [] };
}

/** `only`: names of tables, and `keys`: of keys in them, for a step of its own; without them all that the file can say. */
export function Settings({ settings, now, only, keys }) {
  const { file, busy, load } = settings, within = only ? `step-${only.join("-")}` : "set";
  const tables = useMemo(() => settings.tables?.filter((table) => !only || only.includes(name(table.path))), [settings.tables]);
  const [draft, setDraft] = useState({}), [forgotten, setForgotten] = useState(0), [words, setWords] = useState(""), form = useRef(null);
  const { check, forget, proposed, mistakes, view } = useChange(settings, now.status.moving, () => setDraft({})),
    changes = useMemo(() => (ready(settings) ? changesOf(draft, tables, file.values) : []), [draft, file]);
  // What is typed anew was not checked. After the new start nothing is left to write, and its word stays.
  useEffect(() => void (Object.keys(draft).length && forget()), [draft]);
  useEffect(() => void intoSight([...form.current?.querySelectorAll("p.mistake") ?? []].map((each) => each.closest(".field") ?? each)[0]), [mistakes.length && proposed]);
  if (!ready(settings)) return html`<${Missing} settings=${settings} />`;
  const wanted = words.trim().toLowerCase();
  const find = (table, of) => keys ? keys.includes(of.key) : !wanted || `${name(table.path)}.${of.key} ${said(of.meaning ?? "")}`.toLowerCase().includes(wanted);
  const wrong = (table) => mistakes.filter((each) => each.places.some((place) => same(place.filter((part) => typeof part === "string").slice(0, -1), table.path) || same(place, table.path))).length;
  const placed = (each) => each.places.some((place) => tables.some((table) => table.keys.some((of) => same([...table.path, of.key], place.filter((part) => typeof part === "string")))));
  const use = { within, file, draft, setDraft, mistakes, find };
  return html`<section class="settings" ref=${form} aria-label=${only ? `Settings: ${only.join(", ")}` : "All settings"}>
    ${!only && html`<p>All that <code>${file.file}</code> can say. A field that is left empty is not in the file.</p>
      <label>Find a setting<input type="search" value=${words} onInput=${(event) => setWords(event.target.value)} /></label>`}
    <div class=${`actions ${only ? "after" : ""}`}><button type="button" class="go" disabled=${!changes.length || busy !== ""}
      onClick=${() => check({ changes })}>
      ${changes.length ? `See ${changes.length === 1 ? "the change" : `${changes.length} changes`}` : "Nothing is changed"}</button>
      ${changes.length > 0 && html`<button type="button"
        onClick=${() => (setDraft({}), forget(), setForgotten(forgotten + 1), load())}>${changes.length === 1 ? "Forget it" : "Forget them"}</button>`}
      <span role="status">${busy || (mistakes.length > 0 && `${mistakes.length} to mend`)}</span></div>
    ${mistakes.filter((each) => !placed(each)).map((each) => html`<p class="mistake" role="alert">${each.text}</p>`)}
    <div class="outcome">${view}</div>
    ${tables.filter((table) => table.keys.some((of) => find(table, of))).map((table) => {
      const bad = wrong(table),
        touched = Object.keys(draft).some((text) => same(JSON.parse(text).filter((part) => typeof part === "string").slice(0, table.path.length), table.path));
      return html`<details key=${name(table.path)} open=${!!wanted || !!only || bad > 0 || undefined}><summary><b>
        ${verbatim(name(table.path))}</b> ${plain(table.meaning)}${touched && html` <i>changed</i>`}${bad > 0 && html` <b
        class="mistake">${bad} wrong</b>`}</summary>
        <div class="keys">${table.many ? html`<${ListTable} key=${`${file.digest} ${forgotten}`}
          table=${table} ...${use} />` : html`<${Keys} table=${table} place=${table.path} ...${use} />`}</div></details>`;
    })}
  </section>`;
}
