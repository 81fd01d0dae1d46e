"""The control loop: reads the sensors, steps the controller, commands the drive. The only reader of the clock.

Knows the timing, and logs changes of the status. The controller makes the decisions. No other code touches the rotor,
except the guard, which may open relays at any time. The sensors have a thread of their own: a slow or hanging bus
delays no order, and the loop still notices that a reading is old.
"""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable

from hw.ports import AngleSensor, Axis, Direction, HardwareError
from rotator.control.axis.sensing import Reading
from rotator.control.controller import Controller
from rotator.faults import Notice
from rotator.orders import Jog, Order, Source
from rotator.rotors.port import Rotor
from rotator.runtime.log_limit import LogLimit
from rotator.status import Status

log = logging.getLogger(__name__)

SENSORS_THREAD = "sensors"
"""The name of the thread that reads the sensors."""
LATE_PERIODS = 1.5
"""After this many periods without new readings the loop acts anyway, and notices that the sensors are silent."""
JOIN_S = 1.0
"""How long the end waits for the sensors' thread, in seconds."""


class ControlLoop:
    """`post` and `status` may be used from any thread; the rest by one thread only: `run`'s, or a rehearsal's.

    The loop calls `after_good_step` after each step in which the drives and the motors' supply obeyed. It may raise
    HardwareError.
    """

    def __init__(
        self,
        controller: Controller,
        rotor: Rotor,
        clock: Callable[[], float],
        period_s: float,
        *,
        after_good_step: Callable[[], None] = lambda: None,
    ) -> None:
        self._controller = controller
        self._after_good_step = after_good_step
        self._rotor = rotor
        self._clock = clock
        self._period_s = period_s
        self._inbox: list[tuple[Source, Order, bool]] = []
        self._inbox_lock = threading.Lock()
        self._wake = threading.Event()
        self._pause = threading.Event()
        self._stopping = False
        self._sensor_bug: Exception | None = None
        self._readings: dict[Axis, Reading] = {}
        self._failures: dict[str, str] = {}
        self._must_obey = ("supply", *(f"{axis.value} drive" for axis in Axis))
        self._late_s = 0.0
        self._supply_cut = False
        self._noticed: dict[Axis, tuple[Notice, ...]] = dict.fromkeys(Axis, ())
        self._movers = LogLimit(clock)
        self.status: Status = controller.status(clock())
        """The latest status. Each step replaces it whole; a status never changes."""

    def post(self, source: Source, order: Order, *, can_wait: bool = False) -> None:
        """Hand over an order. It takes effect at once, not in the next cycle. May be called from any thread.

        An order that `can_wait` takes effect in the next cycle. It replaces an order of the same kind from the same
        source that waits as well, so a flood of orders costs little and the newest wins.
        """
        with self._inbox_lock:
            if can_wait:
                kind = _kind(order)
                self._inbox = [
                    (giver, each, waits)
                    for giver, each, waits in self._inbox
                    if not (waits and giver == source and _kind(each) == kind)
                ]
            self._inbox.append((source, order, can_wait))
        if not can_wait:
            self._wake.set()

    def cycle(self) -> None:
        """Read every sensor, then act: the whole loop in one thread, for simulated time."""
        self._read_all()
        self.act()

    def act(self) -> None:
        """Take the orders that have come, decide, drive and log, with the latest readings.

        Raises HardwareError when the rotor is no longer guarded: nothing may move then.
        """
        self._rotor.check()
        with self._inbox_lock:
            posted, self._inbox = self._inbox, []
        orders = [(source, order) for source, order, _ in posted]
        now_s = self._clock()
        before = self.status
        commands = self._controller.step(now_s, dict(self._readings), orders)
        driven = dict.fromkeys(Axis, Direction.OFF)
        self._run_errands()
        for axis, command in commands.items():
            try:
                driven[axis] = self._rotor.obey(axis, command)
                self._note_failure(f"{axis.value} drive", "")
            except HardwareError as fault:
                self._note_failure(f"{axis.value} drive", str(fault))
        self._controller.note_driven(now_s, driven)
        self.status = self._controller.status(now_s, self._late_s)
        self._switch_supply()
        self._log_changes(before)
        self._sign_of_life()

    def _run_errands(self) -> None:
        """Do the controller's single requests, such as passing the confirmed angle of an axis to its rotor."""
        for errand in self._controller.errands:
            try:
                self._rotor.run(errand)
            except HardwareError as fault:
                log.error("%s", fault)
        self._controller.errands.clear()

    def _sign_of_life(self) -> None:
        """Feed the heartbeat line and the service manager, unless a relay may not have obeyed.

        Without the signs of life they switch the motors off.
        """
        if any(self._failures.get(what) for what in self._must_obey):
            return
        try:
            self._after_good_step()
            self._note_failure("heartbeat", "")
        except HardwareError as fault:
            self._note_failure("heartbeat", str(fault))

    def _switch_supply(self) -> None:
        """Cut the motors' supply when a fault asks for it; restore it after the acknowledgement. Try until done."""
        if self.status.cut == self._supply_cut:
            return
        try:
            if self.status.cut:
                self._rotor.cut()
            else:
                self._rotor.restore()
            self._supply_cut = self.status.cut
            self._note_failure("supply", "")
        except HardwareError as fault:
            self._note_failure("supply", str(fault))

    def run(self) -> None:
        """Act on every round of readings and on every order until `stop`. Relays are off when this returns."""
        reader = threading.Thread(target=self._keep_reading, name=SENSORS_THREAD, daemon=True)
        try:
            reader.start()
            while not self._stopping:
                asked_s = self._clock()
                self._wake.wait(self._period_s * LATE_PERIODS)
                self._wake.clear()
                if self._stopping:
                    break
                self._late_s = max(0.0, self._clock() - asked_s - self._period_s)
                self.act()
                if self._sensor_bug is not None:
                    raise self._sensor_bug
        finally:
            try:
                self._rotor.off()
            finally:
                self.stop()
                # A bus that hangs holds the thread. It is left behind: it reads only, and cannot move anything.
                reader.join(timeout=JOIN_S)

    def stop(self) -> None:
        """Let `run` end, from any thread. May be called twice."""
        self._stopping = True
        self._pause.set()
        self._wake.set()

    def _keep_reading(self) -> None:
        try:
            due_s = self._clock()
            while not self._stopping:
                self._read_all()
                self._wake.set()
                # A late round does not lead to a burst of readings: the next one is due from now on.
                due_s = max(due_s + self._period_s, self._clock())
                self._pause.wait(due_s - self._clock())
        except Exception as failure:
            # The control thread raises it, and so stops the motors.
            self._sensor_bug = failure
            self._wake.set()

    def _read_all(self) -> None:
        for axis, sensor in self._rotor.sensors.items():
            self._readings[axis] = self._read(axis, sensor)

    def _read(self, axis: Axis, sensor: AngleSensor) -> Reading:
        try:
            raw = sensor.read()
        except HardwareError as fault:
            self._note_failure(axis.value, str(fault))
            return Reading(self._clock(), None, str(fault), self._rotor.condition(axis))
        self._note_failure(axis.value, "")
        return Reading(self._clock(), raw, condition=self._rotor.condition(axis))

    def _note_failure(self, what: str, text: str) -> None:
        """Log a failure of a device once when it begins and once when it ends (empty text)."""
        if text == self._failures.get(what, ""):
            return
        self._failures[what] = text
        if text:
            log.error("%s: %s", what, text)
        else:
            log.warning("%s: answers again", what)

    def _log_changes(self, before: Status) -> None:
        """Log the controller's messages, and what is new in the status."""
        for text in self._controller.troubles:
            log.warning("%s", text)
        self._controller.troubles.clear()
        for fault in self.status.faults:
            if fault not in before.faults:
                log.log(logging.WARNING if fault.passing else logging.ERROR, "FAULT %s", fault)
        mover = self.status.controlled_by
        if mover and mover != before.controlled_by and (line := self._movers.admit(f"{mover} moves the antenna")):
            log.info("%s", line)
        if before.faults and not self.status.faults:
            passed = all(fault.passing for fault in before.faults)
            log.warning("no fault any more" if passed else "faults acknowledged")
        for axis in Axis:
            for notice in self.status.axis(axis).notices:
                if notice not in self._noticed[axis]:
                    log.warning("%s: %s", axis.value, notice)
            self._noticed[axis] = self.status.axis(axis).notices
        if self.status.latched != before.latched:
            log.warning(f"stopped by {self.status.latched} until released" if self.status.latched else "released")


def _kind(order: Order) -> object:
    """The kind of an order. Of two waiting orders of one kind, only the later one is carried out."""
    return (Jog, order.axis) if isinstance(order, Jog) else type(order)
