// The page in the reader's language. Templates are translated before they are parsed, once each: every text between two
// tags is a message, with its values as {0}, {1}, and so are the attributes that a person hears or reads. Sentences that
// the box sends are English: they are found by the message that they were made of. What has no translation stays English.
import * as first from "/language.js";

const FIRST = 0xe000, VALUE = /[\ue000-\uf8ff]/, VALUES = /[\ue000-\uf8ff]/g, WORD = /\p{L}{2}/u, AT_LINES = /^\s*\n\s*|\s*\n\s*$/g;
const TOKEN = /<!--[\s\S]*?-->|<(?:"[^"]*"|'[^']*'|[^>"'])*>|[^<]+/g, ATTRIBUTE = /([\w-]+)=(?:"([^"]*)"|'([^']*)')/g,
  GIVEN = /([\w-]+)=([\ue000-\uf8ff])/g;
const READ = ["aria-label", "title", "placeholder", "label", "alt"], VERBATIM = ["code", "pre", "svg", "style"], MOST_KEPT = 3000;
const SEPARATORS = [/([.!?] +|[.!?]+$)/, /(; +)/, /(: +)/, /(, +)/, /( and )/, /( ?\(|\)$)/];
const VIEWS = ["setup", "doctor"], PATIENCE_MS = 3000;
const rules = new Intl.PluralRules(first.language), FORM = { one: 0, few: 1 };
const known = new Map(), kept = new Map(), cuts = new WeakMap();
const learn = ({ keys, words }) => words[0] && keys.forEach((key, at) => known.set(key, words[at]));
learn(first);

/** Texts that were shown, and have no translation: for the tests. */
export const missed = new Set();
document.documentElement.lang = first.language;

/** The words that only this view needs. Where they do not come, the view is shown without them: in English. */
export async function wordsOf(view) {
  if (!known.size || !VIEWS.includes(view)) return;
  const come = import(`/language.js?of=${view}`).then((words) => (learn(words), kept.clear(), (index = null)), () => {});
  await Promise.race([come, new Promise((done) => setTimeout(done, PATIENCE_MS))]);
}

/** A template in other words. `look` gives the translation of a message. Returns its texts, the values between them by
    their number, and which values are shown to a person. */
export function cut(texts, look) {
  const joined = texts.map((text, at) => (at ? String.fromCharCode(FIRST + at - 1) : "") + text).join(""), shown = [];
  const number = (value) => value.charCodeAt(0) - FIRST;
  const inWords = (run) => {
    const values = run.match(VALUES) ?? [], pieces = run.split(VALUE).map((piece) => piece.replace(AT_LINES, ""));
    if (!pieces.some((piece) => WORD.test(piece))) return run;
    const whole = pieces.map((piece, at) => (at < values.length ? `${piece}{${at}}` : piece)).join("").replace(/\s+/g, " ");
    const told = look(whole.trim());
    return told ? /^ ?/.exec(whole)[0] + told.replace(/\{(\d+)\}/g, (_, at) => values[at]) + / ?$/.exec(whole)[0] : run;
  };
  let inside = "";
  const whole = joined.replace(TOKEN, (token) => {
    if (!token.startsWith("<")) {
      if (VERBATIM.includes(inside)) return token;
      for (const value of token.match(VALUES) ?? []) shown[number(value)] = true;
      return inWords(token);
    }
    if (token.startsWith("<!--")) return token;
    inside = token.startsWith("</") ? "" : /^<([\w-]*)/.exec(token)[1];
    for (const [, name, value] of token.matchAll(GIVEN)) if (READ.includes(name)) shown[number(value)] = true;
    return token.replace(ATTRIBUTE, (all, name, one, other) => (READ.includes(name) ? `${name}="${inWords(one ?? other).replaceAll('"', "”")}"` : all));
  });
  return { texts: whole.split(VALUE), order: (whole.match(VALUES) ?? []).map(number), shown };
}

/** The key of a message without values, as `rotator.languages.short` makes it. */
function short(text) {
  let number = 0x811c9dc5;
  for (let at = 0; at < text.length; at++) number = Math.imul(number ^ text.charCodeAt(at), 0x01000193);
  return (number >>> 7).toString(36);
}

const exact = (text) => known.get(short(text));
const look = (message) => form((message.includes("{0}") ? known.get(message) : exact(message)) || (missed.add(message), ""));

/** A translation in the form for this count: gettext has that for one thing first, and that for many last. */
function form(told, count) {
  const forms = told.split("\v");
  return forms[FORM[rules.select(count)]] ?? forms.at(-1);
}

/** The same template and its values, in the reader's language. */
export function inWords(texts, values) {
  if (!known.size) return [texts, ...values];
  let made = cuts.get(texts);
  if (!made) cuts.set(texts, (made = cut(texts, look)));
  return [made.texts, ...made.order.map((at) => (made.shown[at] && typeof values[at] === "string" ? said(values[at]) : values[at]))];
}

/** A sentence with its numbers and names, in the reader's language. */
export function said(text) {
  if (!WORD.test(text)) return exact(text) || text;
  if (known.size && !kept.has(text)) {
    if (kept.size > MOST_KEPT) kept.clear();
    const plain = text.trim(), told = found(plain);
    if (told === null) missed.add(plain);
    kept.set(text, told === null ? text : text.replace(plain, () => told));
  }
  return kept.get(text) ?? text;
}

// STOP is no module, and waits for none.
window.inReadersWords = said;

/** Null: it is in no catalogue. A sentence is looked for as it stands, by its pattern, then, if not `whole`, in pieces. */
function found(text, whole) {
  if (exact(text)) return exact(text);
  const small = text[0].toLowerCase() + text.slice(1), large = (told) => told && told[0].toUpperCase() + told.slice(1);
  if (small !== text && exact(small)) return large(exact(small));
  for (const { pattern, translation, open } of patterns(text)) {
    const values = pattern.exec(text)?.slice(1).map((value) => [value, WORD.test(value) ? found(value.trim(), open) : value]);
    if (values && !(open && values.some(([, inWords]) => inWords === null))) return form(translation, values.find(([value]) => !isNaN(value))?.[0]).replace(/\{(\d+)\}/g, (_, at) => values[at][1] ?? values[at][0]);
  }
  const told = small !== text && large(found(small, true));
  if (told || whole) return told || null;
  const pieces = SEPARATORS.map((separator) => text.split(separator)).find((each) => each.length > 1) ?? [];
  // A sentence stands in the catalogue with its mark: "Stop it!"
  const marked = (at) => (/^[.!?]/.test(pieces[at + 1]) ? found(pieces[at] + pieces[at + 1][0], true)?.slice(0, -1) : null);
  const others = pieces.map((piece, at) => (piece === " and " ? exact("and") && ` ${exact("and")} ` : WORD.test(piece) ? found(piece) ?? marked(at) : null));
  return others.some((each) => each) ? pieces.map((piece, at) => others[at] || piece).join("") : null;
}

let index;

/** The messages with values that may have made this text, those with most words first. `has`: the longest piece of one.
    One with hardly a word (`open`) counts only where its values are words that are known. */
function patterns(text) {
  if (!index) {
    index = new Map();
    const letters = (message) => message.replace(/\{\d+\}|[^\p{L}]/gu, "").length;
    for (const [message, translation] of [...known].filter(([each]) => each.includes("{0}")).sort(([a], [b]) => letters(b) - letters(a))) {
      const open = letters(message) < 6, parts = message.split(/\{\d+\}/), pieces = parts.map((each) => each.replace(/[.*+?^${}()|[\]\\]/g, "\\$&"));
      // Where two values touch, the second one is a clause of its own, or nothing.
      const value = (next) => (next === "" ? "((?:(?![,;:] | \\()[^])*)" : open ? "([^]+?)" : "([^]*?)");
      const pattern = new RegExp(`^${pieces.map((each, at) => (at ? value(at < pieces.length - 1 ? each : null) : "") + each).join("")}$`);
      const first = /^[^\s{]+(?=\s)/.exec(message)?.[0] ?? "";
      index.set(first, [...(index.get(first) ?? []), { pattern, translation, open, has: parts.sort((a, b) => b.length - a.length)[0] }]);
    }
  }
  return [...(index.get(/^\S+/.exec(text)[0]) ?? []), ...(index.get("") ?? [])].filter(({ has }) => text.includes(has));
}
