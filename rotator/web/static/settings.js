// All that the file can say: a form for each of its tables, what would change, and the new start of the box with it.
import { post, read } from "/box.js";
import { Field, plain, shown, typed } from "/fields.js";
import { act, html, useEffect, useMemo, useState } from "/ui.js";

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

/** In place of what needs the file: why there is none yet. `settings.lost`: the box has refused to show it. */
export function Missing({ settings: { file, busy, lost, load, change }, now }) {
  if (lost) return html`<p class="mistake" role="alert">${lost}</p><button type="button" onClick=${load}>Look again</button>`;
  if (file?.file !== "") return html`<p>Reading the file …</p>`;
  const make = () => change("settings/file", { stop: now.status.moving });
  return html`<p>This box runs without a file, so nothing can be set. It gets <code>rotator.toml</code> in the folder where it was started, or takes the one that is there, and starts anew with it in a few seconds. Later, by hand: <code>rotator run --config rotator.toml</code>.${now.status.moving && html` <b>The antenna moves: it stops.</b>`}</p>
    <button type="button" class="go" disabled=${busy !== ""} onClick=${make}>Make a file</button> <span role="status">${busy}</span>`;
}

/** Whether the box has a file, and it is here. */
export const ready = ({ file, tables }) => !!(file?.file && tables);

/** Lines that change: + and - at their beginning. */
export function Diff({ rows, label }) {
  return html`<pre class="diff" tabindex="0" role="region" aria-label=${label}>${rows.map((row) => html`<span class=${row[0] === "+" ? "new" : row[0] === "-" ? "gone" : ""}>${row || " "}</span>`)}</pre>`;
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
    return html`<${Field} key=${text} id=${id(within, here)} of=${of} value=${draft[text]?.value ?? was} usual=${at(file.in_force, here)} changed=${text in draft}
      mistakes=${mistakes.filter((each) => each.places.some((one) => same(one, here))).map((each) => each.text)} onInput=${set} />`;
  });
}

function ListTable({ table, file, draft, setDraft, ...more }) {
  const had = at(file.values, table.path)?.length ?? 0, new_ = new Set(Object.keys(draft).map((text) => JSON.parse(text)).filter((place) => same(place.slice(0, -2), table.path) && place.at(-2) >= had).map((place) => place.at(-2)));
  const [more_, setMore] = useState(0), count = Math.max(had + more_, ...[...new_].map((each) => each + 1), 0);
  const take = (place) => setDraft((all) => ({ ...all, [JSON.stringify(place)]: { value: GONE } }));
  const keep = (place) => setDraft(({ [JSON.stringify(place)]: _, ...others }) => others);
  return html`${Array.from({ length: count }, (_, index) => {
    const place = [...table.path, index], gone = draft[JSON.stringify(place)]?.value === GONE, one = at(file.values, place) ?? {};
    const about = [one.name, one.protocol, one.tcp ?? one.serial ?? one.pty ?? one.udp].filter(Boolean).join(", ");
    return html`<details class="one" key=${index} open=${index >= had}><summary>${name(place)} ${about}${gone && html` <b>taken out</b>`}</summary>
      ${gone ? html`<button type="button" onClick=${() => keep(place)}>Keep ${name(place)}</button>` : html`
        <${Keys} table=${table} place=${place} file=${file} draft=${draft} setDraft=${setDraft} ...${more} />
        <button type="button" onClick=${() => take(place)}>Take ${name(place)} out</button>`}</details>`;
  })}<button type="button" onClick=${() => setMore(count - had + 1)}>One more: [[${name(table.path)}]]</button>`;
}

/** What would change, and the question whether it is to be written. The antenna stops where it moves. */
export function Proposed({ diff, moving, onWrite, onLeave }) {
  return html`<section class="asks proposed" role="group" aria-label="What would change">
    <${Diff} rows=${diff} label="Lines that change" />
    <p>The box writes this, keeps the file before beside it, and starts anew: that takes a few seconds.${moving && html` <b>The antenna moves: it stops.</b>`}</p>
    <button type="button" class="go" onClick=${onWrite}>Write it and start anew</button> <button type="button" onClick=${onLeave}>Not yet</button></section>`;
}

/** `only`: names of tables, and `keys`: of keys in them, for a step of its own; without them all that the file can say. */
export function Settings({ settings, now, say, only, keys }) {
  const { file, busy, change, load } = settings, within = only ? `step-${only.join("-")}` : "set";
  const tables = useMemo(() => settings.tables?.filter((table) => !only || only.includes(name(table.path))), [settings.tables]);
  const [draft, setDraft] = useState({}), [forgotten, setForgotten] = useState(0), [words, setWords] = useState(""), [proposed, propose] = useState(null);
  const mistakes = proposed?.mistakes ?? [], changes = useMemo(() => (ready(settings) ? changesOf(draft, tables, file.values) : []), [draft, file]);
  useEffect(() => (propose(null), undefined), [draft]);
  if (!ready(settings)) return html`<${Missing} settings=${settings} now=${now} />`;
  const wanted = words.trim().toLowerCase();
  const find = (table, of) => keys ? keys.includes(of.key) : !wanted || `${name(table.path)}.${of.key} ${of.meaning}`.toLowerCase().includes(wanted);
  const check = () => act(post("settings/check", { digest: file.digest, changes }).then(propose), say);
  const write = () => change("settings/write", { digest: file.digest, changes, stop: now.status.moving }).then((done) => (propose(null), done && setDraft({})));
  const wrong = (table) => mistakes.filter((each) => each.places.some((place) => same(place.filter((part) => typeof part === "string").slice(0, -1), table.path) || same(place, table.path))).length;
  const placed = (each) => each.places.some((place) => tables.some((table) => table.keys.some((of) => same([...table.path, of.key], place.filter((part) => typeof part === "string")))));
  const use = { within, file, draft, setDraft, mistakes, find };
  return html`<section class="settings" aria-label=${only ? "Settings of this step" : "All settings"}>
    ${!only && html`<p>All that <code>${file.file}</code> can say. A field that is left empty is not in the file.</p>
      <label>Find a setting<input type="search" value=${words} onInput=${(event) => setWords(event.target.value)} /></label>`}
    <div class=${`actions ${only ? "after" : ""}`}><button type="button" class="go" disabled=${!changes.length || busy !== ""} onClick=${check}>${changes.length ? `See ${changes.length === 1 ? "the change" : `${changes.length} changes`}` : "Nothing is changed"}</button>
      ${changes.length > 0 && html`<button type="button" onClick=${() => (setDraft({}), setForgotten(forgotten + 1), load())}>Forget ${changes.length === 1 ? "it" : "them"}</button>`}
      <span role="status">${busy || (mistakes.length > 0 && `${mistakes.length} to mend`)}</span></div>
    ${mistakes.filter((each) => !placed(each)).map((each) => html`<p class="mistake" role="alert">${each.text}</p>`)}
    ${proposed && !mistakes.length && (proposed.diff.length ? html`<${Proposed} diff=${proposed.diff} moving=${now.status.moving} onWrite=${write} onLeave=${() => propose(null)} />` : html`<p role="status">Nothing changes.</p>`)}
    ${tables.filter((table) => table.keys.some((of) => find(table, of))).map((table) => {
      const bad = wrong(table), touched = Object.keys(draft).some((text) => same(JSON.parse(text).filter((part) => typeof part === "string").slice(0, table.path.length), table.path));
      return html`<details key=${name(table.path)} open=${!!wanted || !!only || bad > 0 || undefined}><summary><b>${name(table.path)}</b> ${plain(table.meaning)}${touched && html` <i>changed</i>`}${bad > 0 && html` <b class="mistake">${bad} wrong</b>`}</summary>
        <div class="keys">${table.many ? html`<${ListTable} key=${`${file.digest} ${forgotten}`} table=${table} ...${use} />` : html`<${Keys} table=${table} place=${table.path} ...${use} />`}</div></details>`;
    })}
  </section>`;
}
