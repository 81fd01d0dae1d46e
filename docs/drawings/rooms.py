"""The picture of the rooms in docs/architecture.md: three buildings, the rooms of each in floors, an import goes down.

Knows what each room is for, in a few words, and how to draw it. The rooms and the arrows come from the imports.
"""

from __future__ import annotations

from html import escape

from docs.drawings.floors import BOX_W, Plan, plan
from docs.drawings.imports import PACKAGES, Arrows, within, without_detours
from docs.drawings.svg import FONT

CAPTIONS = {
    "rotator.cli": "the commands",
    "rotator.box": "starts and stops",
    "rotator.views": "LCD, terminal",
    "rotator.web": "page, API",
    "rotator.mqtt": "Home Assistant",
    "rotator.doctor": "checks a machine",
    "rotator.calibrating": "sets an axis up",
    "rotator.rehearsal": "simulated passes",
    "rotator.assembly": "puts it together",
    "rotator.backup": "saves, restores",
    "rotator.monitor": "tap, transcripts",
    "rotator.links": "move bytes",
    "rotator.runtime": "threads, loop",
    "rotator.setup": "boot pins, USB port",
    "rotator.rotors": "one file a kind",
    "rotator.config": "the TOML file",
    "rotator.control": "decides; pure",
    "rotator.orbits": "the sky; pure",
    "rotator.tracking": "plans, tracks",
    "rotator.fetching": "fetches elements",
    "rotator.panel": "switches, knobs",
    "rotator.protocols": "bytes ⇄ orders",
    "rotator.store": "files kept",
    "rotator.exchange": "orders, status",
    "rotator.languages": "catalogues",
    "hw.ports": "the interfaces",
    "hw.interpolation": "points and lines",
    "hw.urgent": "threads that go first",
    "hw.buses": "GPIO, I2C, SPI",
    "hw.chips": "one file a chip",
    "hw.drives": "what turns motors",
    "hw.sensors": "angle, count, switch",
    "hw.safety": "guard, sentinel",
    "hw.moteus": "CAN-FD motors",
    "hw.controllers": "ready-made ones",
    "firmware_sim.clock": "simulated time",
    "firmware_sim.sporadic": "each n-th time",
    "firmware_sim.buses": "wires, lines",
    "firmware_sim.chips": "by register",
    "firmware_sim.parts": "motors, pots",
    "firmware_sim.moteus": "CAN-FD motors",
    "firmware_sim.controllers": "ready-made ones",
    "firmware_sim.faults": "by name",
    "firmware_sim.panel": "switches, lamps",
    "firmware_sim.rotors": "one file a kind",
    "firmware_sim.arduino": "the F1EFW sketch",
    "firmware_sim.world_file": "kept angles",
}
ABOUT = {
    "rotator": "the program",
    "hw": "drivers: know neither the program nor the simulator",
    "firmware_sim": "the simulated world: shares nothing with what it tests",
}
FILLS = {"rotator": "#eef3fb", "hw": "#eef5ea", "firmware_sim": "#fbf3e6"}
INK, FAINT, ARROW = "#222", "#666", "#7a8797"
BOX_H, FLOOR_H, PAD, HEAD = 44, 82, 20, 62
"""In pixels: a box's height, a floor's, the space within a building's walls and for its name."""
APART = 60


def rooms_svg(arrows: Arrows) -> str:
    """Raises ValueError where rooms of one package import each other in a circle."""
    plans = {package: plan(without_detours(within(arrows, package))) for package in PACKAGES}
    size = {
        package: (max(one.width, 330) + 2 * PAD, HEAD + PAD + FLOOR_H * len(one.levels) - (FLOOR_H - BOX_H))
        for package, one in plans.items()
    }
    right_x = PAD + size["rotator"][0] + APART
    hw_wide = max(size["hw"][0], size["firmware_sim"][0])
    wide = right_x + hw_wide + PAD
    notes = {package: _users(arrows, package) for package in ("hw", "firmware_sim")}
    stacked = size["hw"][1] + APART + size["firmware_sim"][1] + 40 * 2
    high = 2 * PAD + max(size["rotator"][1], stacked)
    sim_y = PAD
    hw_y = high - PAD - size["hw"][1] - 40
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {wide:.0f} {high:.0f}" font-family="{FONT}">',
        "<title>The rooms of the source and their imports</title>",
        f'<defs><marker id="tip" markerWidth="9" markerHeight="8" refX="8" refY="4" orient="auto">'
        f'<path d="M0 0 L9 4 L0 8 Z" fill="{ARROW}"/></marker></defs>',
        f'<rect width="{wide:.0f}" height="{high:.0f}" fill="white"/>',
        *_building("rotator", plans["rotator"], (PAD, PAD), size["rotator"][0], high - 2 * PAD),
        *_building("firmware_sim", plans["firmware_sim"], (right_x, sim_y), hw_wide, size["firmware_sim"][1]),
        *_building("hw", plans["hw"], (right_x, hw_y), hw_wide, size["hw"][1]),
    ]
    for package, y in (("firmware_sim", sim_y), ("hw", hw_y)):
        across = y + size[package][1] / 2
        from_x, to_x = PAD + size["rotator"][0], right_x - 2
        parts.append(_arrow(f"M{from_x:.0f} {across:.0f} H{to_x:.0f}", 3))
        for row, line in enumerate(notes[package]):
            parts.append(_text(right_x, y + size[package][1] + 18 + 17 * row, line, 13, FAINT))
    return "\n".join((*parts, "</svg>")) + "\n"


def _users(arrows: Arrows, package: str) -> list[str]:
    """Which rooms of the program import it; of the hardware's ports every room may know."""
    free = {"hw.ports"}
    users = [
        room.removeprefix("rotator.")
        for room, there in arrows.items()
        if room.startswith("rotator.") and any(each.startswith(f"{package}.") for each in there - free)
    ]
    names = f"imported by {', '.join(users)}"
    return [names, "its ports by most other rooms too"] if package == "hw" else [names]


def _building(package: str, one: Plan, at: tuple[float, float], wide: float, high: float) -> list[str]:
    x, y = at
    inset = x + (wide - one.width) / 2
    ground = y + high - PAD - BOX_H
    spare = high - HEAD - PAD - BOX_H
    floor_h = spare / max(len(one.levels) - 1, 1)
    level_y = {id(spot): ground - floor_h * at for at, level in enumerate(one.levels) for spot in level}
    parts = [
        f'<rect x="{x:.0f}" y="{y:.0f}" width="{wide:.0f}" height="{high:.0f}" rx="10" fill="{FILLS[package]}"/>',
        _text(x + PAD, y + 28, f"{package}/", 18, INK, bold=True),
        _text(x + PAD, y + 47, ABOUT[package], 13, FAINT),
    ]
    for way in one.ways:
        start, *lanes, end = way
        path = f"M{inset + start.x:.0f} {level_y[id(start)] + BOX_H:.0f}"
        last_x, last_y = inset + start.x, level_y[id(start)] + BOX_H
        for spot in (*lanes, end):
            to_x, to_y = inset + spot.x, level_y[id(spot)]
            half = (to_y - last_y) / 2
            path += f" C{last_x:.0f} {last_y + half:.0f} {to_x:.0f} {to_y - half:.0f} {to_x:.0f} {to_y:.0f}"
            last_x, last_y = to_x, to_y
            if spot is not end:
                last_y = to_y + BOX_H
                path += f" V{last_y:.0f}"
        parts.append(_arrow(path, 1.6))
    for level in one.levels:
        for spot in level:
            if spot.room:
                parts += _box(spot.room, inset + spot.x, level_y[id(spot)])
    return parts


def _box(room: str, middle: float, y: float) -> list[str]:
    return [
        f'<rect x="{middle - BOX_W / 2:.0f}" y="{y:.0f}" width="{BOX_W:.0f}" height="{BOX_H}" rx="5" fill="white"'
        f' stroke="{INK}" stroke-width="1.5"/>',
        _text(middle, y + 19, room.split(".")[1], 15, INK, anchor="middle", bold=True),
        _text(middle, y + 36, CAPTIONS.get(room, ""), 12, FAINT, anchor="middle"),
    ]


def _arrow(path: str, wide: float) -> str:
    return f'<path d="{path}" fill="none" stroke="{ARROW}" stroke-width="{wide:g}" marker-end="url(#tip)"/>'


def _text(x: float, y: float, text: str, size: int, colour: str, *, anchor: str = "start", bold: bool = False) -> str:
    weight = ' font-weight="bold"' if bold else ""
    where = f'x="{x:.0f}" y="{y:.0f}" font-size="{size}" text-anchor="{anchor}"'
    return f'<text {where}{weight} fill="{colour}">{escape(text)}</text>'
