// One key of the file as a field, and what is typed there as a value. The loader of the box judges it, not this file.
import { keypad, number } from "/numbers.js";
import { html, said, verbatim } from "/ui.js";

/** How a value stands in its field. */
export function shown(kind, value) {
  if (value == null) return "";
  if (kind === "texts") return value.join("\n");
  if (kind === "numbers") return value.some((each) => Array.isArray(each)) ? value.map((each) => JSON.stringify(each)).join("\n") : JSON.stringify(value);
  return String(value);
}

/** What a person has typed, as a value; null: the key is left out. What is no such value goes to the box as it is. */
export function typed({ kind, choices }, text) {
  const bare = text.trim();
  if (bare === "") return null;
  if (kind === "yes") return bare === "true";
  if (kind === "choice") return choices.find((each) => String(each) === bare) ?? bare;
  if (kind === "texts") return bare.split("\n").map((row) => row.trim()).filter(Boolean);
  if (kind === "numbers") return list(bare);
  if (kind === "text") return bare;
  if (/^0x[0-9a-f]+$/i.test(bare)) return parseInt(bare, 16);
  return number(bare) ?? bare;
}

function list(text) {
  try {
    return JSON.parse(text.startsWith("[[") || !text.includes("\n") ? text : `[${text.replace(/\]\s*,?\s*\n/g, "],")}]`);
  } catch {
    return text;
  }
}

/** A text in the reader's language, with its keys and commands set apart. */
export const plain = (text) => said(text ?? "").split("`").map((part, at) => (at % 2 ? html`<code>${part}</code>` : part));

function range({ kind, named, least, above, most, below, needed }) {
  if (named) return said(named);
  const low = least != null ? `from ${least}` : above != null ? `above ${above}` : "",
    high = most != null ? `up to ${most}` : below != null ? `below ${below}` : "";
  return [kind === "whole" && "whole", low, high, kind === "numbers" && "numbers in brackets", kind === "texts" && "one a line", needed && "must be given"].filter(Boolean).map(said).join(" ");
}

/** `value`: the text in the field; `usual`: what counts where it is left out; `mistakes`: sentences of the loader. */
export function Field({ id, of, value, usual, mistakes, changed, onInput, label }) {
  const { key, kind, choices, unit, meaning, least, above } = of, hint = range(of),
    left = shown(kind, usual) === "" ? "not set" : `left out: ${shown(kind, usual)}`;
  const about = { id, "aria-describedby": `${id}-about`, "aria-invalid": mistakes.length > 0, onInput: (event) => onInput(event.target.value) };
  const options = kind === "yes" ? ["true", "false"] : choices;
  return html`<div class=${`field ${changed ? "changed" : ""}`}>
    <label for=${id}>${label ?? verbatim(key)}${unit && html` <small>(${unit})</small>`}</label>
    ${options ? html`<select ...${about} value=${value}><option value="">${left}</option>${options.map((each) => html`<option
      value=${String(each)}>${verbatim(each)}</option>`)}</select>`
      : kind === "texts" || kind === "numbers" ? html`<textarea ...${about} rows=${Math.min(8, value.split("\n").length + 1)}
        placeholder=${left.replaceAll("\n", " ")} spellcheck="false" value=${value}></textarea>`
      : html`<input ...${about} inputmode=${kind === "number" || kind === "whole" ? keypad(least ?? above) : "text"}
        autocomplete="off" spellcheck="false" placeholder=${left} value=${value} />`}
    <p class="about" id=${`${id}-about`}>${plain(meaning)}${hint && verbatim(` (${hint})`)}</p>
    ${mistakes.map((each) => html`<p class="mistake" role="alert">${each}</p>`)}</div>`;
}
