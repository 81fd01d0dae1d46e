// Pairing this browser, and the list of all that are paired.
import { command, post, read } from "/box.js";
import { act, html, intoSight, Said, useEffect, useRef, useState } from "/ui.js";

function guess() {
  const agent = navigator.userAgent;
  const what = ["iPhone", "iPad", "Android", "Windows", "Mac", "Linux"].find((each) => agent.includes(each)) ?? "browser";
  const browser = ["Firefox", "Edg", "Chrome", "Safari"].find((each) => agent.includes(each)) ?? "";
  return `${browser === "Edg" ? "Edge" : browser} on ${what}`.trim();
}

/** `locked`: the box shows itself to paired browsers alone. */
export function Pair({ onPaired, locked }) {
  const [open, setOpen] = useState(false), [code, setCode] = useState(""), [name, setName] = useState(guess),
    [said, say] = useState(""), form = useRef(null), typed = useRef(null);
  const begin = () => act(post("pair/begin").then(() => setOpen(true)), say);
  // The whole form comes into sight, with the field for the code ready.
  useEffect(() => void (open && (intoSight(form.current), typed.current.focus({ preventScroll: true }))), [open]);
  const enter = (event) => {
    event.preventDefault();
    say("");
    act(post("pair", { code, name }).then(onPaired), (fault) => (say(fault), fault && (typed.current.focus({ preventScroll: true }), typed.current.select())));
  };
  return html`<section class="pair" aria-label="Pair this browser">
    <p>${locked ? "This box shows itself to paired browsers alone. You can stop it. To look, to move the antenna, and to set up the box," : "You can look, and stop. To move the antenna, and to set up the box,"} pair this browser once.</p>
    ${!open && html`<button type="button" class="go" onClick=${begin}>Pair this browser</button>`}
    ${open && html`<form onSubmit=${enter} ref=${form}>
      <p>The box shows six digits on its display for two minutes. Without a display: <code>${command} pair</code></p>
      <label>Code<input class="code" inputmode="numeric" autocomplete="one-time-code" pattern="[0-9 ]{6,7}"
        title="Six digits" required value=${code} ref=${typed}
        aria-invalid=${said !== ""} aria-describedby="pair-said" onInput=${(event) => setCode(event.target.value)} /></label>
      <${Said} id="pair-said" text=${said} />
      <label>Name<input required maxlength="40" value=${name} onInput=${(event) => setName(event.target.value)} /></label>
      <button type="submit" class="go">Pair</button> <button type="button" onClick=${begin}>Show a code again</button></form>`}
    ${!open && html`<${Said} text=${said} />`}
  </section>`;
}

const days = (seconds) => (seconds < 86400 ? "today" : `${Math.floor(seconds / 86400)} d ago`);

export function Paired({ hello, onChange }) {
  const [all, setAll] = useState([]), [said, say] = useState("");
  const load = () => act(read("paired").then((told) => setAll(told.paired)), say);
  useEffect(load, []);
  const revoke = (number) => act(post("revoke", { number }).then(() => (number === hello.number ? onChange() : load())), say);
  return html`<section class="paired"><h2>Paired browsers and programs</h2>
    <ul>${all.map((one) => html`<li><b>${one.name}</b>${one.number === hello.number && " (this one)"}
      <span>paired ${days(one.since_s)}, seen ${days(one.seen_s)}</span>
      <button type="button" onClick=${() => revoke(one.number)} aria-label=${`Unpair ${one.name}`}>Unpair</button></li>`)}</ul>
    <p>A program gets a token: <code>${command} pair --token NAME</code>. What it may ask: <a href="/api/">the API</a></p>
    <${Said} text=${said} /></section>`;
}
