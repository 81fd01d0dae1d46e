// Where the antenna stands, and from where the box fetches the elements of satellites: all that tracking needs. The box
// understands the place; the addresses are those of CelesTrak's own groups.
import { post } from "/box.js";
import { useChange } from "/settings.js";
import { html, useState } from "/ui.js";

const group = (name) => `https://celestrak.org/NORAD/elements/gp.php?GROUP=${name}&FORMAT=json`;
const SOURCES = {
  "CelesTrak: amateur, ISS": [group("amateur"), group("stations")],
  "CelesTrak: amateur, ISS, weather": [group("amateur"), group("stations"), group("weather")],
};
const NUMBERS = /^[-+\d.]+ [-+\d.]+$/;

/** `known`: the box knows its place already. */
export function Place({ settings, now, known }) {
  const { values } = settings.file, had = values.station ?? {}, fetched = values.sky?.fetch ?? [];
  const was = had.locator ?? (had.latitude_deg != null ? `${had.latitude_deg} ${had.longitude_deg}` : "");
  const [typed, type] = useState(null), [source, from] = useState(null), [mistake, tellMistake] = useState("");
  const place = typed ?? was, wanted = source ?? (fetched.length || values.sky?.elements ? "" : Object.keys(SOURCES)[0]);
  const { proposed, check, forget, view, mistakes } = useChange(settings, now.status.moving, () => (type(null), from(null)));
  const change = (set) => (event) => (forget(), tellMistake(""), set(event.target.value));
  const see = async (event) => {
    event.preventDefault();
    const found = await post("setup/questions", { answers: { place } }).catch((fault) => (tellMistake(fault.message), null));
    const asked = found?.questions.find((each) => each.name === "place");
    tellMistake(asked?.mistake || "");
    if (!asked || asked.mistake) return;
    const [latitude, longitude] = NUMBERS.test(asked.answer) ? asked.answer.split(" ").map(Number) : [null, null];
    const station = { locator: latitude == null ? asked.answer : null, latitude_deg: latitude, longitude_deg: longitude };
    const changes = Object.entries(station).filter(([key, value]) => value !== (had[key] ?? null)).map(([key, value]) => ({ place: ["station", key], value }));
    const more = (SOURCES[wanted] ?? [wanted.trim()].filter(Boolean)).filter((address) => !fetched.includes(address));
    if (more.length) changes.push({ place: ["sky", "fetch"], value: [...[fetched].flat(), ...more] });
    check({ changes });
  };
  const wrong = [mistake, ...mistakes.filter((each) => each.places.some(([table]) => table === "station")).map((each) => each.text)].filter(Boolean);
  const bad = mistakes.filter((each) => !each.places.some(([table]) => table === "station"));
  return html`<form class="place" onSubmit=${see}>
    <div class="field"><label for="place">The place of the antenna</label>
      <input id="place" required maxlength="100" autocomplete="off" spellcheck="false" placeholder="JN58td, or 48.85 2.35"
        value=${place} onInput=${change(type)}
        aria-describedby="place-about" aria-invalid=${wrong.length > 0} />
      ${wrong.map((each) => html`<p class="mistake" role="alert">${each}</p>`)}
      <p class="about" id="place-about">A locator of six characters or more, or latitude and longitude in degrees; south and west with a minus.</p></div>
    <div class="field"><label for="elements-from">Fetch the elements of satellites from</label>
      <input id="elements-from" list="sources" maxlength="300" autocomplete="off" spellcheck="false" placeholder="nowhere else"
        value=${wanted} onInput=${change(from)} aria-describedby="elements-about" aria-invalid=${bad.length > 0} />
      <datalist id="sources">${Object.keys(SOURCES).map((each) => html`<option value=${each} />`)}</datalist>
      ${bad.map((each) => html`<p class="mistake" role="alert">${each.text}</p>`)}
      <p class="about" id="elements-about">Or another address, https:// and so on. Empty: from nowhere new; the view Plan takes a file, too.${fetched.length > 0 && html` Now: ${[fetched].flat().map((each) => html`<code>
        ${each}</code> `)}`}</p></div>
    ${!(proposed && !mistakes.length) && html`<button type="submit" class="go" disabled=${settings.busy !== ""}>See what is written</button>`}
    ${view}
    ${known && html`<p>What is up now is on <a href="#">the first view</a>; when satellites pass, on <a href="#sky">the view Plan</a>.</p>`}</form>`;
}
