// By hand: buttons that turn the antenna while they are held, a target to point at or track, places that are kept, park.
import { post, read } from "/box.js";
import { GoesOn } from "/danger.js";
import { keep } from "/favourites.js";
import { number, NumberField } from "/numbers.js";
import { act, fitted, html, useEffect, useRef, useState } from "/ui.js";

const CLICK_S = 0.5;
const TURNS = [["up", "Up", "▲", "elevation"], ["ccw", "CCW", "◀", "azimuth"], ["cw", "CW", "▶", "azimuth"], ["down", "Down", "▼", "elevation"]];
const TYPED_MS = 250;

function HeldButton({ live, turn, name, arrow, say }) {
  const [held, setHeld] = useState(false), pressed = useRef(false);
  const press = (event) => {
    event.preventDefault();
    if (event.button > 0 || event.repeat) return;
    pressed.current = true;
    if (event.pointerId !== undefined) event.currentTarget.setPointerCapture?.(event.pointerId);
    event.currentTarget.focus();
    say("");
    setHeld(true);
    // Each end of the jog puts out the light: the finger, another button, STOP, the box.
    live.hold(turn, (reason) => (setHeld(false), say(reason)));
  };
  const leave = () => live.letGo();
  const key = (event) => (event.key === " " || event.key === "Enter") && press(event);
  // A screen reader, or a spoken command, sends a click and no press: it turns for a moment.
  const click = (event) => {
    if (!pressed.current && event.detail === 0) act(post("jog", { turn, seconds: CLICK_S }), say);
    pressed.current = false;
  };
  return html`<button type="button" class=${`jog ${turn} ${held ? "held" : ""}`} aria-label=${`Hold to turn ${name}`}
    onPointerDown=${press} onLostPointerCapture=${leave} onKeyDown=${key} onClick=${click} onBlur=${leave} onContextMenu=${(event) => event.preventDefault()}>
    <span aria-hidden="true">${arrow}</span><small>${name}</small></button>`;
}

const RELEASES = ["pointerup", "pointercancel", "keyup"];

/** `axes`: which of them; those of the rotor, where none are named. */
export function JogPad({ station, live, say, axes = fitted(station) }) {
  // The window hears the release wherever the finger is by then, and when the pad goes, so does the hold.
  useEffect(() => {
    const leave = () => live.letGo();
    RELEASES.forEach((release) => addEventListener(release, leave));
    return () => (RELEASES.forEach((release) => removeEventListener(release, leave)), leave());
  }, []);
  return html`<div class="jogpad" role="group" aria-label="Turn by hand, while a button is held">
    ${TURNS.filter(([, , , axis]) => axes.includes(axis)).map(([turn, name, arrow]) => html`<${HeldButton} key=${turn}
      live=${live} turn=${turn} name=${name} arrow=${arrow} say=${say} />`)}
    <p class="hint">hold</p></div>`;
}

/** The direction in degrees that a draft stands for; null: it is not whole yet. */
export function directionOf(draft) {
  const found = (draft ?? []).map(number);
  return found.length && !found.includes(null) ? found : null;
}

const pointAt = ([azimuth_deg, elevation_deg], say) => act(post("point", { azimuth_deg, elevation_deg }), say);

/** `draft`: azimuth and elevation as a person has typed or pressed them; null: neither yet. */
export function Target({ station, draft, setDraft, say }) {
  const [az, el] = draft ?? [station.azimuth.fitted ? "" : "0", station.elevation.fitted ? "" : "0"], there = directionOf(draft);
  const shown = (place) => fitted(station).map((axis) => `${place[axis === "azimuth" ? 0 : 1]}°`).join(" / ");
  const point = (event) => {
    event.preventDefault();
    pointAt(directionOf(draft), say);
  };
  return html`<form class="aim" onSubmit=${point}>
    <div class="fields">
      ${station.azimuth.fitted && html`<${NumberField} label="Azimuth" required least=${station.azimuth.min_deg} value=${az}
        onInput=${(text) => setDraft([text, el])} />`}
      ${station.elevation.fitted && html`<${NumberField} label="Elevation" required least=${station.elevation.min_deg}
        value=${el} onInput=${(text) => setDraft([az, text])} />`}
      <button type="submit" class="go">Point there</button>
    </div>
    ${there && html`<button type="button" class="quiet"
      onClick=${() => act(keep(shown(there), there.join(" ")), say)}>Keep ${shown(there)} as a favourite</button>`}
  </form>`;
}

/** A direction that was pressed on the sky: the next step stands there, too. */
export function ThereFromSky({ station, draft, say }) {
  const there = directionOf(draft);
  return there && html`<p><button type="button" class="go"
    onClick=${() => pointAt(there, say)}>Point to ${station.elevation.fitted ? `${there[0]}°, ${there[1]}°` : `${there[0]}°`}</button></p>`;
}

/** What became of the latest request, where the status does not show it; empty: nothing to say. */
export function trackingSaid(tracking) {
  if (tracking === "planning") return "The next pass is planned …";
  if (tracking.startsWith("refused: ")) return `Not tracked: ${tracking.slice(9)}`;
  if (tracking.startsWith("rests: ")) return `${tracking[7].toUpperCase()}${tracking.slice(8)}.`;
  return tracking.startsWith("ended") ? `Tracking has ${tracking}` : "";
}

/** It would be flown if nobody had ordered anything else. */
export const planRests = ({ tracking }) => /^rests: the plan/.test(tracking);

export function Track({ now, known, say }) {
  const [name, setName] = useState(""), [place, setPlace] = useState(null);
  // The box knows countries and callsigns. An answer that comes when other words stand there is of no use.
  useEffect(() => {
    setPlace(null);
    if (!name.trim()) return undefined;
    let current = true;
    const asked = setTimeout(() => read(`bearing?to=${encodeURIComponent(name)}`).then((found) => current && found.place && setPlace(found), () => {}), TYPED_MS);
    return () => {
      current = false;
      clearTimeout(asked);
    };
  }, [name]);
  const track = (event) => {
    event.preventDefault();
    act(post("track", { target: name }), say);
  };
  const tracks = now.status.tracks, said = trackingSaid(now.tracking);
  return html`<form class="track" onSubmit=${track}>
    <label>Track<input required maxlength="100" placeholder=${known ? "ISS, Moon, JN58td, Japan, VK" : "180 45"} value=${name}
      onInput=${(event) => setName(event.target.value)} /></label>
    <button type="submit">${place ? `Short path ${Math.round(place.azimuth_deg) % 360}°` : "Track"}</button>
    ${place && html`<button type="button"
      onClick=${() => act(post("track", { target: `${name.trim()} long` }), say)}>Long path ${Math.round(place.azimuth_deg + 180) % 360}°</button>
      <span class="hint-line">${place.place[0].toUpperCase()}${place.place.slice(1)}, ${place.km} km</span>`}
    ${tracks && html`<button type="button" onClick=${() => act(post("track", { target: "off" }), say)}>End ${tracks.name}</button>`}
    ${!known && html`<p class="hint-line">Directions alone, because the box does not know where it stands: <a href="#setup">tell it</a>.</p>`}
    ${!tracks && !now.stopper && html`<${GoesOn} now=${now} say=${say} />`}
    ${said && html`<p class="hint-line" role="status">${said}</p>`}
    ${planRests(now) && html`<button type="button" onClick=${() => act(post("track", { target: "plan" }), say)}>Follow the plan</button>`}
  </form>`;
}

/** What turns the antenna by surprise asks first. The question opens in its place and covers nothing. */
export function Asks({ label, question, yes, onYes }) {
  const [open, setOpen] = useState(false), asks = useRef(null), no = useRef(null), opener = useRef(null), back = useRef(false);
  const close = () => {
    back.current = asks.current.contains(document.activeElement);
    setOpen(false);
  };
  useEffect(() => {
    if (!open) {
      if (back.current) opener.current.focus();
      back.current = false;
      return undefined;
    }
    no.current.focus();
    const timer = setTimeout(close, 20_000);
    return () => clearTimeout(timer);
  }, [open]);
  if (!open) return html`<button type="button" ref=${opener} onClick=${() => setOpen(true)}>${label}</button>`;
  return html`<div class="asks" role="alertdialog" aria-label=${label} ref=${asks}><p>${question}</p>
    <button type="button" class="go" onClick=${() => (close(), onYes())}>${yes}</button>
    <button type="button" ref=${no} onClick=${close}>No</button></div>`;
}
