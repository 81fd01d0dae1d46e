"""What few boxes have: other sensors, several forbidden sectors, programs of other families, tables of a pass, hours.

Draws from a stream of its own, so that a drill of the same seed is else the same. Does not know what is right or wrong.
"""

from __future__ import annotations

import random
from dataclasses import replace
from typing import Any

from benchmarks.drills.arcs import Arc
from benchmarks.drills.boxes import BOTH, RELAYS, Mast
from benchmarks.drills.script import OTHER_LINKS, PAGE, Event

SUPPLY_SHARE, SENSORS_SHARE, SECTORS_SHARE, LINKS_SHARE, TABLES_SHARE, HOURS_SHARE = 0.15, 0.15, 0.1, 0.25, 0.3, 0.0025
REPLACED = ("gs232a", "easycomm2", "easycomm3", "pstrotator")
ORDERS_MOST = 6
MCP3208 = {"adc": {"kind": "mcp3208"}}
TURN_DEG = (10.0, 350.0)
"""An AS5600 reads one turn: the range of its axis must end before the reading jumps."""
AS5600 = {
    "azimuth": {
        "min_deg": TURN_DEG[0],
        "max_deg": TURN_DEG[1],
        "calibration": [[TURN_DEG[0] / 360.0, TURN_DEG[0]], [TURN_DEG[1] / 360.0, TURN_DEG[1]]],
        "lowest_reading": 0.02,
        "highest_reading": 0.98,
        "sensor": {"kind": "as5600"},
    },
    "elevation": {"sensor": {"kind": "mpu6050", "forward": "-y", "up": "+z"}},
}
CHIPS = ("azimuth-as5600-gone", "azimuth-magnet-missing", "mpu6050-gone")
CHIPS_SPORADIC = ("azimuth-as5600-noisy", "azimuth-as5600-gaps", "mpu6050-noisy", "mpu6050-gaps")
ROOM_DEG = 4.0
SECTORS = (2, 2, 3)


def sensed(chance: random.Random, mast: Mast) -> Mast:
    """The same box with another converter, or with chips that need no converter."""
    if mast.rotor.kind != "relay-pot" or mast.commissioning or chance.random() >= SENSORS_SHARE:
        return mast
    if chance.random() < 0.5:
        rotor = replace(mast.rotor, shared_sporadic=())
        return replace(mast, rotor=rotor, tables=_merged(mast.tables, MCP3208))
    low_deg, high_deg = TURN_DEG
    start_deg = min(max(mast.start_deg[0], low_deg + 1.0), high_deg - 1.0), min(mast.start_deg[1], 90.0)
    rotor = replace(
        mast.rotor, faults=(*RELAYS, "stop-early"), shared=CHIPS, sporadic=(), shared_sporadic=CHIPS_SPORADIC
    )
    tables = _merged(mast.tables, AS5600)
    mount = tables.get("mount", {})
    if any(low >= high_deg for low, _ in (sector["azimuth_deg"] for sector in mount.get("forbidden", []))):
        tables["mount"] = {key: value for key, value in mount.items() if key != "forbidden"}
    top_deg = high_deg, mast.top_deg[1]
    return replace(mast, rotor=rotor, tables=tables, start_deg=start_deg, top_deg=top_deg, has_pots=False)


def fenced(chance: random.Random, mast: Mast) -> Mast:
    """Two or three forbidden sectors, the first one right beside the park position."""
    mount = dict(mast.tables.get("mount", {}))
    if chance.random() >= SECTORS_SHARE or "forbidden" in mount:
        return mast
    tables = [mast.tables.get(axis, {}) for axis in BOTH]
    ends_deg = [(table.get("min_deg", 0.0), table.get("max_deg", 1e3)) for table in tables]
    parks_deg = mount.get("park_azimuth_deg", 180.0), mount.get("park_elevation_deg", 0.0)
    # As `configured` does it.
    park_deg = tuple(min(max(at, least), most) for at, (least, most) in zip(parks_deg, ends_deg, strict=True))
    free = [park_deg, (0.0, 0.0), (180.0, 0.0), (90.0, 90.0), mast.start_deg]
    found: list[dict[str, Any]] = []
    many = chance.choice(SECTORS)
    for number in range(20):
        spans = []
        for axis in range(2):
            wide_deg = chance.choice((5.0, 10.0, 20.0))
            low_deg = float(round(chance.uniform(0.0, mast.top_deg[axis] - wide_deg)))
            if not found and axis == number % 2:  # this axis would turn from the park position into the sector
                beside_deg = round(park_deg[axis]) + chance.choice((ROOM_DEG + 1.0, -ROOM_DEG - 1.0 - wide_deg))
                low_deg = min(max(0.0, beside_deg), mast.top_deg[axis] - wide_deg)
            elif not found:
                low_deg = max(0.0, round(park_deg[axis] - wide_deg / 2.0))
            spans.append([low_deg, low_deg + wide_deg])
        clear = not any(
            all(low - ROOM_DEG < at < high + ROOM_DEG for at, (low, high) in zip(place, spans, strict=True))
            for place in free
        )
        within = all(low >= least and high <= most for (low, high), (least, most) in zip(spans, ends_deg, strict=True))
        if clear and within:
            found.append({"name": f"chimney {len(found)}", "azimuth_deg": spans[0], "elevation_deg": spans[1]})
        if len(found) == many:
            break
    return replace(mast, tables=mast.tables | {"mount": mount | {"forbidden": found}}) if found else mast


def relinked(chance: random.Random, events: list[Event]) -> list[Event]:
    """The same events, with one of the programs replaced by a program of another protocol family."""
    used = sorted({event.who for event in events if event.who in REPLACED})
    if not used or chance.random() >= LINKS_SHARE:
        return events
    before, after = chance.choice(used), chance.choice(OTHER_LINKS)
    return [replace(event, who=after) if event.who == before else event for event in events]


def tabled(chance: random.Random, events: list[Event]) -> list[Event]:
    """The same events, with some tracked arcs replaced by timed tables of their directions."""
    return [
        replace(event, args=(_table(event),)) if _may_be_table(event) and chance.random() < TABLES_SHARE else event
        for event in events
    ]


def _may_be_table(event: Event) -> bool:
    return event.what == "track" and event.who != PAGE and event.text(0).startswith("arc")


def _table(event: Event) -> str:
    arc = Arc.parse(event.text(0))
    begin_s, end_s = arc.around(event.at_s)
    begin_s = max(begin_s, event.at_s)
    every_s = max(1.0, (end_s - begin_s) / 20.0)
    rows = []
    for number in range(int((end_s - begin_s) / every_s) + 1):
        azimuth_deg, elevation_deg = arc.direction(min(begin_s + number * every_s, end_s - 0.01))
        rows.append(f"{begin_s - event.at_s + number * every_s:.1f},{azimuth_deg:.1f},{elevation_deg:.1f}")
    return f"table {';'.join(rows)}"


def prolonged(chance: random.Random, mast: Mast, events: list[Event], seconds: float) -> tuple[list[Event], float]:
    """Sometimes hours follow in which little happens, so that a slow fault has time to show."""
    if chance.random() >= HOURS_SHARE:
        return events, seconds
    ends_s = chance.uniform(1.0, 3.0) * 3600.0
    more = list(events)
    for _ in range(chance.randrange(1, ORDERS_MOST)):
        at_s = round(chance.uniform(seconds, ends_s), 1)
        aim_deg = [float(round(chance.uniform(0.0, top_deg))) for top_deg in mast.top_deg]
        more.append(Event(at_s, "console", "resume") if chance.random() < 0.3 else Event(at_s, "rotctld", "stop"))
        more.append(Event(at_s + 1.0, "rotctld", "aim", tuple(aim_deg)))
    return more, ends_s


def _merged(tables: dict[str, Any], more: dict[str, Any]) -> dict[str, Any]:
    return tables | {name: {**tables.get(name, {}), **keys} for name, keys in more.items()}


def supplied(chance: random.Random, mast: Mast) -> Mast:
    """The same box, with an input of its converter that measures the pots' supply."""
    kind = mast.tables.get("adc", {}).get("kind", "ads1115")
    if not mast.has_pots or kind != "ads1115" or chance.random() >= SUPPLY_SHARE:
        return mast
    return replace(mast, tables=_merged(mast.tables, {"adc": {"reference_channel": 2}}))


def unusual(chance: random.Random, mast: Mast) -> Mast:
    return supplied(chance, fenced(chance, sensed(chance, mast)))
