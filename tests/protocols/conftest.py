"""A whole box on the bench, without a wire: the real controller behind real admission, and a clock set by hand.

Knows how an order travels and what the two pots read. Knows no protocol.
"""

from __future__ import annotations

import pickle
from typing import cast

import pytest

from hw.ports import Axis, Direction
from rotator.control.admission import refusal
from rotator.control.axis.calibration_table import Calibration
from rotator.control.axis.readings import Reading, Window
from rotator.control.axis.settings import SwitchedSettings
from rotator.control.commands import Run
from rotator.control.controller import Controller
from rotator.control.settings import Settings
from rotator.control.sky.mount import Mount, Range
from rotator.exchange.faults import Missing
from rotator.exchange.motor import Motor
from rotator.exchange.orders import Aim, Jog, LoadTimed, Order, Park, Release, RunTimed
from rotator.exchange.sources import Refusal, Source
from rotator.exchange.status import Status
from rotator.protocols.session import Session

LINK = Source("link", 1)
PERIOD_S = 0.05
LOW_RAW, HIGH_RAW = 0.05, 0.95
SPEED_DPS = 6.0
LOOK_S = 3.0
"""So long the box looks at a still antenna before it closes its first relay."""

_LOOKED: dict[tuple[object, ...], bytes] = {}
"""Boxes that have looked, by what they were made of: the look is most of what a short test would cost."""


class BenchBox:
    """`orders` is what was taken, `driven` what the motors do now, `turned` which axes ever ran."""

    def __init__(
        self,
        azimuth: tuple[float, float] = (0.0, 450.0),
        elevation: tuple[float, float] = (0.0, 180.0),
        *,
        at: tuple[float, float] | None = None,
        missing: tuple[Missing, ...] = (),
        at_once: bool = True,
        blind: bool = False,
    ) -> None:
        made_of = (azimuth, elevation, at, missing, at_once, blind)
        if made_of not in _LOOKED:
            self._build(azimuth, elevation, missing, at_once=at_once, blind=blind)
            self.stands_at(*(at or (azimuth[0], elevation[0])))
            _LOOKED[made_of] = pickle.dumps(vars(self))
        vars(self).update(pickle.loads(_LOOKED[made_of]))

    def _build(
        self,
        azimuth: tuple[float, float],
        elevation: tuple[float, float],
        missing: tuple[Missing, ...],
        *,
        at_once: bool,
        blind: bool,
    ) -> None:
        self.now_s = 100.0
        self.orders: list[Order] = []
        self.driven = dict.fromkeys(Axis, Direction.OFF)
        self.turned: set[Axis] = set()
        self.follows = False
        """The antenna turns as its motors are driven; else it stays where it is put."""
        self._at_once = at_once
        self._blind = blind
        self.refused: list[Refusal | bytes] = []
        """What the protocol itself refused."""
        self._waiting: list[tuple[Source, Order]] = []
        self._ranges = {Axis.AZIMUTH: azimuth, Axis.ELEVATION: elevation}
        self._mount = Mount(Range(*azimuth), Range(*elevation))
        axes = {
            axis: SwitchedSettings(
                axis=axis,
                limits=Range(low_deg, high_deg),
                tolerance_deg=4.0,
                motor=Motor(SPEED_DPS, 1.0),
                window=Window(0.02, 0.98),
                calibration=Calibration(((LOW_RAW, low_deg), (HIGH_RAW, high_deg))),
                missing=missing,
            )
            for axis, (low_deg, high_deg) in self._ranges.items()
        }
        self._controller = Controller(Settings(axes[Axis.AZIMUTH], axes[Axis.ELEVATION], self._mount, PERIOD_S))
        self._status: Status | None = None
        """As of the last cycle, made when a test reads it."""

    def status(self) -> Status:
        if self._status is None:
            self._status = self._controller.status(self.now_s)
        return self._status

    def order(self, order: Order, source: Source = LINK) -> Refusal | None:
        refused = refusal(order, self.status(), self._mount)
        if refused is None:
            self.orders.append(order)
            self._waiting.append((source, order))
            if self._at_once:
                self._cycle()
        return refused

    def note_refused(self, refused: Refusal | bytes) -> None:
        self.refused.append(refused)

    def stands_at(self, azimuth_deg: float, elevation_deg: float) -> None:
        """Turn the antenna by hand, and wait until the box has seen that it stays there."""
        self._raw = {Axis.AZIMUTH: self._pot(Axis.AZIMUTH, azimuth_deg)}
        self._raw[Axis.ELEVATION] = self._pot(Axis.ELEVATION, elevation_deg)
        self.wait(LOOK_S)

    def stands_near(self, azimuth_deg: float) -> None:
        """The wind, or a relay that is stuck, has turned it there within the last cycle."""
        self._raw[Axis.AZIMUTH] = self._pot(Axis.AZIMUTH, azimuth_deg)
        self.wait(PERIOD_S)

    def breaks(self, axis: Axis) -> None:
        """The wiper of this axis's pot comes off, and the box has noticed."""
        self._raw[axis] = 0.0
        self.wait(0.5)

    def goes_on(self) -> None:
        """A person acknowledges its faults, in the next cycle: a motor ran while its pot was put elsewhere, for one."""
        self._waiting.append((Source("console", 1), Release()))
        self._cycle()

    def wait(self, seconds: float) -> None:
        """Let time pass, a cycle of the controller at a time; the antenna stays where it is put."""
        for _ in range(round(seconds / PERIOD_S)):
            self.now_s += PERIOD_S
            self._cycle()

    @property
    def motions(self) -> list[Order]:
        """The orders that turn, or may turn, a motor."""
        return [order for order in self.orders if isinstance(order, Aim | Jog | LoadTimed | RunTimed | Park)]

    def _pot(self, axis: Axis, angle_deg: float) -> float:
        low_deg, high_deg = self._ranges[axis]
        return LOW_RAW + (angle_deg - low_deg) / (high_deg - low_deg) * (HIGH_RAW - LOW_RAW)

    def _cycle(self) -> None:
        readings = {axis: Reading(self.now_s, None if self._blind else raw) for axis, raw in self._raw.items()}
        orders, self._waiting = self._waiting, []
        runs = self._controller.step(self.now_s, readings, orders)
        self.driven = {axis: cast(Run, run).direction for axis, run in runs.items()}
        self.turned |= {axis for axis, direction in self.driven.items() if direction}
        if self.follows:
            self._follow()
        self._controller.note_driven(self.now_s, self.driven)
        self._status = None

    def _follow(self) -> None:
        for axis, direction in self.driven.items():
            low_deg, high_deg = self._ranges[axis]
            step = SPEED_DPS * PERIOD_S / (high_deg - low_deg) * (HIGH_RAW - LOW_RAW)
            self._raw[axis] = min(max(self._raw[axis] + direction * step, LOW_RAW), HIGH_RAW)


@pytest.fixture(scope="session")
def new_box() -> type[BenchBox]:
    """For tests that want several, or a special one: `at_once=False`, orders wait for a cycle; `blind`, no pots."""
    return BenchBox


@pytest.fixture
def box() -> BenchBox:
    """A G-5500: azimuth 0 to 450, elevation 0 to 180, pointing at 235 and 25."""
    return BenchBox(at=(235, 25))


def _whole(session: Session, data: bytes) -> list[bytes]:
    return session.receive(data)


def _byte_by_byte(session: Session, data: bytes) -> list[bytes]:
    return [reply for at in range(len(data)) for reply in session.receive(data[at : at + 1])]


def _in_threes(session: Session, data: bytes) -> list[bytes]:
    return [reply for at in range(0, len(data), 3) for reply in session.receive(data[at : at + 3])]


@pytest.fixture(params=[_whole, _byte_by_byte, _in_threes], ids=["whole", "byte by byte", "in threes"])
def feed(request: pytest.FixtureRequest) -> object:
    """A way for bytes to arrive. Which must make no difference."""
    return request.param
