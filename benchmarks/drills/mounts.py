"""How a mast was put up: where its scale begins, how far it may turn, how exactly it is to point, where it parks, and
which sensors it has.

Draws keys of the configuration with a random stream of its own: all other keys of a box depend on its seed only. Knows
no event of a drill.
"""

from __future__ import annotations

import random
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from benchmarks.drills.boxes import BOTH, RELAYS, Mast

SENSORS_SHARE = 0.15
SHARE = 0.4
"""The share of boxes that are mounted otherwise than the shipped file says."""
CLEAR_DEG = 6.0
"""The antenna stands at least this far inside its range at the start."""
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


def mounted(chance: random.Random, mast: Mast) -> Mast:
    """The same box on a mast that was put up in another way."""
    if chance.random() >= SHARE:
        return mast
    tables: dict[str, Any] = {**mast.tables, **{axis: dict(mast.tables.get(axis, {})) for axis in BOTH}}
    mount = dict(tables.get("mount", {}))
    if chance.random() < 0.5:  # a stop in the south, a mast that was clamped a little beside north
        tables["azimuth"]["offset_deg"] = chance.choice((180.0, -180.0, 90.0, -90.0, round(chance.uniform(-30, 30), 1)))
    if chance.random() < 0.3:
        tables["elevation"]["offset_deg"] = round(chance.uniform(-6.0, 6.0), 1)
    if mast.rotor.kind in ("relay-pot", "digipot"):
        for axis, at_deg, top_deg in zip(BOTH, mast.start_deg, mast.top_deg, strict=True):
            if chance.random() < 0.3 and "forbidden" not in mount:
                _narrow(chance, tables[axis], at_deg, top_deg)
            if chance.random() < 0.3:
                tables[axis]["tolerance_deg"] = chance.choice((1.0, 2.0, 8.0))
    if mast.rotor.relays:
        if chance.random() < 0.3:
            mount["tolerance"] = "axis"
        if chance.random() < 0.3:
            for axis in BOTH:
                tables[axis] |= {"longest_run_s": chance.choice((20.0, 60.0)), "rest_s": chance.choice((10.0, 60.0))}
    if chance.random() < 0.3 and "forbidden" not in mount:
        low_deg, high_deg = _range(tables["azimuth"], mast.top_deg[0])
        mount["park_azimuth_deg"] = round(chance.uniform(low_deg, min(high_deg, 450.0)))
        low_deg, high_deg = _range(tables["elevation"], mast.top_deg[1])
        mount["park_elevation_deg"] = round(chance.uniform(low_deg, high_deg))
    if mount:
        tables["mount"] = mount
    return replace(mast, tables=tables)


def braked(chance: random.Random, mast: Mast) -> Mast:
    """The same box with a brake on azimuth, or on both axes, if relays drive it."""
    if not mast.rotor.relays or chance.random() >= SHARE:
        return mast
    return replace(mast, tables=with_brakes(chance, mast.rotor.kind, mast.tables))


def with_brakes(chance: random.Random, kind: str, tables: Mapping[str, Any]) -> dict[str, Any]:
    """These tables, with brakes on pins that no header has, so that nothing else is there."""
    more = dict(tables)
    for axis, line in zip(BOTH, (28, 29), strict=True):
        if axis == BOTH[0] or chance.random() < 0.5:
            keys: dict[str, Any] = {"line": line, "engage_s": chance.choice((2.0, 4.0, 8.0))}
            keys |= {"release_s": chance.choice((0.3, 0.5, 1.0)), "rock": kind == "relay-pot" and chance.random() < 0.5}
            more[axis] = {**more.get(axis, {}), "brake": keys}
    return more


def _narrow(chance: random.Random, table: dict[str, Any], at_deg: float, top_deg: float) -> None:
    """Limit the range by a tree or a wall. The start angle `at_deg` stays inside."""
    low_deg = max(0.0, min(round(chance.uniform(0.0, 40.0)), at_deg - CLEAR_DEG))
    high_deg = min(top_deg, max(round(top_deg - chance.uniform(0.0, 60.0)), at_deg + CLEAR_DEG))
    table |= {"min_deg": low_deg, "max_deg": high_deg}


def _range(table: dict[str, Any], top_deg: float) -> tuple[float, float]:
    return table.get("min_deg", 0.0), table.get("max_deg", top_deg)


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
    if "forbidden" in mount:
        within = [
            each
            for each in mount["forbidden"]
            if low_deg < each["azimuth_deg"][1] and each["azimuth_deg"][0] < high_deg
        ]
        tables["mount"] = {**mount, "forbidden": within}
    top_deg = high_deg, mast.top_deg[1]
    return replace(mast, rotor=rotor, tables=tables, start_deg=start_deg, top_deg=top_deg, has_pots=False)


def _merged(tables: dict[str, Any], more: dict[str, Any]) -> dict[str, Any]:
    return tables | {name: {**tables.get(name, {}), **keys} for name, keys in more.items()}
