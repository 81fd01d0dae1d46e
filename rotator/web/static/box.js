// The box as the page sees it: pictures come over a WebSocket, orders go by POST. Knows no element of the page.

const OLD_MS = 1500, AGAIN_MS = 1000, SIGN_MS = 120;
// After so long without a picture the connection is taken for dead. A plug that is pulled closes no socket.
// The first picture of a new connection may take longer each time: browsers themselves delay those that fail often.
const SILENT_MS = 3000, MOST_SILENT_MS = 10_000;
const NO_ANSWER = "the box does not answer", LOST = "the connection was lost: the antenna has stopped";

function within(ms) {
  const quits = new AbortController();
  setTimeout(() => quits.abort(), ms);
  return quits.signal;
}

async function told(answer) {
  const found = await answer.json().catch(() => undefined);
  if (!answer.ok) throw new Error(found?.error ?? `the box answers ${answer.status}`);
  // Cut off within: by a new start of the box, by a bad network, or after all the patience of this page.
  if (found === undefined) throw new Error(NO_ANSWER);
  return found;
}

/** Let it move again. A stop that has come since this picture counts more, also where this request takes longer. */
export const resume = (now, how = "resume") => post(how, {}, { "If-Match": `"${now.stops}"` });

/** Ask the box for something. Throws an Error with the box's own sentence. */
export const post = (path, values, headers) =>
  asked(path, { headers: { "Content-Type": "application/json", ...headers }, body: JSON.stringify(values ?? {}), keepalive: true, signal: within(5000) });

/** Send a file. The box may take a while to check it. */
export const send = (path, file) => asked(path, { body: file, signal: within(60_000) });

/** Send a backup. Throws an Error with the box's own sentence. */
export const upload = (path, file) =>
  asked(path, { headers: { "Content-Type": "application/zip" }, body: file, signal: within(20_000) });

/** Read something. Null: the box still computes it, so ask again. Throws an Error with the box's own sentence. */
export async function read(path) {
  const answer = await answered(path, { signal: within(5000) });
  return answer.status === 202 ? null : told(answer);
}

const asked = async (path, request) => told(await answered(path, { method: "POST", ...request }));

async function answered(path, request) {
  try {
    return await fetch(`/api/${path}`, request);
  } catch {
    throw new Error(NO_ANSWER);
  }
}

let boxAheadMs = 0;

/** How a person at the box types its program: after `make run` it is a path. */
export let command = "rotator";

/** The time by the box's clock, in ms since 1970: a phone's own may be wrong, and all that the box tells is by its own. */
export const boxTime = () => Date.now() + boxAheadMs;

/** The live connection. `changed` is called with {now, hello, fresh, old, locked} at each picture, and when pictures stop
    coming. `locked`: the box shows itself to paired browsers alone, and this one is none. */
export class Live {
  constructor(changed) {
    this.changed = changed;
    this.picture = null;
    this.hello = null;
    this.held = null;
    this.latest = null;
    this.locked = false;
    this.number = 0;
    this.press = 0;
    this.seen = 0;
    this.patience = SILENT_MS;
    this.connect();
    setInterval(() => this.look(), 500);
    document.addEventListener("visibilitychange", () => (document.hidden ? this.letGo() : this.connect()));
    addEventListener("blur", () => this.letGo());
    addEventListener("pagehide", () => this.letGo());
    // A sleeping computer's clock may stand still, so the last picture looks fresh when it wakes.
    addEventListener("pageshow", (event) => event.persisted && this.connect());
    addEventListener("online", () => this.connect());
    addEventListener("rotator-stop", (event) => {
      this.letGo();
      this.send({ stop: true, key: event.detail });
    });
  }

  /** A new connection in place of the old one: also when who this browser is has changed. */
  connect() {
    clearTimeout(this.again);
    if (this.socket) {
      this.socket.onmessage = this.socket.onclose = null;
      this.socket.close();
      this.ended(LOST);
    }
    const socket = new WebSocket(`${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/api/live`);
    this.socket = socket;
    this.heard = performance.now();
    socket.onmessage = (event) => {
      const told = JSON.parse(event.data);
      if (told.refused) {
        // A short press may be over by now: its reason counts all the same, and no older one ends a new press.
        if (told.press === this.press && !this.ended(told.refused)) this.latest?.(told.refused);
        return;
      }
      if (!told.now) return;
      if (told.hello) {
        this.hello = told.hello;
        command = told.hello.box.command;
      }
      this.number = told.n;
      this.picture = told.now;
      this.locked = false;
      boxAheadMs = told.now.utc_s * 1000 - Date.now();
      this.seen = this.heard = performance.now();
      this.patience = SILENT_MS;
      this.tell();
    };
    socket.onclose = () => {
      this.ended(LOST);
      this.again = setTimeout(() => this.connect(), AGAIN_MS);
      this.askWhy();
    };
  }

  /** A WebSocket that is refused does not say why. */
  async askWhy() {
    const answer = await fetch("/api/status", { signal: within(5000) }).catch(() => null);
    this.locked = answer?.status === 401;
    if (this.locked) this.picture = null;
    this.tell();
  }

  get fresh() {
    return this.picture !== null && performance.now() - this.seen < OLD_MS;
  }

  look() {
    if (this.fresh) return;
    this.ended(LOST);
    this.tell();
    if (performance.now() - this.heard < this.patience) return;
    this.patience = Math.min(MOST_SILENT_MS, 1.5 * this.patience);
    this.connect();
  }

  tell() {
    this.changed({ now: this.picture, hello: this.hello, fresh: this.fresh, old: performance.now() - this.seen, locked: this.locked });
  }

  send(sign) {
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(sign));
  }

  /** A button is held: the box hears it again and again, and stops by itself when it hears nothing. `ended`: it turns no
      more, with the reason; an empty one where it was let go. */
  hold(turn, ended) {
    this.letGo();
    if (!this.fresh || this.socket.readyState !== WebSocket.OPEN) {
      ended("there is no connection to the box: nothing turns");
      return;
    }
    this.press += 1;
    this.held = this.latest = ended;
    const sign = () => this.send({ hold: turn, press: this.press, n: this.number });
    sign();
    this.signs = setInterval(sign, SIGN_MS);
  }

  letGo() {
    if (this.ended("")) this.send({ let_go: true });
  }

  /** The button that was held is held no more. Returns whether one was. */
  ended(reason) {
    const held = this.held;
    if (!held) return false;
    clearInterval(this.signs);
    this.held = null;
    held(reason);
    return true;
  }
}
