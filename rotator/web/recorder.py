"""Records the flight of a known pass: target, antenna, motors, each half a second, and each switching of a relay.

Knows statuses and the path of the flight's order. The memory is bounded: a long pass is thinned. Times are those of the
status. Does not know files, nor how a pass is drawn.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import pairwise

from hw.ports import Axis
from rotator.control.sky.known_path import KnownPath
from rotator.control.sky.mount import counted_target
from rotator.exchange.flight_order import Fly
from rotator.exchange.status import AxisStatus, Status
from rotator.views.trace import Sample, errors_deg, rms

EVERY_S = 0.5
MOST_SAMPLES, MOST_CLICKS = 4000, 2000
LEAST_S = 20.0
"""Seconds: a flight followed for less is not shown."""


@dataclass(frozen=True, slots=True)
class Record:
    """A pass that is over. `begin_s`: begin of its samples on the clock of the status; their times count from it."""

    name: str
    begin_s: float
    trace: tuple[Sample, ...]
    clicks_s: dict[str, list[float]]
    relay_starts: int | None
    """None: no relay starts the motors."""
    motor_s: float = 0.0
    """How long motors ran, the two added."""
    faults: tuple[str, ...] = ()
    """Each fault that stopped an axis in it, in a few words."""

    @property
    def errors_deg(self) -> list[float]:
        return errors_deg(self.trace)

    @property
    def rms_deg(self) -> float:
        return rms(self.errors_deg)


@dataclass(slots=True)
class _Running:
    name: str
    begin_s: float
    path: KnownPath
    every_s: float = EVERY_S
    trace: list[Sample] = field(default_factory=list)
    clicks_s: dict[str, list[float]] = field(default_factory=lambda: {axis.value: [] for axis in Axis})
    relays: bool = False
    starts: dict[str, int] = field(default_factory=dict)
    motor_s: float = 0.0
    seen_s: float = 0.0
    faults: dict[str, None] = field(default_factory=dict)

    def see(self, status: Status) -> None:
        t_s = status.at_s - self.begin_s
        self.motor_s += (t_s - self.seen_s) * sum(status.axis(axis).drive != 0 for axis in Axis)
        self.seen_s = t_s
        for axis in Axis:
            self._count(axis, status.axis(axis), t_s)
        if self.trace and t_s < self.trace[-1].t + self.every_s:
            return
        azimuth, elevation = status.azimuth, status.elevation
        if azimuth.points_deg is None or elevation.points_deg is None:
            return
        antenna_deg = azimuth.points_deg, elevation.points_deg
        target_deg = self.path.direction(status.at_s)
        if target_deg[1] >= 0:
            target_deg = counted_target(status.fitted, antenna_deg, target_deg)
        self.trace.append(Sample(t_s, *target_deg, *antenna_deg, int(azimuth.drive), int(elevation.drive)))
        if len(self.trace) >= MOST_SAMPLES:
            self.trace, self.every_s = self.trace[::2], 2 * self.every_s

    def _count(self, axis: Axis, seen: AxisStatus, t_s: float) -> None:
        """Take the controller's count of starts: samples alone would miss a short run."""
        if (starts := seen.starts) is None:
            return
        self.relays = True
        # A motor that already runs when the record begins counts as just started.
        new = starts - self.starts.get(axis.value, starts - abs(int(seen.drive)))
        self.starts[axis.value] = starts
        clicks_s = self.clicks_s[axis.value]
        clicks_s += [t_s] * min(max(0, new), MOST_CLICKS - len(clicks_s))


class Recorder:
    """`look` may be called from one thread only."""

    def __init__(self) -> None:
        self.over: Callable[[Record], None] = lambda _record: None
        """Called with each flown pass, or its part up to a stop."""
        self._ordered: Fly | None = None
        self._running: _Running | None = None

    def note_order(self, order: object) -> None:
        """Take the target's path from a flight; other orders are ignored. Called from any thread."""
        if isinstance(order, Fly):
            self._ordered = order

    def look(self, status: Status) -> None:
        flown, order = status.flown, self._ordered
        up = flown is not None and flown.begin_s <= status.at_s
        if self._running is not None:
            # A fault may end the flight: it belongs to the flight that it has ended.
            self._running.faults |= {f"{fault.axis.value}: {fault.name}": None for fault in status.faults}
        if self._running is not None and (flown is None or not up or flown.name != self._running.name):
            self.end()
        if flown is None or not up or order is None or order.name != flown.name or status.at_s < order.path[0][0]:
            return  # also where the antenna is on its way to a target that is up already
        if self._running is None:
            self._running = _Running(flown.name, status.at_s, KnownPath(order.path))
        elif self._running.path.rows is not order.path:
            self._running.path = KnownPath(order.path)
        self._running.see(status)

    def end(self) -> None:
        """The pass ends here."""
        running, self._running = self._running, None
        if running is None:
            return
        lasted_s = sum(after.t - before.t for before, after in pairwise(running.trace) if before.target_el >= 0)
        record = Record(
            running.name,
            running.begin_s,
            tuple(running.trace),
            running.clicks_s,
            sum(map(len, running.clicks_s.values())) if running.relays else None,
            running.motor_s,
            tuple(running.faults),
        )
        if lasted_s >= LEAST_S and record.errors_deg:
            self.over(record)
