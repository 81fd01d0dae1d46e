// What the box follows, and the plan of the next day that comes of it: asked for, in words, and as a list.
import { boxTime, post, read } from "/box.js";
import { act, html, useEffect, useRef, useState } from "/ui.js";

const EVERY_MS = 600_000, COMPUTES_MS = 1500, FAILED_MS = 15_000, ROWS = 10;
export const clock = (at) => new Date(at).toLocaleTimeString(undefined, { hour: "2-digit", minute: "2-digit" });

/** The passes of the next day, asked for again until they are computed; null: not yet. Whether they are being computed;
    why there are none; and a function that asks anew. */
export function usePasses() {
  const [passes, setPasses] = useState(null), [waits, setWaits] = useState(true), [fault, tell] = useState(""), again = useRef(() => {});
  useEffect(() => {
    let timer, gone = false;
    const load = () => {
      clearTimeout(timer);
      read("passes").then((told) => {
        if (gone) return;
        tell("");
        setWaits(!told);
        if (told) setPasses(told.passes);
        timer = setTimeout(load, told ? EVERY_MS : COMPUTES_MS);
      }, ({ message }) => {
        if (gone) return;
        setWaits(false);
        tell(message);
        timer = setTimeout(load, FAILED_MS);
      });
    };
    again.current = load;
    load();
    return () => ((gone = true), clearTimeout(timer));
  }, []);
  return { passes, waits, fault, again: () => again.current() };
}

/** What the file follows, the first counts most; `show` puts it into another order here, `send` at the box. `hello`:
    another one after each start of the box, with another file perhaps. */
export function useFollowed(hello, changed, say) {
  const [followed, show] = useState([]);
  const load = () => act(read("followed").then((answer) => show(answer.followed)), say);
  useEffect(load, [hello]);
  const send = (order) => act(post("followed", { order }).then(changed).finally(load), say);
  return { followed, show, send };
}

export function how({ flown, set_off: leaves, wait_az_deg: az, over_the_top: over, lost_s: lost, reason }) {
  if (!flown) return `left out: ${reason}`;
  return `sets off ${clock(leaves)} to ${Math.round(az)}°${az >= 360 ? " (overlap)" : ""}${over ? ", over the top" : ""}${lost >= 1 ? `, loses ${Math.round(lost)} s` : ""}${reason ? `; ${reason}` : ""}`;
}

export function PlanTable({ passes }) {
  const [rows, setRows] = useState(ROWS);
  const planned = passes.filter((pass) => pass.plan && !(pass.los && new Date(pass.los) < boxTime()));
  if (!planned.length) return null;
  const from = (pass) => pass.plan.from ?? pass.aos, until = (pass) => pass.plan.until ?? pass.los;
  return html`<table class="plan"><thead><tr><th scope="col">from</th><th scope="col" class="wide">until</th><th
    scope="col">satellite</th><th scope="col" class="wide">highest</th><th scope="col">the antenna</th></tr></thead>
    <tbody>${planned.slice(0, rows).map((pass) => html`<tr key=${pass.name + pass.tca} class=${pass.plan.flown ? "" : "out"}>
      <td class="figure">${from(pass) ? clock(from(pass)) : "is up"}</td><td class="figure wide">
        ${until(pass) ? clock(until(pass)) : "stays"}</td><td>${pass.name}</td>
      <td class="figure wide">${Math.round(pass.max_el_deg)}°</td><td>${how(pass.plan)}</td></tr>`)}</tbody></table>
    ${planned.length > rows && html`<p><button type="button" onClick=${() => setRows(planned.length)}>All ${planned.length} passes of the plan</button></p>`}`;
}
