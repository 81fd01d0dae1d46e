"""A random box: a kind of rotor as it is shipped, with other motors, ranges, switches, a master, a panel.

Knows which keys are worth varying, and the names of the simulators' faults by kind. Knows no event of a drill.
"""

from __future__ import annotations

import random
from dataclasses import dataclass
from typing import Any

from benchmarks.drills.arcs import draw_arc

PANEL: dict[str, Any] = {
    "adc_address": 0x49,
    "azimuth_knob": 0,
    "elevation_knob": 1,
    "jog": 2,
    "reference": 3,
    "mode_msb": 5,
    "mode_lsb": 6,
    "stop": 19,
}
SWITCHES = {"azimuth_low": 12, "azimuth_high": 17, "elevation_low": 27, "elevation_high": 26}
POTS = ("pot-open", "pot-shorted", "pot-reversed", "pot-stuck", "pot-jumps", "pot-loose")
SAMPLES = ("pot-crackles", "pot-spikes", "pot-bursts")
CONVERTER = ("adc-noisy", "adc-gaps")
RELAYS = ("motor-stalled", "motor-reversed", "hand-turns")
BOTH = ("azimuth", "elevation")
CHIP = ("chip-silent", "chip-dips", "chip-unpowered", "driver-hot", "driver-warm", "coil-short", "coil-open")
LINE = ("controller-deaf", "controller-garbled", "controller-slow", "controller-unplugged", "controller-ignores-stop")
SHORTED = ("azimuth-bridge-shorted-cw", "azimuth-bridge-shorted-ccw", "elevation-bridge-shorted-up")
COUNTED = ("relay-pulse", "h-bridge", "stepper", "relay-timed")
"""Kinds whose angle a person confirms at first, or finds at an end."""
FIRMWARE = ("gate-driver", "over-voltage", "encoder", "over-temperature", "under-voltage", "position-invalid", "timing")
CHIMNEY_SHARE, MASKS_SHARE = 0.25, 0.5


@dataclass(frozen=True, slots=True)
class Rotor:
    """A kind of rotor, and the simulators' names of its faults.

    `faults` and `sporadic` are faults of one axis, named here without the axis; `shared` and `shared_sporadic` are of
    the whole rotor. Sporadic faults spoil every n-th reading or answer.
    """

    kind: str
    profile: str
    faults: tuple[str, ...]
    shared: tuple[str, ...] = ()
    sporadic: tuple[str, ...] = ()
    shared_sporadic: tuple[str, ...] = ()
    top_deg: tuple[float, float] = (360.0, 180.0)
    geared: bool = True
    relays: bool = False


ROTORS = (
    Rotor(
        kind="relay-pot",
        profile="g5500",
        faults=(*POTS, *RELAYS, "stop-early"),
        shared=("adc-gone",),
        sporadic=SAMPLES,
        shared_sporadic=CONVERTER,
        top_deg=(450.0, 180.0),
        relays=True,
    ),
    Rotor(
        kind="relay-pulse",
        profile="u100",
        faults=("contact-stuck-open", "contact-stuck-closed", *RELAYS),
        sporadic=("pulses-missed", "pulses-doubled"),
        relays=True,
    ),
    Rotor(
        kind="digipot",
        profile="orbit360",
        faults=("chip-dips", "select-broken", "motor-stalled"),
        top_deg=(360.0, 90.0),
    ),
    Rotor(
        kind="servo",
        profile="servos",
        faults=("servo-stalled", "servo-unpowered", "wind-turns"),
        shared=("board-unpowered", "board-dips"),
        top_deg=(180.0, 180.0),
        geared=False,
    ),
    Rotor(
        kind="h-bridge",
        profile="slew-drive",
        faults=("motor-stalled", "motor-reversed", "encoder-dead", "encoder-channel-stuck"),
        shared=("pwm-refuses", *SHORTED),
        top_deg=(360.0, 90.0),
    ),
    Rotor(
        kind="controller",
        profile="controller",
        faults=("knob-turned", "knob-turned", "jumps", "motor-stalled", "motor-slow"),
        shared=LINE,
    ),
    Rotor(
        kind="stepper",
        profile="satnogs",
        faults=(*CHIP, "held", "held", "switch-broken"),
        shared=("enable-broken",),
        top_deg=(360.0, 90.0),
        geared=False,
    ),
    Rotor(
        kind="relay-timed",
        profile="tv-rotator",
        faults=("motor-slow", *RELAYS),
        relays=True,
    ),
    Rotor(
        kind="moteus",
        profile="isel",
        faults=("silent", "jammed", "power-cycled", *FIRMWARE),
        sporadic=("replies-lost", "replies-gaps"),
        top_deg=(450.0, 90.0),
        geared=False,
    ),
)
KINDS = {rotor.kind: rotor for rotor in ROTORS}


@dataclass(frozen=True, slots=True)
class Mast:
    """The box that was drawn: the tables of its configuration, and the facts that a script needs."""

    rotor: Rotor
    tables: dict[str, Any]
    start_deg: tuple[float, float]
    top_deg: tuple[float, float]
    speed_dps: tuple[float, float]
    has_panel: bool
    has_switches: bool
    has_pots: bool
    commissioning: str
    alone: str = ""
    """The only axis that the rotor has; empty: it has both."""

    @property
    def axes(self) -> tuple[str, ...]:
        return (self.alone,) if self.alone else BOTH


def draw_mast(chance: random.Random, rotor: Rotor, *, beside_sectors: bool = False) -> Mast:
    """`beside_sectors`: one to three of them for certain, often under a horizon of trees and roofs."""
    top_deg = rotor.top_deg
    if rotor.kind in ("relay-pot", "moteus", "relay-pulse"):
        top_deg = (chance.choice((360.0, 450.0)), chance.choice((90.0, 180.0)) if rotor.relays else 90.0)
    has_panel, has_switches = chance.random() < 0.25, chance.random() < 0.25 and rotor.kind != "relay-timed"
    tables: dict[str, Any] = {"azimuth": {"max_deg": top_deg[0]}, "elevation": {"max_deg": top_deg[1]}, "sim": {}}
    if has_panel:
        tables["panel"] = PANEL
    if rotor.kind == "h-bridge":  # away from the pins of the panel and of the switches
        tables["bridge"] = {"elevation": {"pwm": 13, "b": 10}}
    low_deg = 0.0
    if has_switches:
        tables["limits"] = SWITCHES
        if rotor.kind == "relay-pulse":  # homing ends below a low switch
            low_deg = 5.0
            for axis in BOTH:
                tables[axis]["min_deg"] = low_deg
    if top_deg[1] > 90.0 and chance.random() < 0.3:
        tables["mount"] = {"flip": "over-top"}
    start_deg = _angle(chance, low_deg, top_deg[0]), _angle(chance, low_deg, top_deg[1])
    speed_dps = _motors(chance, rotor, tables) if rotor.geared else (30.0, 30.0)
    if rotor.relays:
        _relays(chance, rotor, tables)
    has_pots = rotor.kind == "relay-pot"
    if rotor.kind == "digipot":
        for axis, at_deg in zip(BOTH, start_deg, strict=True):
            tables.setdefault("digipot", {})[axis] = {"start_deg": round(at_deg, 1)}
        start_deg = round(start_deg[0], 1), round(start_deg[1], 1)
        has_pots = chance.random() < 0.5
        if has_pots:
            for axis in BOTH:
                tables[axis]["sensor"] = {"kind": "pot"}
    if rotor.kind == "servo":
        start_deg = (90.0, 90.0)
    if rotor.kind == "moteus" and chance.random() < 0.8:
        tables["control"] = {"rate_hz": 20}  # as every other kind; its own 50 Hz costs more than twice as much
    if chance.random() < CHIMNEY_SHARE or beside_sectors:
        for _ in range(chance.choice((1, 2, 3)) if beside_sectors else 1):
            _sector(chance, tables, start_deg, top_deg)
    if beside_sectors and chance.random() < MASKS_SHARE:
        heights_deg = [[float(azimuth), round(chance.uniform(0.0, 15.0), 1)] for azimuth in range(0, 360, 45)]
        tables["mount"] = {**tables.get("mount", {}), "horizon": heights_deg}
    if chance.random() < 0.1:
        tables["sky"] = {"follow": [{"name": draw_arc(chance, chance.uniform(0.0, 200.0))} for _ in range(2)]}
    commissioning = chance.choice(BOTH) if rotor.kind in ("relay-pot", "relay-pulse") and chance.random() < 0.15 else ""
    return Mast(rotor, tables, start_deg, top_deg, speed_dps, has_panel, has_switches, has_pots, commissioning)


def _sector(
    chance: random.Random, tables: dict[str, Any], start_deg: tuple[float, float], top_deg: tuple[float, float]
) -> None:
    """A chimney at random, often in the way of one axis, but never at the rotor's start or park position."""
    for _ in range(20):
        spans = []
        beside = chance.choice((None, *BOTH))
        for axis, top, at_deg in zip(BOTH, top_deg, start_deg, strict=True):
            low_deg, wide_deg = float(chance.randrange(round(top - 20.0))), chance.choice((5.0, 10.0, 20.0, 60.0))
            if axis == beside:  # the other axis turns into it
                low_deg = max(0.0, round(at_deg - chance.random() * wide_deg))
            spans.append([low_deg, low_deg + wide_deg])
        least_deg = [tables[axis].get("min_deg", 0.0) for axis in BOTH]
        parks = [(0.0, 0.0), (180.0, 0.0), (180.0, least_deg[1]), (least_deg[0], least_deg[1]), (90.0, 90.0), start_deg]
        if not any(
            all(low - 4.0 < at < high + 4.0 for at, (low, high) in zip(place, spans, strict=True)) for place in parks
        ):
            mount = tables.setdefault("mount", {})
            before = mount.get("forbidden", [])
            name = f"chimney {len(before) + 1}" if before else "chimney"
            sector = {"name": name, "azimuth_deg": spans[0], "elevation_deg": spans[1]}
            tables["mount"] = {**mount, "forbidden": [*before, sector]}
            return


def _angle(chance: random.Random, low_deg: float, top_deg: float) -> float:
    """An angle at random, often at an end of the range or near it."""
    match chance.randrange(5):
        case 0:
            return low_deg + chance.choice((0.0, 1.0, 4.0))
        case 1:
            return top_deg - chance.choice((0.0, 1.0, 4.0))
        case _:
            return round(chance.uniform(low_deg, top_deg), 1)


def _motors(chance: random.Random, rotor: Rotor, tables: dict[str, Any]) -> tuple[float, float]:
    """Draw the motors, with 0.3 to 1.5 times the speed in the file. Returns the speeds in the file, in °/s."""
    speeds_dps = []
    for axis, usual_dps in zip(BOTH, (6.0, 2.7 if rotor.kind == "relay-pot" else 6.0), strict=True):
        said_dps = usual_dps if chance.random() < 0.6 else chance.choice((1.5, 3.0, 4.5, 9.0))
        share = 1.0 if chance.random() < 0.4 else chance.uniform(0.3, 1.5)
        if rotor.kind in ("digipot", "relay-timed"):
            share = 1.0  # the box cannot notice another speed
        lag_s = chance.choice((0.05, 0.1, 0.15, 0.3)) if rotor.kind == "relay-pot" else 0.1
        tables[axis] |= {"speed_dps": said_dps}
        tables["sim"][axis] = {
            "speed_dps": round(said_dps * share, 2),
            "lag_s": lag_s,
            "backlash_deg": chance.choice((0.0, 0.5, 0.5, 2.0)) if rotor.kind == "relay-pot" else 0.5,
            "relay_delay_s": chance.choice((0.005, 0.015, 0.03)),
            "pot_noise_deg": chance.choice((0.0, 0.1, 0.1, 0.2, 0.4)),
        }
        speeds_dps.append(said_dps)
    return speeds_dps[0], speeds_dps[1]


def _relays(chance: random.Random, rotor: Rotor, tables: dict[str, Any]) -> None:
    relays: dict[str, Any] = {"one_at_a_time": chance.random() < 0.3}
    if chance.random() < 0.5:
        relays["master"] = 21
    tables["relays"] = relays
    if chance.random() < 0.15:
        tables["mount"] = {**tables.get("mount", {}), "park_after_s": 60.0}
