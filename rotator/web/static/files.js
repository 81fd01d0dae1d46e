// Files to keep: a backup, the way back from one, and what another person needs to see what is wrong.
import { read, upload } from "/box.js";
import { Changes, back } from "/settings.js";
import { act, html, intoSight, Said, useEffect, useRef, useState } from "/ui.js";

const day = (text) => (Number.isNaN(Date.parse(text)) ? text : new Date(text).toLocaleString(undefined, { dateStyle: "medium", timeStyle: "short" }));

function Restore({ settings }) {
  const [file, setFile] = useState(null), [shown, setShown] = useState(null), [said, say] = useState(""),
    [done, setDone] = useState(""), asks = useRef(null);
  useEffect(() => void intoSight(asks.current), [shown]);
  const look = (event) => {
    const chosen = event.target.files[0];
    setShown(null);
    setDone("");
    if (!chosen) return;
    setFile(chosen);
    act(upload("restore/check", chosen).then(setShown), say);
  };
  const restore = async () => {
    setShown(null);
    setDone("The box starts anew …");
    try {
      const { run } = await upload("restore?stop=true", file), told = await back(run);
      setDone(told.refused ? "" : "Restored: the box runs with it.");
      say(told.refused ? `The backup could not be used, and the file before it is back: ${told.refused}` : "");
    } catch (fault) {
      setDone("");
      say(fault.message);
    }
  };
  return html`<h3>Restore</h3>
    <p>Everything in a backup is checked first, and you see what it changes. What is there now is kept.</p>
    <label class="file">A backup<input type="file" accept=".zip,application/zip" onChange=${look} /></label>
    ${shown && html`<div class="asks" ref=${asks}><p>Backup of <b>${day(shown.made)}
      </b>, by rotator ${shown.program}: ${shown.rotor}; ${shown.files.join(", ")}.</p>
      ${shown.diff.length ? html`<${Changes} ...${shown} settings=${settings} />` : html`<p>The configuration is the same as now.</p>`}
      <p>The antenna stops, the box starts anew with this, and obeys its limits and calibration from then on. Restore it?</p>
      <button type="button" class="go" onClick=${restore}>Restore it</button>
      <button type="button" onClick=${() => setShown(null)}>No</button></div>`}
    <p role="status">${done}</p>
    <${Said} text=${said} />`;
}

export function Files() {
  const [file, setFile] = useState(null);
  useEffect(() => void read("settings").then(setFile, () => {}), []);
  return html`<section class="log files"><h2>Files</h2>
    <h3>Backup</h3>
    <p>The configuration and what the box has learnt, in one file. It may hold passwords: keep it to yourself. Not in it: where an axis
      that counts stands, what is doubted of relays, the paired browsers, and fetched elements.</p>
    <p>${file?.used !== false ? html`<a class="button"
      href="/api/backup" download>Save a backup</a>` : html`This box runs without a file, so there is nothing to keep yet: <a
      href="#setup">Setup</a> makes one.`}</p>
    <${Restore} settings=${{ file }} />
    <h3>Diagnostics</h3>
    <p>For a person who is to help you: version, configuration, state, log, doctor and wires. Passwords, tokens, names of browsers and
      your exact place are taken out; addresses in your network are in it.</p>
    <p><a class="button" href="/api/diagnostics" download>Save diagnostics</a></p>
  </section>`;
}
