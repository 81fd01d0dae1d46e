// The doctor: each check with its mark, and what to do. The box examines itself in a process of its own.
import { read } from "/box.js";
import { html, Said, said, useEffect, useRef, useState, verbatim } from "/ui.js";

const COMPUTES_MS = 700, TICK_MS = 5000;
const MARKS = { wrong: ["✗", "to repair"], warning: ["!", "warning"], good: ["✓", "good"], skipped: ["–", "not checked"] };

function markOf(check) {
  if (check.ok === null) return "skipped";
  return check.ok ? (check.advice ? "warning" : "good") : "wrong";
}

function verdict(checks) {
  const count = (mark) => checks.filter((check) => markOf(check) === mark).length;
  const wrong = count("wrong"), warnings = count("warning"), skipped = count("skipped");
  const parts = [wrong && `${wrong} to repair`, warnings && (warnings === 1 ? `${warnings} warning` : `${warnings} warnings`)].filter(Boolean).map(said);
  return verbatim(`${parts.join(", ") || said("No problem found")}${skipped ? `, ${said(`${skipped} not checked`)}` : ""}.`);
}

const ago = (seconds) => (seconds < 60 ? "just now" : `${Math.floor(seconds / 60)} min ago`);

export function Doctor() {
  const [told, setTold] = useState(null), [said, say] = useState(""), [busy, setBusy] = useState(false), [, tick] = useState(0),
    asking = useRef(null);
  const ask = () => {
    setBusy(true);
    read("doctor").then((found) => {
      if (!found) {
        asking.current = setTimeout(ask, COMPUTES_MS);
        return;
      }
      setTold({ ...found, seen: performance.now() });
      say("");
      setBusy(false);
    }, (fault) => (say(fault.message), setBusy(false)));
  };
  useEffect(() => {
    ask();
    const timer = setInterval(() => tick((count) => count + 1), TICK_MS);
    return () => (clearTimeout(asking.current), clearInterval(timer));
  }, []);
  // What is to be done comes first; else in the order of the report.
  const found = told?.checks ?? [], pressing = (check) => Number(markOf(check) === "wrong") * 2 + Number(markOf(check) === "warning");
  const checks = [...found].sort((one, other) => pressing(other) - pressing(one));
  return html`<section class="log doctor"><h2>Doctor</h2>
    <p class="verdict"><span role="status">${busy ? "The box examines itself …" : told ? verdict(checks) : ""}</span>
      ${told && !busy && html` <small>${ago((performance.now() - told.seen) / 1000)}</small>`}</p>
    <p><button type="button" disabled=${busy} onClick=${ask}>Check again</button></p>
    <${Said} text=${said} />
    <ul>${checks.map((check, at) => {
      const mark = markOf(check), [sign, meaning] = MARKS[mark];
      return html`<li class=${mark}><b aria-hidden="true">${sign}</b><span class="only-read">${meaning}:</span>
        ${checks[at - 1]?.name === check.name ? html`<span></span>` : html`<h3>${check.name}</h3>`}
        <p>${check.found}${check.advice && html`<span class="advice">${check.advice}</span>`}</p></li>`;
    })}</ul></section>`;
}
