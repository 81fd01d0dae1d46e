// What helps when something is wrong: the views of this part, and the way from one to the other.
import { Doctor } from "/doctor.js";
import { Files } from "/files.js";
import { Log } from "/log.js";
import { Pair } from "/pairing.js";
import { html } from "/ui.js";
import { Wires } from "/wires.js";

const VIEWS = { doctor: "Doctor", wires: "Wires", log: "Log", files: "Files" };

/** Whether this view belongs here. */
export const helps = (view) => view in VIEWS;

export function Help({ view, now, hello, onPaired }) {
  const open = view === "doctor" || hello.paired;
  return html`<main class="help">
    <nav aria-label="Help">${Object.entries(VIEWS).map(([hash, name]) => html`<a href=${`#${hash}`}
      aria-current=${view === hash ? "page" : null}>${name}</a>`)}</nav>
    ${!open && html`<${Pair} onPaired=${onPaired} />`}
    ${view === "doctor" && html`<${Doctor} />`}
    ${open && view === "wires" && html`<${Wires} hello=${hello} links=${now.links} />`}
    ${open && view === "files" && html`<${Files} />`}
    ${open && view === "log" && html`<${Log} />`}
  </main>`;
}
