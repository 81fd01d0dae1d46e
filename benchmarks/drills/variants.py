"""How the boxes of the newer kinds differ: a controller's protocol, a stepper's end and encoder; and one axis alone.

Draws keys of the configuration with random streams of its own, as `mounts` does. Knows no event of a drill.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

from benchmarks.drills.boxes import BOTH, Mast

ALONE_SHARE, OWN_SHARE, INDEX_SHARE = 0.2, 0.3, 0.4
"""The shares of boxes with one axis alone, of those behind controllers where each axis has its own, and of axes with
bridges that have an index."""
PROTOCOLS = ("rotctld", "gs232a", "gs232b", "easycomm2", "easycomm3", "rot2prog", "md01", "rot1prog", "dcu1")
AZIMUTH_ONLY = ("rot1prog", "dcu1")
ENDS = ("switch", "switch", "stall", "none")
SPEED_ERROR = 0.03
"""The simulated TV rotator is up to 2.5 % faster or slower than its label says."""


def varied(chance: random.Random, mast: Mast) -> Mast:
    """The same box with what its kind leaves open."""
    draw = VARIANTS.get(mast.rotor.kind)
    if draw is None:
        return mast
    tables = dict(mast.tables)
    for name, keys in draw(chance).items():
        own = tables.get(name, {})
        tables[name] = {**own, **keys, **{axis: {**own[axis], **keys.get(axis, {})} for axis in BOTH if axis in own}}
    rotor = mast.rotor
    if BOTH[1] in tables.get("controller", {}):
        rotor = replace(rotor, shared=(*rotor.shared, *(f"second-{name}" for name in rotor.shared)))
    return replace(mast, tables=tables, rotor=rotor)


def _controller(chance: random.Random) -> dict[str, Any]:
    azimuth, elevation = chance.choice(PROTOCOLS), chance.choice(PROTOCOLS)
    keys: dict[str, Any] = {"protocol": azimuth}
    if azimuth in AZIMUTH_ONLY or chance.random() < OWN_SHARE:
        keys = {axis: {"protocol": protocol} for axis, protocol in zip(BOTH, (azimuth, elevation), strict=True)}
    return {"controller": {**keys, "target_every_s": chance.choice((0.1, 1.0, 1.0, 3.0))}}


def _stepper(chance: random.Random) -> dict[str, Any]:
    chip, encoder = chance.choice(("tmc5160", "tmc5130")), chance.choice((0, 4000))
    current = {"run_a": 0.5, "sense_ohm": 0.11} if chip == "tmc5130" else {"run_a": 1.0, "sense_ohm": 0.075}
    keys = {
        axis: {"home": chance.choice(ENDS), "encoder": encoder, "gear": chance.choice((54, -54)), **current}
        for axis in BOTH
    }
    return {"stepper": {"chip": chip, "self_locking": chance.random() < 0.8, **keys}}


def _bridge(chance: random.Random) -> dict[str, Any]:
    keys: dict[str, Any] = {"lines": chance.choice(("two", "two", "direction")), "channels": chance.choice((2, 2, 1))}
    for axis, pin in zip(BOTH, (28, 29), strict=True):
        if chance.random() < INDEX_SHARE:
            keys[axis] = {"home": "index", "index": pin}
    return {"bridge": keys}


def _timed(chance: random.Random) -> dict[str, Any]:
    end_to_end: dict[str, Any] = {"speed_error": SPEED_ERROR, "anew_after_deg": chance.choice((0.0, 180.0, 720.0))}
    return {"timed": end_to_end, BOTH[1]: {"fitted": True}}


VARIANTS: Mapping[str, Callable[[random.Random], dict[str, Any]]] = {
    "controller": _controller,
    "h-bridge": _bridge,
    "stepper": _stepper,
    "relay-timed": _timed,
}


def alone(chance: random.Random, mast: Mast) -> Mast:
    """The same box with one axis: programs and people order the other one all the same."""
    if chance.random() >= ALONE_SHARE:
        return mast
    fitted, other = chance.choice((BOTH, BOTH, BOTH[::-1]))
    mount = {key: value for key, value in mast.tables.get("mount", {}).items() if key not in ("flip", "forbidden")}
    tables = {**mast.tables, other: {**mast.tables.get(other, {}), "fitted": False}, "mount": mount}
    tables[other].pop("brake", None)
    for key in ("park_azimuth_deg", "park_elevation_deg"):
        mount.pop(key, None)
    gone = other, "second", *(("mpu6050",) if other == BOTH[1] else ())
    shared, sporadic = (
        tuple(name for name in names if not name.startswith(gone))
        for names in (mast.rotor.shared, mast.rotor.shared_sporadic)
    )
    rotor = replace(mast.rotor, shared=shared, shared_sporadic=sporadic)
    lacking = "" if mast.commissioning == other else mast.commissioning
    return replace(mast, tables=tables, rotor=rotor, alone=fitted, commissioning=lacking)
