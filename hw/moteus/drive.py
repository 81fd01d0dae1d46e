"""A rotor of two moteus controllers: a positioned drive and two angle sensors.

Knows leases, and that several threads use the drive while one thread serves the controllers. Does not know the library
nor the CAN bus: `hw.moteus.bus` sends the orders and passes on the answers.
"""

from __future__ import annotations

import threading
from collections.abc import Callable

from hw.drives.leases import LONGEST_LEASE_S
from hw.drives.positioned import DriveAngle
from hw.moteus.axis import FORGIVEN_S, STALE_S, MoteusAxis, Wish
from hw.moteus.faults import Limit
from hw.moteus.orders import Answer, MoteusSpec, Order
from hw.ports import AngleSource, Axis, HardwareError


class MoteusAngle(DriveAngle):
    """Its reading is the controller's latest answer."""

    def __init__(self, drive: MoteusDrive, axis: Axis, since_s: Callable[[], float]) -> None:
        super().__init__(drive, axis)
        self._since_s = since_s

    @property
    def since_s(self) -> float:
        return self._since_s()


class MoteusDrive:
    """Safe to call from any thread. `clock` gives seconds; `until_s` of an aim is on the same clock. `look_only`: only
    query the controllers.

    Raises HardwareError if both axes have the same CAN id.
    """

    angle_source = AngleSource.MEASURED

    def __init__(
        self,
        azimuth: MoteusSpec | None,
        elevation: MoteusSpec | None,
        clock: Callable[[], float],
        *,
        look_only: bool = False,
    ) -> None:
        if azimuth and elevation and azimuth.can_id == elevation.can_id:
            raise HardwareError(f"azimuth and elevation both have CAN id {azimuth.can_id}: give one another with tview")
        self._clock = clock
        self._lock = threading.RLock()
        specs = {Axis.AZIMUTH: azimuth, Axis.ELEVATION: elevation}
        self._axes = {axis: MoteusAxis(spec, look_only=look_only) for axis, spec in specs.items() if spec}
        self._offline: str | None = None
        self.on_news: Callable[[], None] = lambda: None
        """The drive calls this when an order must be sent at once. The bus sets it."""
        self.on_return: Callable[[Axis, float], None] = lambda _axis, _seconds: None
        """The drive calls this when a controller answers again, with the seconds of silence. The bus sets it."""

    # --- hw.ports.PositionedDrive

    def aim(self, axis: Axis, angle_deg: float, rate_dps: float, until_s: float) -> None:
        with self._lock:
            now_s = self._clock()
            if until_s <= now_s:
                self._axes[axis].hold()
            else:
                self._reached(axis).aim(angle_deg, rate_dps, min(until_s, now_s + LONGEST_LEASE_S), now_s)
        self.on_news()

    def hold(self, axis: Axis) -> None:
        """Decelerate, and hold at the angle of rest. The watchdog of an unreachable controller does the same."""
        with self._lock:
            self._axes[axis].hold()
        self.on_news()

    def release(self) -> None:
        with self._lock:
            for axis in self._axes.values():
                axis.release()
        self.on_news()

    def off(self) -> None:
        with self._lock:
            for axis in self._axes.values():
                axis.hold()
        self.on_news()

    def due_s(self) -> float | None:
        with self._lock:
            return min((axis.until_s for axis in self._axes.values() if axis.wish is Wish.AIM), default=None)

    def enforce(self, now_s: float) -> None:
        with self._lock:
            expired = [axis for axis in self._axes.values() if axis.wish is Wish.AIM and axis.until_s <= now_s]
            for axis in expired:
                axis.hold()
        if expired:
            self.on_news()

    # --- how it is

    def sensor(self, axis: Axis) -> MoteusAngle:
        return MoteusAngle(self, axis, lambda: self._axes[axis].hearing.asked_s)

    def angle_deg(self, axis: Axis) -> float:
        """Degrees on the rotor's own scale. Raises HardwareError: no answer, or its position is unknown."""
        with self._lock:
            return self._reached(axis).angle_deg(self._clock())

    def position_known(self, axis: Axis) -> bool:
        """False: after power-on the encoder cannot tell the turn. `confirm` makes the position known."""
        with self._lock:
            return self._axes[axis].position_known

    def forgiven(self, axis: Axis) -> bool:
        """Whether the axis, if it is silent now and answered at once, would obey without an acknowledgement."""
        with self._lock:
            return self._axes[axis].hearing.silent_s(self._clock()) <= FORGIVEN_S

    def faults(self) -> dict[Axis, str]:
        """For each stopped axis: the fault, as a sentence. It stays until `acknowledge`."""
        with self._lock:
            return {name: axis.fault for name, axis in self._axes.items() if axis.fault}

    def limits(self) -> dict[Axis, Limit]:
        """For each limited axis: the limit that its controller meets without a fault, such as the position bounds."""
        with self._lock:
            return {name: axis.limited_by for name, axis in self._axes.items() if axis.limited_by}

    def misses(self, axis: Axis) -> int:
        """The number of orders that its controller has not answered since the start."""
        with self._lock:
            return self._axes[axis].hearing.misses

    def answer(self, axis: Axis) -> Answer | None:
        """The controller's latest answer: volts, temperature, mode; None: it has not answered yet."""
        with self._lock:
            return self._axes[axis].answer

    # --- on an operator's request only

    def acknowledge(self, axis: Axis) -> None:
        """Clear the axis's fault. If its cause is still present, it comes back. Raises HardwareError: no answer."""
        with self._lock:
            self._reached(axis).acknowledge(self._clock())
        self.on_news()

    def confirm(self, axis: Axis, angle_deg: float, *, exactly: bool = False) -> None:
        """The axis stands at this angle: `exactly`, or at the nearest angle that agrees with the rotor's encoder.

        `position_known` becomes True when the controller has the angle. For a moment the motor has no torque.
        Raises HardwareError: no answer, or no finite angle.
        """
        with self._lock:
            self._reached(axis).confirm(angle_deg, exactly, self._clock())
        self.on_news()

    # --- for the bus

    @property
    def specs(self) -> dict[Axis, MoteusSpec]:
        return {name: axis.spec for name, axis in self._axes.items()}

    def order(self, axis: Axis) -> Order | None:
        """The order to send to this axis's controller now; None: none is due."""
        with self._lock:
            now_s = self._clock()
            self.enforce(now_s)
            return self._axes[axis].order(now_s)

    def next_order_s(self) -> float:
        """When the next order is due."""
        with self._lock:
            return min(axis.due_s() for axis in self._axes.values())

    def next_order_in_s(self) -> float:
        """The seconds until the next order is due; 0: now."""
        return max(0.0, self.next_order_s() - self._clock())

    def heard(self, axis: Axis, order: Order, answer: Answer) -> None:
        """The controller answered that order."""
        with self._lock:
            self._offline = None
            found = self._axes[axis]
            found.heard(order, answer, self._clock())
            gap_s = found.hearing.gap_s if found.hearing.came_back else 0.0
        if gap_s:
            self.on_return(axis, gap_s)

    def missed(self, axis: Axis) -> None:
        """The latest order to this axis was not answered."""
        with self._lock:
            self._axes[axis].missed()

    def lost(self, reason: str) -> None:
        """The connection is lost. `reason` is the error that callers get until a controller answers again."""
        with self._lock:
            self._offline = reason
            for axis in self._axes.values():
                axis.missed()

    @property
    def at_rest(self) -> bool:
        """Whether the bus may be closed: both axes hold or have no torque, and each request is delivered."""
        with self._lock:
            return all(axis.at_rest for axis in self._axes.values())

    def _reached(self, axis: Axis) -> MoteusAxis:
        """The axis. Raises HardwareError if the connection is lost and its last answer is too old."""
        found = self._axes[axis]
        if self._offline and found.hearing.silent_s(self._clock()) > STALE_S:
            raise HardwareError(self._offline)
        return found
