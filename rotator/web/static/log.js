// The log of the box: what has happened, the latest first, with a filter; what is shown can be copied and saved.
import { read } from "/box.js";
import { html, Said, useEvery, useState } from "/ui.js";

const EVERY_MS = 2000, RANKS = { note: "all", warning: "warnings and errors", error: "errors" };

const time = (seconds) => new Date(seconds * 1000).toLocaleString(undefined, { dateStyle: "short", timeStyle: "medium" });

const asText = (lines) => lines.map((line) => `${new Date(line.at_s * 1000).toISOString()} ${line.rank.padEnd(7)} ${line.text}\n`).reverse().join("");

/** A page without encryption has no clipboard of its own: the text goes through a field. */
function copy(text) {
  const field = document.createElement("textarea");
  field.value = text;
  document.body.append(field);
  field.select();
  const done = document.execCommand("copy");
  field.remove();
  return done;
}

function save(text) {
  const link = document.createElement("a"), address = URL.createObjectURL(new Blob([text], { type: "text/plain" }));
  link.href = address;
  link.download = "rotator-log.txt";
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 1000);
}

export function Log() {
  const [lines, setLines] = useState([]), [words, setWords] = useState(""), [rank, setRank] = useState("note"),
    [said, say] = useState(""), [copied, setCopied] = useState("");
  useEvery(EVERY_MS, () => read("log").then((told) => (setLines(told.lines), say("")), (fault) => say(fault.message)));
  const order = Object.keys(RANKS), wanted = words.toLowerCase();
  const shown = lines.filter((line) => order.indexOf(line.rank) >= order.indexOf(rank) && line.text.toLowerCase().includes(wanted));
  return html`<section class="log"><h2>Log</h2>
    <form onSubmit=${(event) => event.preventDefault()}>
      <label>Only lines with<input type="search" value=${words} onInput=${(event) => setWords(event.target.value)} /></label>
      <div class="choice" role="group" aria-label="Which lines">${order.map((each) => html`<button type="button" aria-pressed=${rank === each}
        onClick=${() => setRank(each)}>${RANKS[each]}</button>`)}</div>
      <div class="choice" role="group" aria-label="What is shown">
        <button type="button" onClick=${() => setCopied(copy(asText(shown)) ? shown.length === 1 ? `${shown.length} line copied` : `${shown.length} lines copied` : "this browser does not copy")}>Copy</button>
        <button type="button" onClick=${() => save(asText(shown))}>Save</button><span role="status">${copied}</span></div></form>
    <table><thead><tr><th scope="col">when</th><th scope="col">what</th></tr></thead>
      <tbody>${shown.map((line) => html`<tr class=${line.rank}><td><time>${time(line.at_s)}</time></td><td>${line.text}</td></tr>`)}</tbody></table>
    ${!shown.length && html`<p>${lines.length ? "No line has that." : "Nothing has been logged since the start."}</p>`}
    <${Said} text=${said} /></section>`;
}
