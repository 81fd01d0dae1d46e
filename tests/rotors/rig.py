"""Every kind of rotor as it is shipped, in simulated time: its station, the control loop and clients, run by hand.

Knows the shipped configurations and what each kind can do. Knows nothing of what a test is after. Angles are degrees as
the box reports them; what the simulated rotor shows on its own scale is shifted by as much as the file says.
"""

from __future__ import annotations

import tomllib
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
import tomlkit

from firmware_sim.clock import SimClock
from firmware_sim.rotors.rotor import SimRotor
from hw.ports import AngleSource, Axis
from rotator.assembly.kept_files import build_learnt, build_state
from rotator.assembly.settings import build_controller, build_mount, build_offsets
from rotator.assembly.station import Station
from rotator.cli.rehearse import simulated
from rotator.config.load import parse, shipped
from rotator.config.model import Config
from rotator.exchange.orders import Aim, Order
from rotator.exchange.sources import Source
from rotator.exchange.status import AxisStatus, Status
from rotator.runtime.client import Client
from rotator.runtime.loop import ControlLoop

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
LINK, PERSON = Source("gs232b", 1), Source("console")
STARTED_S = 1000.0
PATIENCE_S = 180.0
STANDS_S = 1.0
"""What has not moved for so long, and is not said to move, stands: longer than any of these motors coasts."""
STANDS_ANYHOW_S = 6.0
"""Whatever is said: longer than a servo is waited for that may be jumping to its first pulse."""


@dataclass(frozen=True, slots=True)
class Kind:
    """A rotor, and the least that may be expected of it."""

    profile: str
    source: AngleSource
    start_deg: tuple[float, float]
    within_deg: float
    """How near to its order the boom comes to rest."""
    run_on_deg: float
    """How far the shaft turns on after a stop at full speed."""
    trembles_deg: float = 0.001
    """How much it moves while it stands."""
    short_deg: float = 0.0
    """How far before its low stop it comes to rest: only there its contact would still show a welded relay."""


KINDS = (
    Kind("g5500", AngleSource.MEASURED, (90.0, 30.0), 1.0, 1.3),
    # With its brake: the stop in the south, and an elevation of another make beside it.
    Kind("ham4", AngleSource.MEASURED, (90.0, 30.0), 1.5, 2.0),
    # From the full speed of its motor, at any moment.
    Kind("g1000", AngleSource.MEASURED, (90.0, 30.0), 1.0, 1.3),
    Kind("u100", AngleSource.COUNTED, (90.0, 70.0), 1.0, 1.0, short_deg=2.0),
    # From 30°/s, at 20°/s² down.
    Kind("isel", AngleSource.MEASURED, (90.0, 30.0), 0.05, 24.0),
    # The servo is somewhat faster than its order moves, and trembles while it holds.
    Kind("servos", AngleSource.MODELLED, (90.0, 90.0), 0.6, 2.0, trembles_deg=1.0),
    # The box's dead band, half a step of the chip, and half the play of the gear.
    Kind("orbit360", AngleSource.MODELLED, (90.0, 30.0), 2.0 + 0.7 + 0.25, 1.5),
    # Two counts of its encoder; from 3°/s, at 3°/s² down.
    Kind("slew-drive", AngleSource.COUNTED, (90.0, 30.0), 0.15, 2.0),
    # Half a degree of the order, half the play of the gear, and the controller's dead band.
    Kind("controller", AngleSource.MEASURED, (90.0, 30.0), 1.1, 2.0),
    # Its motors are up to 2.5 % faster or slower than the file says, and nothing comes back.
    Kind("tv-rotator", AngleSource.MODELLED, (90.0, 30.0), 5.0 + 1.0 + 0.025 * 180.0, 1.0),
    # From 12°/s, at 6°/s² down.
    Kind("satnogs", AngleSource.COUNTED, (90.0, 30.0), 0.05, 13.0),
)
OF = {kind.profile: kind for kind in KINDS}


def all_but(**defects: str) -> pytest.MarkDecorator:
    """Every kind, but for those, by profile, that are known not to: when one does, the test says so."""
    marks = {name: [pytest.mark.xfail(reason=why, strict=True)] for name, why in defects.items()}
    each = [pytest.param(kind, id=kind.profile, marks=marks.get(kind.profile, [])) for kind in KINDS]
    return pytest.mark.parametrize("kind", each)


def make_geared(values: dict[str, Any]) -> None:
    """The ISEL machine with its only encoders before the gears, and an overlap: the harder one."""
    values["azimuth"]["max_deg"], values["mount"]["park_azimuth_deg"] = 450, 0
    for axis in ("azimuth", "elevation"):
        values["moteus"][axis]["geared"] = True


def configured(profile: str, **tables: Any) -> Config:
    """A shipped configuration, simulated, with these tables' keys in place of its own; None takes a key away.

    Without its front panel: `tests/scenario/test_front_panel.py` has that.
    """
    values = tomllib.loads(shipped(profile))
    values.pop("panel", None)
    if profile == "isel":
        make_geared(values)
    if profile in ("tv-rotator", "ham4", "g1000"):  # with a second one, on its side
        values["elevation"] = {"max_deg": 180}
        values["azimuth"]["offset_deg"] = 0
    for table, keys in (("rotor", {"hardware": "sim"}), *tables.items()):
        own = values.get(table, {}) | keys
        values[table] = {key: value for key, value in own.items() if value is not None}
    return simulated(parse(tomlkit.dumps(values), profile))


class Box:
    """`start_deg` on the rotor's own scale. `counts`: the file in which counted axes are kept.

    `learns`: the motors start as the state file of the configuration has them.
    """

    def __init__(
        self,
        kind: Kind,
        start_deg: tuple[float, float] | None = None,
        *,
        counts: Path | None = None,
        learns: bool = False,
        **tables: Any,
    ) -> None:
        self.kind = kind
        self.config = configured(kind.profile, **tables)
        self.clock = SimClock(STARTED_S)
        self.station = Station(
            self.config,
            self.clock,
            self.clock.sleep,
            start_deg or kind.start_deg,
            add_alarm=self.clock.add_alarm,
            counts=counts,
        )
        assert self.station.world is not None
        self.world: SimRotor = self.station.world
        self.rotor = self.station.rotor
        self.period_s = 1 / self.config.control.rate_hz
        learnt = build_learnt(self.config, build_state(self.config)).load() if learns else None
        self.loop = ControlLoop(build_controller(self.config, learnt), self.rotor, self.clock, self.period_s)
        self._shift = build_offsets(self.config)
        self._next_s = self.clock()
        self._closed = False

    @property
    def status(self) -> Status:
        return self.loop.status

    def axis(self, axis: Axis) -> AxisStatus:
        return self.status.axis(axis)

    def boom_deg(self, axis: Axis) -> float:
        """Where the antenna really points."""
        return self.world.antenna()[list(Axis).index(axis)] + self._shift.deg(axis)

    def shaft_deg(self, axis: Axis) -> float:
        """Where the shaft really is, before the play of the gears."""
        return self.world.shafts()[list(Axis).index(axis)] + self._shift.deg(axis)

    def client(self, source: Source = LINK) -> Client:
        return Client(self.loop, build_mount(self.config), source, clock=self.clock)

    def order(self, *orders: Order, by: Source = LINK) -> None:
        for order in orders:
            self.loop.post(by, order)

    def run(self, seconds: float) -> None:
        """Cycles at their rate until that much time has passed."""
        end_s = self.clock() + seconds
        while self._next_s < end_s:
            self.clock.sleep_until(self._next_s)
            self.loop.cycle()
            self._next_s += self.period_s
        self.clock.sleep_until(end_s)

    def left_alone(self, seconds: float) -> None:
        """The control thread does not run; the guard of the drive does."""
        self.clock.sleep(seconds)
        self._next_s = self.clock()

    def until(self, done: Callable[[], bool], patience_s: float = PATIENCE_S) -> float:
        """Cycles until it has come to pass. Returns how long that took."""
        began_s = self.clock()
        while not done():
            assert self.clock() - began_s < patience_s, f"it never came: {self.status}"
            self.run(self.period_s)
        return self.clock() - began_s

    def until_it_stands(self, patience_s: float = PATIENCE_S) -> None:
        """Cycles until no shaft has moved for a while, and none waits for its first look."""
        since_s, stood_deg = self.clock(), self.world.shafts()

        def stands() -> bool:
            nonlocal since_s, stood_deg
            shafts_deg = self.world.shafts()
            ways_deg = [is_deg - was_deg for is_deg, was_deg in zip(shafts_deg, stood_deg, strict=True)]
            if max(map(abs, ways_deg)) > self.kind.trembles_deg:
                since_s, stood_deg = self.clock(), shafts_deg
            about_to = self.status.moving or any(self.axis(axis).waiting for axis in Axis)
            return self.clock() - since_s >= (STANDS_ANYHOW_S if about_to else STANDS_S)

        self.until(stands, patience_s)

    def arrives(self, azimuth_deg: float, elevation_deg: float) -> bool:
        """Aimed there, it stands there in the end, as near as its kind can."""
        self.order(Aim(azimuth_deg, elevation_deg))
        self.until_it_stands()
        off_deg = [abs(self.boom_deg(AZ) - azimuth_deg), abs(self.boom_deg(EL) - elevation_deg)]
        return max(off_deg) <= self.kind.within_deg

    def close(self) -> None:
        if not self._closed:
            self._closed = True
            self.station.close()
