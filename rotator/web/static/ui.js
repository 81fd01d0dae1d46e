// The template language and the hooks, from the vendored libraries, in one place.
import { h, render } from "/vendor/preact.mjs";
import htm from "/vendor/htm.mjs";

export { useEffect, useMemo, useRef, useState } from "/vendor/hooks.mjs";
export { render };
export const html = htm.bind(h);

export const degrees = (angle, digits = 1) => (angle == null ? "---" : `${angle.toFixed(digits)}°`);

/** A button that does something at the box, and says under itself why it does not. */
export function act(promise, say) {
  promise.then(() => say(""), (fault) => say(fault.message));
}
