// The elements of satellites: which files there are and how old, what is fetched, and a file that is sent to the box.
import { post, read, send } from "/box.js";
import { act, html, intoSight, Said, useEffect, useEvery, useRef, useState } from "/ui.js";

const EVERY_MS = 10_000, READ_MS = 1500, MOST_BYTES = 2_000_000;

const days = (file) => (file.newest_days == null ? "" : file.newest_days === file.oldest_days ? (file.newest_days === 1 ? `${file.newest_days} day old` : `${file.newest_days} days old`) : `${file.newest_days} to ${file.oldest_days} days old`);
const hours = (seconds) => (seconds < 5400 ? `${Math.max(1, Math.round(seconds / 60))} min` : `${Math.round(seconds / 3600)} h`);

function Fetched({ one }) {
  const good = one.good_s == null ? "nothing fetched yet" : one.satellites === 1 ? `${one.satellites} satellite, fetched ${hours(one.good_s)} ago` : `${one.satellites} satellites, fetched ${hours(one.good_s)} ago`;
  const next = one.again_s == null ? "" : one.again_s > 0 ? `, asked again in ${hours(one.again_s)}` : ", asked again soon";
  return html`<li><b>${one.address}</b><span>${good}${next}</span>${one.trouble && html`<span class="warning">${one.trouble}</span>`}</li>`;
}

export function Elements({ now, paired, changed }) {
  const [told, setTold] = useState(null), [said, say] = useState(""), [kept, keep] = useState(""),
    [sends, setSends] = useState(false), here = useRef(null);
  const load = () => read("elements").then(setTold, () => {});
  useEvery(EVERY_MS, load);
  useEffect(() => void (told && location.hash === "#sky/elements" && intoSight(here.current)), [!told]);
  const after = () => (changed(), load(), setTimeout(load, READ_MS));
  const take = (event) => {
    const [file] = event.target.files;
    event.target.value = "";
    if (!file) return;
    if (file.size > MOST_BYTES) return void say(`${file.name} is too large: a file has at most ${MOST_BYTES / 1e6} MB.`);
    setSends(true);
    keep("");
    act(send(`elements?name=${encodeURIComponent(file.name)}`, file).then((answer) => (keep(`${answer.name} is kept.`), after())).finally(() => setSends(false)), say);
  };
  const remove = (name) => act(post("elements/remove", { name }).then(() => (keep(`${name} is removed.`), after())), say);
  if (!told) return null;
  return html`<section class="log elements" ref=${here} aria-label="Elements"><h2>Elements of satellites</h2>
    <p>${told.satellites === 1 ? `${told.satellites} satellite. Of each the newest set counts.` : told.satellites ? `${told.satellites} satellites. Of each the newest set counts.` : "No satellite is known yet."}${!told.files.length && !told.fetch.length && html` Send a file, or name an address to fetch from: <a
      href="#setup/8">Setup, step 8</a>.`}</p>
    <ul>${told.files.map((file) => html`<li><b>${file.name}</b><span>
      ${file.satellites === 1 ? `${file.satellites} satellite` : `${file.satellites} satellites`}${file.satellites ? `, ${days(file)}` : ""}</span>
        ${file.uploaded && paired && html`<button type="button" aria-label=${`Remove ${file.name}`} onClick=${() => remove(file.name)}>Remove</button>`}</li>`)}
      ${told.fetch.map((one) => html`<${Fetched} one=${one} />`)}</ul>
    ${told.fetch.length > 0 && !now.clock_known && html`<p
      class="warning">The box has reached no time server: it fetches as soon as a person says that its time is right, in <a
      href="#setup/8">Setup, step 8</a>.</p>`}
    ${told.faults.length > 0 && html`<ul class="notes">${told.faults.map((fault) => html`<li>${fault}</li>`)}</ul>`}
    ${paired && html`<label class="file">Send a file: TLE, or OMM as JSON or CSV<input type="file" disabled=${sends}
      onChange=${take} accept=".tle,.txt,.json,.csv" /></label>`}
    <p role="status">${sends && "It is sent and checked …"}</p><${Said} text=${said || kept} good=${!said} /></section>`;
}
