// The page: what is shown where. The box itself is in box.js, each part in a file of its own, STOP in stop.js.
import { Live, post, read } from "/box.js";
import { Chart } from "/chart.js";
import { Demo } from "/demo.js";
import { AzimuthDial, ElevationDial } from "/dials.js";
import { Errands } from "/errands.js";
import { Asks, directionOf, JogPad, Target, ThereFromSky, Track } from "/hand.js";
import { Favourites } from "/favourites.js";
import { Help, helps } from "/help.js";
import { Notices } from "/notices.js";
import { hindrance, Orders } from "/orders.js";
import { Chosen, Flying, isOne, touched, UpNow, useOverhead } from "/overhead.js";
import { Pair, Paired } from "/pairing.js";
import { PassMode } from "/pass.js";
import { Passes } from "/passes.js";
import { Control, Front, Headline, Links, Mode, Notes, Strip } from "/panels.js";
import { Setup } from "/setup.js";
import { Sky } from "/sky.js";
import { Timeline } from "/timeline.js";
import { act, fitted, html, render, useEffect, useEvery, useState, verbatim, wordsOf } from "/ui.js";

const PAST_MS = 5000, NEXT_MS = 20_000, COMPUTES_MS = 2000, KEPT_MS = 60_000;
let tell = () => {}, version;
const live = new Live((seen) => tell(seen));

/** What has been, and the path of the flight with this key; an empty key: there is none. */
function usePast(key) {
  const [past, setPast] = useState([]), [path, setPath] = useState(null);
  useEvery(PAST_MS, async () => document.hidden || setPast((await read("past")).rows));
  useEvery(PAST_MS, async () => key && path?.key !== key && setPath(await read("path")), [key, path]);
  return [past, path?.key === key ? path : null];
}

/** The next pass, with its path; null: there is none, or it is not computed yet. */
function useNext(name) {
  const [next, setNext] = useState(null);
  useEffect(() => {
    let timer, gone = false;
    const load = () => read("next").then((told) => {
      if (gone) return;
      if (told) setNext(told.name ? told : null);
      timer = setTimeout(load, told ? NEXT_MS : COMPUTES_MS);
    }, () => gone || (timer = setTimeout(load, NEXT_MS)));
    load();
    return () => ((gone = true), clearTimeout(timer));
  }, [name]);
  return next;
}

function Antenna({ station, now, hello, fresh, say }) {
  const [draft, setDraft] = useState(null), [chosen, choose] = useState(null);
  const [past, path] = usePast(now.path), next = useNext(now.path), dome = station.elevation.fitted;
  const { sky, fault } = useOverhead(dome && station.where !== null);
  const { paired } = hello, { azimuth, elevation } = now.status, one = sky?.up.find((each) => isOne(each, chosen));
  const [kept, setKept] = useState([]);
  useEvery(KEPT_MS, async () => paired && setKept((await read("favourites")).favourites.map(({ target }) => target.toLowerCase())), [paired]);
  // A finger means what is up there, or else the direction.
  const pick = (way, at, px) => {
    const met = at && touched(sky, at, px);
    choose(met);
    setDraft(met ? null : way);
  };
  const flying = (px) => html`<${Flying} sky=${sky} px=${px} chosen=${chosen} tracked=${now.status.tracks?.name} favourites=${kept} />`;
  return html`<main class=${`board ${fresh ? "" : "old"}`}>
    <div class="stage">
      <div class="top"><${Headline} now=${now} hello=${hello} next=${next} /></div>
      <div class="panel sky-panel"><${Sky} station=${station} now=${now} past=${past} path=${path} next=${next}
        draft=${directionOf(draft)} onPick=${pick} flying=${flying} /></div>
      <div class="pick">${one && html`<div class="panel"><${Chosen} one=${one} now=${now} hello=${hello} say=${say} onClose=${() => choose(null)} /></div>`}
        ${paired && directionOf(draft) && html`<div class="panel"><${Orders} now=${now} hello=${hello} quiet><${ThereFromSky}
          station=${station} draft=${draft} say=${say} /><//></div>`}
        ${dome && html`<div class="panel"><${UpNow} sky=${sky} fault=${fault} known=${station.where}
          clockKnown=${now.clock_known} chosen=${chosen} choose=${choose} /></div>`}</div>
      ${paired && html`<div class="panel favourites-panel"><${Favourites} now=${now} hello=${hello} station=${station} say=${say} /></div>`}
      <div class="panel timeline-panel"><${Timeline} now=${now} station=${station} hello=${hello} say=${say} /></div>
      <div class="panel dials">${station.azimuth.fitted && html`<${AzimuthDial} range=${station.azimuth}
        angle=${now.azimuth_deg} target=${now.azimuth_target_deg} drive=${azimuth.drive} />`}
        ${station.elevation.fitted && html`<${ElevationDial} range=${station.elevation} angle=${now.elevation_deg}
          target=${now.elevation_target_deg} drive=${elevation.drive} />`}</div>
      <div class="panel front-panel"><${Front} now=${now} /><${Notes} now=${now} /></div>
      <div class="panel links-panel"><${Links} now=${now} station=${station} /></div>
      <div class="panel chart-panel"><${Chart} past=${past} axes=${fitted(station)} /></div>
    </div>
    <div class="aside">
      <section class="panel hand" aria-label="By hand">
        ${paired ? html`<${Orders} now=${now} hello=${hello} jog><${JogPad} station=${station} live=${live} say=${say} /><//>
          <${Orders} now=${now} hello=${hello} quiet=${hindrance(now, hello, true)}>
          <${Target} station=${station} draft=${draft} setDraft=${setDraft} say=${say} />
          <${Track} now=${now} known=${station.where} say=${say} />
          <${Asks} label="To the park position"
            question=${`The antenna turns to ${station.elevation.fitted ? `${station.park[0]}°, ${station.park[1]}°` : `${station.park[0]}°`} and stays there until you let it move again. Turn it there?`}
            yes="Turn it there" onYes=${() => act(post("park"), say)} /><//>
          <${Errands} now=${now} say=${say} />` : html`<${Pair} onPaired=${() => live.connect()} />`}
        <${Control} now=${now} hello=${hello} paired=${paired} say=${say} />
        <${Mode} now=${now} hello=${hello} paired=${paired} say=${say} />
      </section>
      <div class=${`demo-panel ${paired ? "mine" : ""}`}><${Demo} now=${now} say=${say} /></div>
    </div>
  </main>`;
}

const VIEWS = [["", "Antenna"], ["sky", "Plan"], ["pass", "Pass"], ["setup", "Setup"], ["doctor", "Help"]];

/** The view that the address names; of one that is not known the first. */
function shownView() {
  const hash = location.hash.slice(1).split("/")[0];
  return helps(hash) || hash === "paired" || VIEWS.some(([each]) => each === hash) ? hash : "";
}

function Page() {
  const [seen, setSeen] = useState({ now: null }), [view, setView] = useState(null), [said, say] = useState("");
  useEffect(() => {
    tell = setSeen;
    live.tell();
    const show = () => wordsOf(shownView()).then(() => (setView(shownView()), say(""), scrollTo(0, 0)));
    addEventListener("hashchange", show);
    show();
  }, []);
  const { now, hello, fresh, old, locked } = seen, station = hello?.box;
  useEffect(() => {
    // The box has been updated meanwhile: this page is the older one's.
    if (station) version ??= station.version;
    if (station && station.version !== version) location.reload();
  }, [station]);
  return html`<header>
      <h1>rotator</h1>
      ${now?.status.simulated && html`<strong class="sim">SIM<span> simulated: nothing real turns</span></strong>`}
      <nav aria-label="Views">${VIEWS.map(([hash, name]) => html`<a href=${`#${hash}`}
        aria-current=${view === hash || (hash === "doctor" && helps(view)) ? "page" : null}>${name}</a>`)}</nav>
      <p class=${`connection ${fresh ? "" : "lost"}`}><span role="status">${fresh ? html`<a href="#paired"
        title="Paired browsers and programs">${hello.paired ? verbatim(hello.name) : "may only look"}
        </a>` : locked ? "not paired" : now ? "no connection" : "connecting …"}</span>
        ${now && !fresh && `: this is ${Math.round(old / 1000)} s old`}</p>
    </header>
    ${now && html`<${Strip} now=${now} paired=${hello.paired} fresh=${fresh} beside=${view === ""} said=${said} say=${say} />`}
    ${now && view === "" && html`<${Antenna} station=${station} now=${now} hello=${hello} fresh=${fresh} say=${say} />`}
    ${now && view === "sky" && html`<main><${Passes} now=${now} station=${station} hello=${hello} say=${say} /></main>`}
    ${now && html`<${Notices} now=${now} shown=${view === "sky"} />`}
    ${now && view === "pass" && html`<${PassMode} now=${now} station=${station} hello=${hello} fresh=${fresh} say=${say} />`}
    ${now && helps(view) && html`<${Help} view=${view} now=${now} hello=${hello} onPaired=${() => live.connect()} />`}
    ${now && (view === "setup" || view === "paired") && html`<main>${!hello.paired ? html`<${Pair} onPaired=${() => live.connect()} />`
      : view === "setup" ? html`<${Setup} now=${now} hello=${hello} station=${station} live=${live} fresh=${fresh} say=${say} />`
      : html`<${Paired} hello=${hello} onChange=${() => live.connect()} />`}</main>`}
    ${!now && html`<main class="wait">${locked ? html`<${Pair} locked onPaired=${() => live.connect()} />` : html`<p>Looking for the box …</p>`}</main>`}`;
}

const app = document.getElementById("app");
app.replaceChildren();
render(html`<${Page} />`, app);
