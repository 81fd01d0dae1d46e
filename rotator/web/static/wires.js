// The wire monitor: the bytes of each link as they come, with a pause and a filter by link.
import { html, useEffect, useRef, useState } from "/ui.js";

const MOST_ROWS = 1000, AGAIN_MS = 1000;
const PIECE = /^(\d\d:\d\d:\d\d\.\d{3}) (.+?)(?:#(\d+))? ([<>]) (.*)$/, PEER = /^# (.+?)(?:#\d+)? comes from /;

function row(line, key) {
  const piece = PIECE.exec(line);
  if (piece) return { key, line, link: piece[2], at: piece[1], who: piece[3] ? `${piece[2]}#${piece[3]}` : piece[2], way: piece[4], bytes: piece[5] };
  return { key, line, link: PEER.exec(line)?.[1] ?? "", remark: line.replace(/^# /, "") };
}

/** Calls `heard` with the lines of the box and how many are missing before them, until the returned function is called.
    `upto.current`: the last line that was heard. */
function watch(upto, heard, lost) {
  let socket, again, gone = false;
  const connect = () => {
    socket = new WebSocket(`${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/api/wires${upto.current === null ? "" : `?after=${upto.current}`}`);
    socket.onmessage = (event) => {
      const told = JSON.parse(event.data);
      upto.current = told.upto;
      heard(told.lines, told.missed);
    };
    socket.onclose = () => {
      if (gone) return;
      lost();
      again = setTimeout(connect, AGAIN_MS);
    };
  };
  connect();
  return () => {
    gone = true;
    clearTimeout(again);
    socket.onmessage = null;
    socket.close();
  };
}

/** `hello`: another one after each loss of the connection: a cable that is pulled closes no WebSocket. */
export function Wires({ hello, links }) {
  const [rows, setRows] = useState([]), [link, setLink] = useState(""), [paused, setPaused] = useState(false),
    [waiting, setWaiting] = useState(0), [said, say] = useState("");
  const held = useRef([]), stopped = useRef(false), count = useRef(0), end = useRef(null), upto = useRef(null);
  useEffect(() => watch(upto, (lines, missed) => {
    say("");
    const gap = missed ? [`# ${missed} lines left out here: this browser reads too slowly`] : [];
    const more = [...gap, ...lines].map((line) => row(line, count.current++));
    if (!stopped.current) {
      setRows((seen) => [...seen, ...more].slice(-MOST_ROWS));
      return;
    }
    held.current = [...held.current, ...more].slice(-MOST_ROWS);
    setWaiting((number) => number + more.length);
  }, () => say("no connection to the box: trying again")), [hello]);
  const pause = () => {
    stopped.current = !paused;
    setPaused(!paused);
    if (!paused) return;
    const dropped = waiting - held.current.length;
    const gap = dropped > 0 ? [row(`# ${dropped} lines left out here: the pause was long`, count.current++)] : [];
    const more = [...gap, ...held.current];
    held.current = [];
    setWaiting(0);
    setRows((seen) => [...seen, ...more].slice(-MOST_ROWS));
  };
  const names = links.map((each) => each.name);
  const shown = rows.filter((each) => !link || each.link === link);
  useEffect(() => {
    if (!paused && end.current) end.current.scrollTop = end.current.scrollHeight;
  }, [shown.length, shown.at(-1)?.key, paused]);
  return html`<section class="log wires"><h2>Wires</h2>
    <p>What programs send to the box <b>${">"}</b>, and what it answers <b>${"<"}</b>, byte by byte.</p>
    <div class="fields"><label>Link<select value=${link} onChange=${(event) => setLink(event.target.value)}>
        <option value="">all</option>${names.map((name) => html`<option value=${name}>${name}</option>`)}</select></label>
      <button type="button" aria-pressed=${paused} onClick=${pause}>${paused ? `Go on${waiting ? `: ${waiting} new` : ""}` : "Pause"}</button></div>
    <p class="said" role="status">${said}</p>
    <div class="bytes" ref=${end} tabindex="0" role="region" aria-label="Bytes of the links">
      ${shown.map((each) => each.remark !== undefined ? html`<p key=${each.key} class="remark">${each.remark}</p>`
        : html`<p key=${each.key} class=${each.way === ">" ? "came" : "went"}><span class="at">${each.at}</span> <span
          class="who">${each.who}</span> <b>${each.way}</b> <code>${each.bytes}</code></p>`)}
      ${!shown.length && html`<p class="remark">Nothing has come yet.</p>`}</div></section>`;
}
