// Notices of this browser: before a pass, at a fault, at a stop, as long as the page is open somewhere in it; and the way
// to the calendar. What reaches a phone that sleeps is [notify], which the box does itself.
import { boxTime, read } from "/box.js";
import { html, said, useEffect, useEvery, useRef, useState } from "/ui.js";

const BEFORE_S = 300, NEXT_MS = 30_000, KEY = "notices";
const SAYS = {
  https: "This browser shows notices only of a page with HTTPS.",
  cannot: "This browser shows no notices.",
  denied: "Notices of this page are forbidden: allow them in the browser's settings.",
  off: "This browser can tell you five minutes before a pass, at a fault, and at a stop.",
  on: "This browser tells you five minutes before a pass, at a fault, and at a stop, while this page is open in it. A phone that sleeps hears nothing: for that the box itself posts notices, see [notify] in Setup.",
};

function stateNow() {
  if (!isSecureContext) return "https";
  if (!globalThis.Notification || !navigator.serviceWorker) return "cannot";
  if (Notification.permission === "denied") return "denied";
  return Notification.permission === "granted" && localStorage.getItem(KEY) === "on" ? "on" : "off";
}

/** A phone shows notices only by a worker. It does nothing else, and keeps nothing. A worker that is not there yet is
    asked again. */
async function show(title, body, tries = 5) {
  try {
    await navigator.serviceWorker.register("/notices-worker.js");
    const worker = await navigator.serviceWorker.ready;
    await worker.showNotification(said(title), { body: said(body), icon: "/icon-192.png", tag: title });
  } catch (fault) {
    if (tries === 1) throw fault;
    await new Promise((again) => setTimeout(again, 1000));
    await show(title, body, tries - 1);
  }
}

/** What is to be told now, by a key that is the same as long as it lasts: [title, text]. */
function news(now, next) {
  const found = new Map(), { tracks } = now.status;
  if (now.stopper) found.set(`stop ${now.stops} ${now.stopper}`, [`Stopped by ${now.stopper}`, "Nothing moves until a person lets it."]);
  for (const axis of ["azimuth", "elevation"]) if (now.status[axis].fault) found.set(`${axis} ${now.status[axis].fault.kind}`, [`Fault: ${axis}`, now.status[axis].fault.text]);
  const comes = tracks && tracks.begins_in_s > 0 ? [tracks.name, tracks.begins_in_s] : next?.aos ? [next.name, (new Date(next.aos) - boxTime()) / 1000] : ["", -1];
  if (comes[1] > 0 && comes[1] <= BEFORE_S) found.set(`pass ${comes[0]}`, [`${comes[0]} comes in ${Math.ceil(comes[1] / 60)} min`, "The antenna is ready for it, or on its way."]);
  return found;
}

/** Always there, so that it tells on every view; `shown` on one. */
export function Notices({ now, shown }) {
  const [state, setState] = useState(stateNow), [next, setNext] = useState(null), told = useRef(null);
  useEvery(NEXT_MS, async () => state === "on" && setNext(await read("next")), [state]);
  useEffect(() => {
    const found = news(now, next);
    if (state === "on" && told.current) for (const [key, [title, text]] of found) if (!told.current.has(key)) show(title, text).catch(() => setState("cannot"));
    told.current = found;
  }, [now]);
  if (!shown) return null;
  const change = async () => {
    if (state === "off") await Notification.requestPermission();
    localStorage.setItem(KEY, state === "off" ? "on" : "off");
    setState(stateNow());
  };
  return html`<aside class="panel notices" aria-label="Notices and calendar">
    <h2>Notices and calendar</h2>
    <p>${SAYS[state]}</p>
    ${(state === "on" || state === "off") && html`<button type="button" role="switch" aria-checked=${state === "on"}
      onClick=${change}>Notices in this browser: ${state === "on" ? "on" : "off"}</button>`}
    <p>The plan as a calendar: <a href=${`webcal://${location.host}/api/passes.ics`}>subscribe to it</a>, or <a
      href="/api/passes.ics" download="passes.ics">keep it as a file</a>.</p>
  </aside>`;
}
