// What is wired where: the Pi's header with the pins that the file uses, and the chips on its buses.
import { html } from "/ui.js";

// By pin of the header: a GPIO number, or what else it is. Odd pins are the left row.
const PINS = ["3.3 V", "5 V", 2, "5 V", 3, "GND", 4, 14, "GND", 15, 17, 18, 27, "GND", 22, 23, "3.3 V", 24, 10, "GND", 9, 25, 11, 8, "GND", 7,
  0, 1, 5, "GND", 6, 12, 13, "GND", 19, 16, 26, 20, "GND", 21];
const ROW = 15;

export function Header({ wiring }) {
  const used = Object.fromEntries(wiring.pins.map(({ gpio, key }) => [gpio, key]));
  if (wiring.chips.some((chip) => chip.bus === 1)) used[2] ??= "SDA", used[3] ??= "SCL";
  const away = wiring.pins.filter(({ gpio }) => !PINS.includes(gpio));
  return html`<figure class="wiring">
    <svg viewBox=${`8 0 404 ${20 * ROW + 12}`} role="img" aria-label="The header of the Pi, seen from above: the pins of this file by name">
      <rect class="board" x="174" y="2" width="72" height=${20 * ROW + 8} rx="4" />
      ${PINS.map((what, at) => {
        const left = at % 2 === 0, y = 14 + Math.floor(at / 2) * ROW, name = used[what], gpio = typeof what === "number";
        return html`<g class=${name ? "used" : what === "GND" ? "ground" : ""}>
          <circle cx=${left ? 198 : 222} cy=${y} r="5" /><text class="pin" x=${left ? 187 : 233} y=${y + 3}
            text-anchor=${left ? "end" : "start"}>${at + 1}</text>
          ${(name || !gpio) && html`<text x=${left ? 168 : 252} y=${y + 3.5} text-anchor=${left ? "end" : "start"}>
            ${name ? (name.includes(".") ? `${name} = ${what}` : name) : what}</text>`}</g>`;
      })}</svg>
    <figcaption><span>Pin 1 is at the corner of the card's slot.</span>${away.map(({ gpio, key }) => html`<span>${key}: GPIO ${gpio}</span>`)}</figcaption>
    <ul>${wiring.chips.map(({ name, bus, address }) => html`<li>${name}: I2C bus ${bus}, address 0x${address.toString(16).padStart(2, "0")}</li>`)}
      ${wiring.active && html`<li>The relay board closes a relay at ${wiring.active === "high" ? "3.3 V" : "0 V"} (<code>relays.active = "${wiring.active}"</code>).</li>`}</ul></figure>`;
}
