"""The control thread: reads the sensors, steps the controller, commands the drive. The only reader of the clock.

Knows when to do what. Decides nothing: that is the controller's. Owns the sensors and the drive; nobody else touches
them, but for the guard, which may open relays at any time.
"""

from __future__ import annotations

import logging
import threading
from collections import deque
from collections.abc import Callable, Mapping

from hw.ports import AngleSensor, Axis, Direction, HardwareError, SwitchedDrive
from rotator.control.controller import Controller
from rotator.control.sensing import Reading
from rotator.orders import Order, Source
from rotator.status import Status

log = logging.getLogger(__name__)


class ControlLoop:
    """`post` and `status` may be used from any thread; `cycle` belongs to one: `run`'s, or a rehearsal's."""

    def __init__(
        self,
        controller: Controller,
        drive: SwitchedDrive,
        sensors: Mapping[Axis, AngleSensor],
        clock: Callable[[], float],
        period_s: float,
    ) -> None:
        self._controller = controller
        self._drive = drive
        self._sensors = sensors
        self._clock = clock
        self._period_s = period_s
        self._inbox: deque[tuple[Source, Order]] = deque()
        self._wake = threading.Event()
        self._stopping = False
        self._readings: dict[Axis, Reading] = {}
        self._troubles: dict[str, str] = {}
        self._late_s = 0.0
        self.status: Status = controller.status(clock(), dict.fromkeys(Axis, Direction.OFF))
        """The latest status; replaced whole, never changed."""

    def post(self, source: Source, order: Order) -> None:
        """Hand over an order; it takes effect at once, not at the next cycle."""
        self._inbox.append((source, order))
        self._wake.set()

    def cycle(self) -> None:
        """Read every sensor and act. Orders that come in meanwhile do not wait for the sensors."""
        for axis, sensor in self._sensors.items():
            if self._inbox:
                self.act()
            self._readings[axis] = self._read(axis, sensor)
        self.act()

    def act(self) -> None:
        """Take the orders that have come, decide, drive, tell. With the readings as they are."""
        orders = [self._inbox.popleft() for _ in range(len(self._inbox))]
        now_s = self._clock()
        before = self.status
        runs = self._controller.step(now_s, self._readings, orders)
        driven = dict.fromkeys(Axis, Direction.OFF)
        for axis, run in runs.items():
            try:
                driven[axis] = self._drive.drive(axis, run.direction, run.until_s)
                self._trouble("drive", "")
            except HardwareError as fault:
                self._trouble("drive", str(fault))
        self.status = self._controller.status(now_s, driven, self._late_s)
        self._tell(before)

    def run(self) -> None:
        """Cycle until `stop`. Whatever goes wrong, the relays are off when this returns."""
        try:
            due_s = self._clock()
            while not self._stopping:
                self._late_s = max(0.0, self._clock() - due_s)
                self.cycle()
                # Fallen behind, it goes on from now: a burst of cycles to catch up would help nobody.
                due_s = max(due_s + self._period_s, self._clock())
                self._sleep_until(due_s)
        finally:
            self._drive.off()

    def stop(self) -> None:
        self._stopping = True
        self._wake.set()

    def _sleep_until(self, due_s: float) -> None:
        while not self._stopping:
            left_s = due_s - self._clock()
            if left_s <= 0:
                return
            if self._wake.wait(left_s):
                self._wake.clear()
                if self._inbox:
                    self.act()

    def _read(self, axis: Axis, sensor: AngleSensor) -> Reading:
        try:
            raw = sensor.read()
        except HardwareError as fault:
            self._trouble(axis.value, str(fault))
            return Reading(self._clock(), None, str(fault))
        self._trouble(axis.value, "")
        return Reading(self._clock(), raw)

    def _trouble(self, what: str, text: str) -> None:
        """Log a trouble once when it comes and once when it goes."""
        if text == self._troubles.get(what, ""):
            return
        self._troubles[what] = text
        if text:
            log.error("%s: %s", what, text)
        else:
            log.warning("%s: answers again", what)

    def _tell(self, before: Status) -> None:
        for text in self._controller.troubles:
            log.warning("%s", text)
        self._controller.troubles.clear()
        for fault in self.status.faults:
            if fault not in before.faults:
                log.error("FAULT %s", fault)
        if before.faults and not self.status.faults:
            log.warning("faults acknowledged")
        if self.status.latched != before.latched:
            log.warning(f"stopped by {self.status.latched} until released" if self.status.latched else "released")
