// The template language and the hooks, from the vendored libraries, in one place.
import { useEffect, useRef } from "/vendor/hooks.mjs";
import { h, render } from "/vendor/preact.mjs";
import htm from "/vendor/htm.mjs";
import { inWords, said, wordsOf } from "/words.js";

export { useEffect, useMemo, useRef, useState } from "/vendor/hooks.mjs";
export { render, said, wordsOf };

const parsed = htm.bind(h);

/** Elements from a template, in the reader's language. */
export const html = (texts, ...values) => parsed(...inWords(texts, values));

/** A key or a value of the file as it stands there, in no other words: lists are not looked up. */
export const verbatim = (text) => [text];

export const degrees = (angle, digits = 1) => (angle == null ? "---" : `${angle.toFixed(digits)}°`);

/** The axes that the rotor has. `of`: the status, or the facts of the box. */
export const fitted = (of) => ["azimuth", "elevation"].filter((axis) => of[axis].fitted);

/** What answers a press is in sight, never behind STOP or the edge: the margins of the page are in style.css. */
export const intoSight = (element) => element?.scrollIntoView({ block: element.offsetHeight > innerHeight * 0.7 ? "start" : "nearest" });

/** A sentence that answers a press, beside what was pressed. Good news is told in the same place. */
export function Said({ text, good, id }) {
  const here = useRef(null);
  useEffect(() => void (text && intoSight(here.current)), [text]);
  return html`<p class=${`said ${good ? "good" : ""}`} id=${id} role="status" ref=${here}>${text}</p>`;
}

let acts = 0;

/** A button that does something at the box, and says why it does not. What was pressed last has the last word. */
export function act(promise, say) {
  const mine = (acts += 1);
  promise.then(() => mine === acts && say(""), (fault) => say(fault.message));
}

/** Load it now, and again so long after each answer: a slow box never has two such questions of this page to answer. */
export function useEvery(ms, load, changed = []) {
  useEffect(() => {
    let timer, gone = false;
    const next = () => gone || (timer = setTimeout(once, ms));
    const once = () => load().then(next, next);
    once();
    return () => ((gone = true), clearTimeout(timer));
  }, changed);
}
