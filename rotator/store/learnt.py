"""What the box has learnt of its parts: speed and coast of each motor, a compass's own errors, each knob's full scale.

Knows which figures are possible, and which change of a motor's is large enough for a write. Does not know how any of
them is measured, nor what a compass's bytes mean: its chip loses them without power.
"""

from __future__ import annotations

import logging
import math
from collections.abc import Mapping
from dataclasses import asdict
from typing import Any

from hw.ports import Axis
from rotator.exchange.motor import Motor
from rotator.store.json_file import damage, number
from rotator.store.state import Content, Section, State

log = logging.getLogger(__name__)

WORTH_WRITING = 0.05
"""A change smaller than this share is written only at the end of the program, because memory cards wear."""
LEAST_COAST_DEG = 0.2
"""A shorter coast is compared as if it were this long: 5 % of a very short coast is only noise."""
SLOWEST, FASTEST = 0.1, 4.0
"""Possible speeds of a motor, as multiples of the configured speed. Others are damaged, or of another motor."""
LONGEST_COAST_S = 5.0

Motors = tuple[Motor, Motor]
"""The two directions of one motor: clockwise or up, then counter-clockwise or down."""
MotorSettings = Mapping[str, object]
"""The settings of a motor in the configuration, `speed_dps` among them. Figures of other settings are not used."""


Tables = Mapping[Axis, Mapping[str, Any]]
"""The raw table of each axis."""


def _content(tables: Tables) -> Content:
    return {"axes": {axis.value: dict(table) for axis, table in tables.items()}}


def _tables(content: dict[str, Any]) -> Tables:
    return {axis: dict(content["axes"][axis.value]) for axis in Axis if axis.value in content["axes"]}


NONE: Tables = {}
LEARNT: Section[Tables] = Section("learnt", _tables, _content, NONE, NONE, "ignored, the motors are learnt anew")


def check(content: dict[str, Any]) -> None:
    """The figures of another box, with its own settings. Raises as `LEARNT.parse` does, for damaged ones too."""
    for table in _tables(content).values():
        _motors(table, table["begun"])


class KeptMotors:
    """Call `load` first, then `note`, then `save` now and then.

    `begun`: the settings of each motor with which this run has begun.
    """

    def __init__(self, state: State, begun: Mapping[Axis, MotorSettings]) -> None:
        self._state = state
        self._begun = begun
        self._kept: dict[Axis, Motors] = {}

    def load(self) -> dict[Axis, Motors]:
        """The figures of earlier runs; none without a file, or with damaged ones."""
        known: dict[Axis, Motors] = {}
        for axis, table in self._state.load(LEARNT).items():
            settings = dict(self._begun[axis])
            try:
                if table["begun"] == settings:
                    known[axis] = _motors(table, self._begun[axis])
                else:
                    log.info(
                        "%s: %s has been set up anew since; its motor is learnt anew", self._state.path, axis.value
                    )
            except (ValueError, KeyError, TypeError) as fault:
                log.warning(
                    "%s: %s: ignored, its motor is learnt anew: %s", self._state.path, axis.value, damage(fault)
                )
        return known

    def note(self, learnt: Mapping[Axis, Motors]) -> None:
        """Note the figures with which the box starts. They are written only after a change."""
        self._kept = dict(learnt)

    def save(self, learnt: Mapping[Axis, Motors], *, ending: bool) -> None:
        """Write the measured figures. At the end of the program (`ending`) any change counts; before, a large one."""
        if not any(
            axis not in self._kept or _differs(self._kept[axis], motors, ending=ending)
            for axis, motors in learnt.items()
        ):
            return
        tables = {
            axis: {"begun": dict(self._begun[axis]), "plus": asdict(plus), "minus": asdict(minus)}
            for axis, (plus, minus) in learnt.items()
        }
        if self._state.keep(LEARNT, tables):
            self._kept = dict(learnt)


def _motors(table: Mapping[str, Any], settings: MotorSettings) -> Motors:
    """The figures of one motor. Raises ValueError, KeyError or TypeError for wrong ones."""
    configured_dps = number(settings["speed_dps"], "the configured speed", 0.0, math.inf)
    plus, minus = (_motor(table[direction], configured_dps) for direction in ("plus", "minus"))
    return plus, minus


def _motor(figures: Mapping[str, Any], configured_dps: float) -> Motor:
    speed_dps = number(figures["speed_dps"], "a speed in °/s", SLOWEST * configured_dps, FASTEST * configured_dps)
    return Motor(speed_dps, number(figures["coast_deg"], "a coast in °", 0.0, LONGEST_COAST_S * speed_dps))


def _differs(old: Motors, new: Motors, *, ending: bool) -> bool:
    if ending:
        return old != new
    return any(
        abs(b.speed_dps - a.speed_dps) > WORTH_WRITING * a.speed_dps
        or abs(b.coast_deg - a.coast_deg) > WORTH_WRITING * max(a.coast_deg, LEAST_COAST_DEG)
        for a, b in zip(old, new, strict=True)
    )


OFFSETS_COUNT = 22
"""Bytes, as the BNO055's registers hold them."""


def _offsets_content(offsets: bytes | None) -> Content:
    return {"offsets": (offsets or b"").hex(" ")}


def _offsets(content: dict[str, Any]) -> bytes | None:
    offsets = bytes.fromhex(content["offsets"])
    if len(offsets) != OFFSETS_COUNT:
        raise ValueError(f"the offsets are {len(offsets)} bytes, not {OFFSETS_COUNT}")
    return offsets


COMPASS: Section[bytes | None] = Section(
    "compass", _offsets, _offsets_content, None, None, "ignored, the compass learns its errors anew"
)


LEAST_SHARE, MOST_SHARE = 0.1, 1.1
"""The full scale of a working knob lies between these shares of its supply."""
DIGITS = 4
"""Digits of a share in the file."""

FullScales = Mapping[Axis, float]
"""The reading of each knob at the end of its travel, as a share of the knob's supply."""


def _shares_content(full_scales: FullScales) -> Content:
    return {"full_scales": {axis.value: round(share, DIGITS) for axis, share in full_scales.items()}}


def _shares(content: dict[str, Any]) -> FullScales:
    shares = {Axis(name): share for name, share in content["full_scales"].items()}
    return {
        axis: number(share, f"the {axis.value} knob's full scale", LEAST_SHARE, MOST_SHARE)
        for axis, share in shares.items()
    }


UNKNOWN: FullScales = {}
KNOBS: Section[FullScales] = Section(
    "knobs", _shares, _shares_content, UNKNOWN, UNKNOWN, "ignored, the panel's knobs count as uncalibrated"
)
