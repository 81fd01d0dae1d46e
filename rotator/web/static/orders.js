// What cannot be ordered now is not offered: why the antenna would not move, beside the controls that would move it. The
// box refuses all the same; the rule is `rotator/control/rights.py`, as a person at this browser meets it.
import { html } from "/ui.js";

/** Why no order of this browser moves the antenna now; empty: it does. `jog`: of buttons that are held. */
export function hindrance({ status, stopper, holder, mode_by: by, mode_switch: panel }, hello, jog) {
  const mode = status.panel_mode.toUpperCase(), own = status.mode_by === hello.source;
  if (stopper) return "It is stopped: let it move again first, at the top of the page.";
  if (status.held_by && status.held_by !== hello.source) return `${holder} holds the antenna: take it over first.`;
  if (mode === "AUTO" || (own && mode === "MANUAL") || (own && mode === "JOG" && jog)) return "";
  if (panel) return `The panel's switch is at ${mode}.`;
  return own && mode === "JOG" ? "In the mode JOG only the buttons that you hold turn it." : `The mode is ${mode}: choose AUTO first.`;
}

/** Controls that move the antenna. `quiet`: the reason stands beside others of them. */
export function Orders({ now, hello, jog, quiet, children }) {
  const why = hindrance(now, hello, jog);
  return html`<fieldset class="orders" disabled=${why !== ""}>${!quiet && why && html`<p class="why" role="status">${why}</p>`}${children}</fieldset>`;
}
