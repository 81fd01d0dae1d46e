"""A desk to try the controller on: time in hand, readings fed by hand, nothing else around it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import cast

import pytest

from hw.ports import AngleSource, Axis, Direction
from rotator.control.axis.calibration_table import Calibration, between_ends
from rotator.control.axis.homing import HomingSettings
from rotator.control.axis.readings import ANYTHING, Condition, Reading, Window
from rotator.control.axis.settings import SwitchedSettings
from rotator.control.commands import Run
from rotator.control.controller import Controller
from rotator.control.settings import Settings
from rotator.control.sky.mount import Mount, Range, Sector
from rotator.exchange.faults import Missing
from rotator.exchange.motor import Motor
from rotator.exchange.orders import Order
from rotator.exchange.sources import Source
from rotator.exchange.status import Status

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
LOW_RAW, HIGH_RAW = 0.05, 0.95
EDGE_DEG = 2.5
"""From one change of a counted axis's contact to the next."""


class Desk:
    """A controller and a simple rotor: 6°/s (2.7°/s up and down) while driven, coasting for 0.17 s of that after.

    `counted`: the axes count the changes of a contact, and can be homed; else pots measure them.
    """

    LINK, OTHER, CONSOLE = Source("gs232b", 1), Source("rotctld", 1), Source("console")
    SPEED_DPS: Mapping[Axis, float] = {AZ: 6.0, EL: 2.7}
    LAG_S = 0.17

    def __init__(
        self,
        *,
        azimuth: tuple[float, float] = (0.0, 450.0),
        elevation: tuple[float, float] = (0.0, 180.0),
        at: tuple[float, float] = (100.0, 10.0),
        park: tuple[float, float] = (0.0, 0.0),
        missing: Mapping[Axis, tuple[Missing, ...]] | None = None,
        counted: bool = False,
        park_after_s: float = 0.0,
        on_sky: bool = True,
        sectors: tuple[Sector, ...] = (),
        described: float = 1.0,
        attended: bool = False,
    ) -> None:
        """`described`: the motors' speeds in the file, as a share of the real ones."""
        self._described = described
        self.range = {AZ: Range(*azimuth), EL: Range(*elevation)}
        self.angle_deg = dict(zip(Axis, at, strict=True))
        self._speed_dps = dict.fromkeys(Axis, 0.0)
        self._changes = dict.fromkeys(Axis, 0)
        self._edge = {axis: int(angle_deg // EDGE_DEG) for axis, angle_deg in self.angle_deg.items()}
        self.instead: dict[Axis, float | None] = {}
        """Raw readings in place of the pot's; None: no answer."""
        self.frozen_since_s: dict[Axis, float] = {}
        """Sensors from which no new reading comes, and when the last one was taken."""
        self.now_s = 1000.0
        self.runs: dict[Axis, Run] = {}
        self.driven = dict.fromkeys(Axis, Direction.OFF)
        missing = missing or {}
        self.counted = counted
        self.lost = dict.fromkeys(Axis, "")
        """Why a counted axis has to be homed; empty: its count is right."""
        self.controller = Controller(
            Settings(
                azimuth=self._settings(AZ, missing.get(AZ, ())),
                elevation=self._settings(EL, missing.get(EL, ())),
                mount=Mount(self.range[AZ], self.range[EL], *park, sectors=sectors),
                park_after_s=park_after_s,
                on_sky=on_sky,
                attended=attended,
            )
        )
        self._status: Status | None = None

    @property
    def status(self) -> Status:
        """As of the last step, made when a test reads it."""
        if self._status is None:
            self._status = self.controller.status(self.now_s)
        return self._status

    def _settings(self, axis: Axis, missing: tuple[Missing, ...]) -> SwitchedSettings:
        limits = self.range[axis]
        line = between_ends(LOW_RAW, limits.min_deg, HIGH_RAW, limits.max_deg)
        calibration = None if Missing.CALIBRATION in missing else line
        speed_dps = self.SPEED_DPS[axis] * self._described
        motor = Motor(speed_dps, speed_dps * self.LAG_S)
        if self.counted:
            degrees = Calibration(((limits.min_deg, limits.min_deg), (limits.max_deg, limits.max_deg)))
            travel_s = (limits.max_deg - limits.min_deg) / motor.speed_dps
            homing = HomingSettings(EDGE_DEG / motor.speed_dps * 2.0, travel_s, 0.5, limits.min_deg)
            return SwitchedSettings(
                axis, limits, 4.0, motor, ANYTHING, degrees, missing, AngleSource.COUNTED, homing=homing
            )
        return SwitchedSettings(axis, limits, 4.0, motor, Window(0.02, 0.98), calibration, missing)

    def raw(self, axis: Axis) -> float:
        limits = self.range[axis]
        if self.counted:
            return self.angle_deg[axis]
        share = (self.angle_deg[axis] - limits.min_deg) / (limits.max_deg - limits.min_deg)
        return LOW_RAW + share * (HIGH_RAW - LOW_RAW)

    def step(self, *orders: Order, by: Source = LINK, seconds: float = 0.05) -> dict[Axis, Direction]:
        """Let time pass, the rotor turn, and the controller decide; returns which way each axis is driven now."""
        self.now_s += seconds
        for axis, way in self.driven.items():
            self._turn(axis, way * self.SPEED_DPS[axis], seconds)
        readings = {
            axis: Reading(
                self.frozen_since_s.get(axis, self.now_s),
                self.instead.get(axis, self.raw(axis)),
                condition=self._condition(axis),
            )
            for axis in Axis
        }
        commands = self.controller.step(self.now_s, readings, [(by, order) for order in orders])
        self.runs = cast(dict[Axis, Run], commands)
        self.driven = {axis: run.direction for axis, run in self.runs.items()}
        self.controller.note_driven(self.now_s, self.driven)
        self._status = None
        return self.driven

    def _condition(self, axis: Axis) -> Condition:
        if not self.counted:
            return Condition()
        limits, edge = self.range[axis], self._edge[axis]
        edges = (
            (Direction.MINUS, edge * EDGE_DEG > limits.min_deg),
            (Direction.PLUS, (edge + 1) * EDGE_DEG <= limits.max_deg),
        )
        ahead = frozenset(way for way, is_ahead in edges if is_ahead)
        return Condition(lost=self.lost[axis], changes=self._changes[axis], ahead=ahead)

    def _turn(self, axis: Axis, wanted_dps: float, seconds: float) -> None:
        fade = math.exp(-seconds / self.LAG_S)
        gap_dps = self._speed_dps[axis] - wanted_dps
        self.angle_deg[axis] += wanted_dps * seconds + gap_dps * self.LAG_S * (1.0 - fade)
        self._speed_dps[axis] = wanted_dps + gap_dps * fade
        if self.counted:
            # The stops of a counted rotor stand at the ends of its range, and each edge of its contact is counted.
            self.angle_deg[axis] = self.range[axis].nearest(self.angle_deg[axis])
            edge = int(self.angle_deg[axis] // EDGE_DEG)
            self._changes[axis] += abs(edge - self._edge[axis])
            self._edge[axis] = edge

    def place(self, axis: Axis, angle_deg: float) -> None:
        """Stand the axis there, at rest, until no watch remembers its motion."""
        for _ in range(40):
            self.angle_deg[axis] = angle_deg
            self._speed_dps[axis] = 0.0
            self.step()

    def run(self, seconds: float) -> set[tuple[Axis, Direction]]:
        """Steps at 20 Hz without orders; returns every drive seen."""
        return {drive for _ in range(round(seconds / 0.05)) for drive in self.step().items() if drive[1]}

    def at_rest(self) -> bool:
        return all(way is Direction.OFF for way in self.driven.values())


@pytest.fixture(scope="session")
def new_desk() -> type[Desk]:
    return Desk


@pytest.fixture
def desk() -> Desk:
    """A G-5500 with 450° of azimuth, commissioned, standing at 100° and 10°."""
    desk = Desk()
    desk.step()
    return desk
