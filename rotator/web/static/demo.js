// The demonstration: one press flies a pass of the ISS on a simulated rotor, and its picture can be kept or sent.
// A real rotor has no such button, and its box refuses the order.
import { post, read } from "/box.js";
import { Keeps } from "/flown.js";
import { trackingSaid } from "/hand.js";
import { act, html, useEffect, useEvery, useState } from "/ui.js";

const MARK = ", demo", FAST = " 10×", LOOK_MS = 1000, PATIENCE_LOOKS = 60;

const clock = (seconds) => `${Math.floor(seconds / 60)}:${String(Math.round(seconds) % 60).padStart(2, "0")}`;
const zone = () => Intl.DateTimeFormat().resolvedOptions().timeZone || "Europe";

/** What stands where a flight stands that may be a demo pass; null: none is flown. */
const demoOf = (now) => (now.status.tracks?.name.includes(MARK) ? now.status.tracks : null);

export function Demo({ now, say }) {
  const { status } = now, flight = demoOf(now);
  // The box's time at which the latest demo pass was seen; 0: none. What it left; null: nothing yet.
  const [since, setSince] = useState(0), [left, setLeft] = useState(null), [looks, setLooks] = useState(0);
  const [asked, ask] = useState(false);
  useEffect(() => {
    if (flight) (setSince(now.utc_s), setLeft(null), setLooks(0), ask(false));
  }, [flight?.name]);
  // A plan that could not be made is told, and the button is there again.
  useEffect(() => {
    if (!asked || flight || now.tracking === "planning") return;
    ask(false);
    say(trackingSaid(now.tracking));
  }, [now.tracking]);
  const waits = since > 0 && !flight && !left && looks < PATIENCE_LOOKS;
  useEvery(LOOK_MS, async () => {
    if (!waits) return;
    const { flown } = await read("flown"), found = flown.find((pass) => pass.name.includes(MARK) && pass.end_utc_s >= since);
    found ? setLeft(found) : setLooks((count) => count + 1);
  }, [waits]);
  if (!status.simulated) return null;
  const fly = (speed) => {
    ask(true);
    act(post("demo", { zone: zone(), speed }).catch((fault) => {
      ask(false);
      throw fault;
    }), say);
  };
  if (flight) return html`<${Flies} now=${now} flight=${flight} />`;
  if (asked && !now.stopper) return html`<${Says} words="The box plans the pass …" />`;
  if (left) return html`<${Left} pass=${left} again=${() => fly(left.name.endsWith(FAST) ? "fast" : "life")} close=${() => (setLeft(null), setSince(0))} />`;
  if (waits && !now.stopper) return html`<${Says} words="The pass is over. Its picture is drawn …" />`;
  const busy = status.tracks || now.tracking === "planning" || now.stopper || status.panel_mode !== "auto" || status.azimuth.fault || status.elevation.fault;
  // While somebody holds the antenna the offer keeps its place: a button that is held to turn may not move away under the finger.
  return busy ? null : html`<section class="panel demo offer" aria-label="Demonstration">
    <button type="button" class="go" disabled=${!!now.holder} onClick=${() => fly("fast")}>Fly a demo pass</button>
    <p>See it work: the ISS flies over your continent, ten times as fast as life, and the simulated antenna follows. Nothing real turns.</p>
    <button type="button" class="link" disabled=${!!now.holder} onClick=${() => fly("life")}>Or in ten minutes, as fast as in life</button>
  </section>`;
}

const Says = ({ words }) => html`<section class="panel demo" aria-label="Demonstration"><p role="status">${words}</p></section>`;

function Flies({ now, flight }) {
  const waits = flight.begins_in_s > 0, fast = flight.name.endsWith(FAST), lasts = flight.ends_in_s - flight.begins_in_s;
  return html`<section class="panel demo" aria-label="Demonstration">
    <p class="what"><b>${flight.name.split(MARK)[0]}</b>${" "}
      ${waits ? html`rises in <b>${clock(flight.begins_in_s)}</b>: the antenna turns to where it rises` : html`is up for <b>
        ${clock(Math.max(0, flight.ends_in_s))}</b> more${now.off_deg == null ? "" : html`, the antenna is off by <b>
        ${now.off_deg.toFixed(1)}°</b>`}`}</p>
    <progress max=${lasts} value=${waits ? 0 : Math.min(lasts, -flight.begins_in_s)} aria-label="Flown of the pass"></progress>
    <p class="about">${fast ? "Its path is ten times as fast as life; the rotor turns as fast as a real one. So the antenna stays some degrees behind: in life it is off by about two degrees." : "Path and rotor are as fast as in life."}</p>
  </section>`;
}

function Left({ pass, again, close }) {
  const address = `/api/flown/picture?file=${pass.file}`;
  const send = async () => {
    const picture = await (await fetch(address)).blob();
    await navigator.share({ title: pass.name, files: [new File([picture], pass.file, { type: "image/svg+xml" })] }).catch(() => {});
  };
  return html`<section class="panel demo left" aria-label="Demonstration">
    <p class="what" role="status"><b>${pass.name.split(MARK)[0]}</b> was flown: off by <b>
      ${pass.rms_deg.toFixed(1)}°</b> rms${pass.relay_starts == null ? "" : html`, <b>${pass.relay_starts}</b> motor starts`}.</p>
    <img src=${address} width="820" height="980"
      alt="The flown pass: on the sky the path of the ISS and of the antenna; below, how far the antenna was off, and each start of a motor" />
    <${Keeps} file=${pass.file}>
      ${navigator.canShare && html`<button type="button" onClick=${send}>Send the picture</button>`}
      <button type="button" onClick=${again}>Fly it again</button>
      <button type="button" class="quiet" onClick=${close}>Close</button>
    </${Keeps}>
  </section>`;
}
