"""What can follow a pass in a rehearsal: the box, or the emulated Arduino, on simulated chips and a simulated clock.

Builds the same parts as the real box; orders go through a protocol. Knows the order rate, and how early the box knows a
pass that it tracks by itself. Does not know what is recorded, nor how good it was.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection
from typing import Protocol

from firmware_sim.clock import SimClock
from firmware_sim.rotors.rotor import SimRotor
from hw.ports import Axis
from rotator.assembly.arduino import arduino_station
from rotator.assembly.settings import build_controller, build_mount, build_offsets, planned_motors
from rotator.assembly.simulation import simulated_boom
from rotator.assembly.station import Station
from rotator.assembly.tracking import TrackedBox, build_known_sky, wanted_names
from rotator.config.model import Config
from rotator.control.sky.flight_plan import Antenna, plan_flight
from rotator.control.sky.known_path import KnownPath
from rotator.exchange.orders import Order
from rotator.exchange.sources import Source
from rotator.exchange.status import Status
from rotator.protocols.gs232 import Command, Dialect, encode
from rotator.protocols.gs232_session import Gs232Session
from rotator.protocols.rotctld import Request
from rotator.protocols.rotctld import encode as encode_request
from rotator.protocols.rotctld_session import RotctldSession
from rotator.protocols.session import Session
from rotator.rehearsal.overhearing import Named, Overhearing
from rotator.rehearsal.passes import Pass, SkyTarget
from rotator.runtime.client import Client
from rotator.runtime.loop import ControlLoop
from rotator.tracking.next_flight import Now
from rotator.tracking.program import Program, program_flight

KNOWN_S = 120.0
"""Time before its beginning at which the box knows a pass that it tracks by itself."""
FIRST_LOOK_S = 1.0
"""After this the box has read its sensors."""


class Plant(Protocol):
    """What follows the pass: the box, or the emulated Arduino, which knows no satellites and no faults."""

    early_s: float = 0.0
    """How long before the pass the rehearsal begins."""
    fitted: Collection[Axis] = tuple(Axis)
    """The axes that it has."""

    def begin(self, flown: Pass, begin_s: float) -> None:
        """Give it the pass, which begins at `begin_s`: the whole pass now, or from now on an order each second."""

    def run_until(self, moment_s: float) -> None: ...

    def pointing(self) -> tuple[float, float, int, int]:
        """The boom's azimuth and elevation in degrees, then the drive of each axis: -1, 0 or 1."""

    def relay_starts(self) -> int | None:
        """None: there are no relays."""

    def recognised(self) -> Named | None:
        """The satellite that the box has recognised in its orders."""
        return None

    def true_direction(self, now_s: float) -> tuple[float, float] | None:
        """Where that satellite really was; None: the box has recognised none."""
        del now_s
        return None

    def faults(self) -> tuple[str, ...]:
        """The faults that hold an axis now, each in a sentence."""
        return ()


class BoxPlant(Plant):
    """The box, from its protocol to its relays, on simulated chips.

    `via`: "rotctld" or "gs232", as orders are sent; or "track": it knows the pass beforehand.
    """

    def __init__(
        self,
        config: Config,
        clock: SimClock,
        start_deg: tuple[float, float],
        via: str,
        *,
        utc_s: float | None = None,
        target: SkyTarget | None = None,
    ) -> None:
        """`target`: what the box tracks by itself, by its own elements; None: it gets the pass.

        `utc_s`: when the pass begins; None: no satellite is recognised.
        """
        self.early_s = KNOWN_S if via == "track" or target else 0.0
        self._target = target
        self._clock = clock
        self._period_s = 1 / config.control.rate_hz
        shift = build_offsets(config)
        start_deg = (start_deg[0] - shift.azimuth_deg, start_deg[1] - shift.elevation_deg)
        station = Station(config, clock, clock.sleep, start_deg, add_alarm=clock.add_alarm)
        assert station.world is not None, "a rehearsal is always simulated"
        self.world: SimRotor = station.world
        self._loop = ControlLoop(build_controller(config), station.rotor, clock, self._period_s)
        self._mount = build_mount(config)
        self.fitted = config.fitted
        self._boom = simulated_boom(config)
        self._motors = planned_motors(config)
        client = Client(self._loop, self._mount, Source(via), clock=clock)
        self._session: Session = RotctldSession(client) if via == "rotctld" else Gs232Session(client, Dialect.B)
        self._encode = _rotctld_order if via == "rotctld" else _gs232_order
        self._overhearing: Overhearing | None = None
        if utc_s is not None:
            apart_s = utc_s - clock()
            box, sky = TrackedBox(config, self._loop, self._mount), build_known_sky(config)
            wanted = wanted_names(config.sky, sky)
            self._overhearing = Overhearing(self._loop, sky, box, clock, lambda: clock() + apart_s, wanted=wanted)

    def inject(self, at_s: float, name: str) -> None:
        """Let the named fault begin at this moment of simulated time."""
        pending = [at_s]

        def begin(_now_s: float) -> None:
            pending.clear()
            self.world.inject(name)

        self._clock.add_alarm(lambda: pending[0] if pending else None, begin)

    @property
    def status(self) -> Status:
        return self._loop.status

    def post(self, source: Source, order: Order) -> None:
        """Give an order without the protocol, from the console for example."""
        self._loop.post(source, order)

    def begin(self, flown: Pass, begin_s: float) -> None:
        if not self.early_s:
            _order_each_second(self.order, flown, self._clock, begin_s)
            return
        self.run_until(begin_s - self.early_s + FIRST_LOOK_S)
        if self._target is not None:
            tracker = self._target.tracker(self._loop, self._mount)
            if refused := tracker.track(self._target.words):
                raise ValueError(refused)
            apart_s = self._target.begin_utc_s - begin_s
            self._clock.every(1.0, lambda now_s: tracker.step(Now(now_s + apart_s, now_s)))
            return
        if flown.turns:
            now_s = self._clock()
            program = Program(flown.table, begin_s)
            self._loop.post(Source("track"), program_flight(program, self._antenna(), Now(now_s, now_s)).order)
            return
        path = KnownPath(tuple((begin_s + t_s, az_deg, el_deg) for t_s, az_deg, el_deg in flown.rows))
        plan = plan_flight(flown.name, path, self._antenna(), self._clock())
        self._loop.post(Source("track"), plan.order)

    def order(self, azimuth_deg: float, elevation_deg: float) -> None:
        self._session.receive(self._encode(azimuth_deg, elevation_deg))

    def _antenna(self) -> Antenna:
        stands_deg = self.status.azimuth.angle_deg or 0.0, self.status.elevation.angle_deg or 0.0
        return Antenna(self._mount, *self._motors, stands_deg)

    def run_until(self, moment_s: float) -> None:
        first, last = (math.ceil(at_s / self._period_s - 1e-9) for at_s in (self._clock(), moment_s + self._period_s))
        for count in range(first, last):
            self._clock.sleep_until(count * self._period_s)
            self._loop.cycle()
            if self._overhearing is not None:
                self._overhearing.look()

    def pointing(self) -> tuple[float, float, int, int]:
        azimuth_deg, elevation_deg = self._boom(*self.world.antenna())
        drives = self.world.drives()
        if self.world.relay_starts is None:
            drives = int(self.status.azimuth.drive), int(self.status.elevation.drive)
        return azimuth_deg, elevation_deg, *drives

    def relay_starts(self) -> int | None:
        return self.world.relay_starts

    def recognised(self) -> Named | None:
        return self._overhearing.named if self._overhearing else None

    def true_direction(self, now_s: float) -> tuple[float, float] | None:
        return self._overhearing.true_direction(now_s) if self._overhearing else None

    def faults(self) -> tuple[str, ...]:
        return tuple(map(str, self.status.faults))


class ArduinoPlant(Plant):
    """The emulated Arduino that the box replaces. Its motors and ranges come from the box's configuration."""

    def __init__(self, config: Config, clock: SimClock, start_deg: tuple[float, float]) -> None:
        self._clock = clock
        self._station = arduino_station(config, clock, clock.sleep, start_deg)

    def begin(self, flown: Pass, begin_s: float) -> None:
        _order_each_second(self.order, flown, self._clock, begin_s)

    def order(self, azimuth_deg: float, elevation_deg: float) -> None:
        self._station.host_send(_gs232_order(azimuth_deg, elevation_deg))

    def run_until(self, moment_s: float) -> None:
        self._station.run_until(moment_s)

    def pointing(self) -> tuple[float, float, int, int]:
        boom = self._station.antenna()
        return boom.azimuth_deg, boom.elevation_deg, *self._station.drives()

    def relay_starts(self) -> int:
        return self._station.relay_starts


def _order_each_second(order: Callable[[float, float], None], flown: Pass, clock: SimClock, begin_s: float) -> None:
    """Send the target's direction each second from now on, as a tracking program does: no elevation below zero."""

    def send(now_s: float) -> None:
        azimuth_deg, elevation_deg = flown.sent_at(now_s - begin_s)
        # An azimuth below zero has no form in GS-232.
        order(azimuth_deg if azimuth_deg >= 0 else azimuth_deg % 360.0, max(0.0, elevation_deg))

    clock.every(1.0, send)


def _gs232_order(azimuth_deg: float, elevation_deg: float) -> bytes:
    return encode(Command("W", azimuth_deg, elevation_deg))


def _rotctld_order(azimuth_deg: float, elevation_deg: float) -> bytes:
    return encode_request(Request("set_pos", (f"{azimuth_deg:.2f}", f"{elevation_deg:.2f}")))
