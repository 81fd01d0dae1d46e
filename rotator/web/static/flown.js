// The passes that the box has flown: how far it was off, and a picture of each to keep.
import { read } from "/box.js";
import { html, useEvery, useState } from "/ui.js";

const EVERY_MS = 15_000;
const time = (seconds) => new Date(seconds * 1000).toLocaleString(undefined, { dateStyle: "short", timeStyle: "short" });

/** `tracked`: a change of what is tracked may mean that a pass is over. */
export function Flown({ tracked }) {
  const [flown, setFlown] = useState([]), [shown, show] = useState(null);
  useEvery(EVERY_MS, () => read("flown").then((told) => setFlown(told.flown)), [tracked]);
  const told = (pass) => `off by ${pass.rms_deg.toFixed(1)}° rms, ${pass.max_deg.toFixed(1)}° at worst${pass.relay_starts == null ? "" : `, ${pass.relay_starts} motor starts`}`;
  return html`<section class="log flown"><h2>Passes flown</h2>
    ${!flown.length && html`<p>When the box has flown a pass that it knows, its picture is here.</p>`}
    <ul>${flown.map((pass) => html`<li key=${pass.file}><b>${pass.name}</b><span>${time(pass.begin_utc_s)}, ${told(pass)}</span>
      <button type="button" aria-expanded=${shown === pass.file} aria-label=${`Picture of ${pass.name}, ${time(pass.begin_utc_s)}`} onClick=${() => show(shown === pass.file ? null : pass.file)}>Picture</button>
      <a href=${`/api/flown/picture?file=${pass.file}`} download=${pass.file}>Keep</a>
      ${shown === pass.file && html`<div class="picture"><img src=${`/api/flown/picture?file=${pass.file}`} alt=${`The sky with the path of ${pass.name} and of the antenna; below, how far the antenna was off, and each start of a motor: ${told(pass)}`} /></div>`}</li>`)}</ul></section>`;
}
