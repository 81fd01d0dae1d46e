// A number as a person types it, with a point or a comma. A field of type "number" is none of ours: whether it takes the
// comma depends on the browser's language, and one that drops it makes 125 of 12,5.
import { html } from "/ui.js";

const NUMBER = "\\s*[+\\-−]?(\\d+[.,]?\\d*|[.,]\\d+)\\s*", WHOLE = new RegExp(`^${NUMBER}$`);

/** What was typed, as a number; null: it is none. */
export function number(typed) {
  const text = String(typed ?? "");
  return WHOLE.test(text) ? Number(text.replace(",", ".").replace("−", "-")) : null;
}

/** The keyboard of a phone. The one for decimals lacks the minus on some: only where no value is below 0. */
export const keypad = (least) => (least >= 0 ? "decimal" : "text");

/** `least`: the lowest value, if any; `value`: as typed. The browser tells a person what is no number, and sends nothing. */
export function NumberField({ label, least, value, onInput, ...more }) {
  return html`<label>${label}<input ...${more} inputmode=${keypad(least)} autocomplete="off" pattern=${NUMBER} title="a number, such as 12.5"
    value=${value} onInput=${(event) => onInput(event.target.value)} /></label>`;
}
