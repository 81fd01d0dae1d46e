"""A rotor behind ready-made controllers: a positioned drive and two angle sensors.

Knows threads: the guard's thread writes, whatever is due; a thread for each controller opens its port, reads, and opens
it again when it has gone. In simulated time one thread does both. Knows leases. Does not know what bytes mean.
"""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable, Iterable
from dataclasses import dataclass

from hw.controllers.course import Wish
from hw.controllers.port import Port, why
from hw.controllers.unit import Trouble, Unit
from hw.drives.leases import LONGEST_LEASE_S, wait_until
from hw.drives.positioned import DriveAngle
from hw.ports import AngleSource, Axis, HardwareError

log = logging.getLogger(__name__)

READ_S = 0.2
BACK_OFF_S = (0.2, 5.0)
"""The shortest and the longest pause before the next try to connect, in seconds."""


@dataclass(frozen=True, slots=True)
class Connection:
    """A controller, and what opens the way to it. `due_s`: in simulated time, when bytes come on it."""

    unit: Unit
    open: Callable[[], Port]
    due_s: Callable[[], float | None]


class ControllerAngle(DriveAngle):
    """Its reading is the controller's latest answer."""

    def __init__(self, drive: ControllerDrive, axis: Axis) -> None:
        super().__init__(drive, axis)
        self._unit = drive.unit(axis)

    @property
    def since_s(self) -> float:
        return self._unit.since_s


class ControllerDrive:
    """Safe to call from any thread. `clock` gives seconds. `in_step`: time is simulated, and nothing has a thread."""

    angle_source = AngleSource.MEASURED

    def __init__(self, connections: Iterable[Connection], clock: Callable[[], float], *, in_step: bool = False) -> None:
        self._connections = tuple(connections)
        self._units = {axis: each.unit for each in self._connections for axis in each.unit.courses}
        self._clock = clock
        self._in_step, self._retry_s = in_step, clock()
        self._changed = threading.Condition()
        self._wire = threading.Lock()
        """Held while bytes go out. No caller waits for it."""
        self._ports: dict[Unit, Port] = {}
        self._closing = threading.Event()
        self._threads = [
            threading.Thread(target=self._serve, args=(each,), name="controller", daemon=True)
            for each in self._connections
        ]

    # --- hw.ports.PositionedDrive

    def aim(self, axis: Axis, angle_deg: float, rate_dps: float, until_s: float) -> None:
        with self._changed:
            now_s, unit = self._clock(), self.unit(axis)
            if unit.offline is not None:
                raise HardwareError(f"{unit.name}: {unit.offline}")
            if until_s <= now_s:
                unit.courses[axis].hold()
            else:
                wish = Wish(angle_deg, rate_dps, now_s, min(until_s, now_s + LONGEST_LEASE_S))
                unit.courses[axis].aim(wish)
                unit.look()
            self._changed.notify_all()

    def hold(self, axis: Axis) -> None:
        with self._changed:
            self.unit(axis).courses[axis].hold()
            self._changed.notify_all()

    def halt(self, axis: Axis) -> None:
        """A person presses stop: it goes to the controller whether this box has sent it anywhere or not."""
        with self._changed:
            self.unit(axis).courses[axis].halt()
            self._changed.notify_all()

    def release(self) -> None:
        """As `off`: no controller lets go of its motors."""
        self.off()

    def off(self) -> None:
        with self._changed:
            for axis, unit in self._units.items():
                unit.courses[axis].hold()
            self._changed.notify_all()

    def due_s(self) -> float | None:
        with self._changed:
            dues_s = [each.unit.due_s() for each in self._connections]
            if self._in_step:
                dues_s += [each.due_s() if each.unit in self._ports else self._retry_s for each in self._connections]
        return min((due_s for due_s in dues_s if due_s is not None), default=None)

    def enforce(self, now_s: float) -> None:
        """Send what is due: above all the stop of each axis whose command has expired."""
        for each in self._connections:
            if self._in_step:
                self._serve_in_step(each, now_s)
            port = self._ports.get(each.unit)
            with self._wire:
                with self._changed:
                    data = each.unit.step(now_s)
                if data and port is not None:
                    try:
                        port.write(data)
                    except OSError as fault:
                        self._lost(each.unit, why(fault))

    def wait_until_due(self, patience_s: float) -> None:
        """For the guard's thread: sleep until `enforce` is due or something has changed."""
        with self._changed:
            wait_until(self._changed, self.due_s(), self._clock, patience_s)

    # --- the connections

    def start(self) -> None:
        """Open the ports, in threads. In simulated time `enforce` does it."""
        for thread in () if self._in_step else self._threads:
            thread.start()

    def finish(self) -> None:
        """After the guard's end: send the last stops, and give the ports back. May be called twice."""
        if not self._closing.is_set():
            self.enforce(self._clock())
        self._closing.set()
        for port in tuple(self._ports.values()):
            port.close()
        for thread in self._threads:
            if thread.is_alive():
                thread.join(timeout=1.0)

    def _serve_in_step(self, connection: Connection, now_s: float) -> None:
        """Take what has come; or open the port again, where it has gone. Never waits."""
        unit, port = connection.unit, self._ports.get(connection.unit)
        try:
            if port is not None:
                self._take(unit, port.read(0.0), now_s)
            elif now_s >= self._retry_s:
                self._retry_s = now_s + BACK_OFF_S[0]
                self._connect(unit, connection.open())
        except OSError as fault:
            self._lost(unit, why(fault))

    def _serve(self, connection: Connection) -> None:
        """Open the port and read it, again and again."""
        unit, wait_s, told = connection.unit, BACK_OFF_S[0], ""
        while not self._closing.is_set():
            try:
                port = connection.open()
            except Exception as fault:  # pyserial's URLs raise what their options run into
                reason = why(fault)
            else:
                self._connect(unit, port)
                log.info("controller: %s: connected", unit.name)
                wait_s, told = BACK_OFF_S[0], ""
                reason = self._read(unit, port)
                port.close()
            self._lost(unit, reason)
            if reason != told and not self._closing.is_set():
                log.warning("controller: %s: %s; trying again", unit.name, reason)
                told = reason
            self._closing.wait(wait_s)
            wait_s = min(2 * wait_s, BACK_OFF_S[1])

    def _read(self, unit: Unit, port: Port) -> str:
        """Take what comes, until the port fails. Returns why it did."""
        try:
            while not self._closing.is_set() and self._ports.get(unit) is port:
                if data := port.read(READ_S):
                    self._take(unit, data, self._clock())
        except (OSError, ValueError) as fault:  # ValueError: closed in another thread
            return why(fault)
        return unit.offline or "closed"

    def _take(self, unit: Unit, data: bytes, now_s: float) -> None:
        if data:
            with self._changed:
                unit.received(data, now_s)
                self._changed.notify_all()

    def _connect(self, unit: Unit, port: Port) -> None:
        with self._changed:
            self._ports[unit] = port
            unit.connected(self._clock())
            self._changed.notify_all()

    def _lost(self, unit: Unit, reason: str) -> None:
        with self._changed:
            self._ports.pop(unit, None)
            unit.lost(reason)
            self._changed.notify_all()

    # --- how it is

    def unit(self, axis: Axis) -> Unit:
        return self._units[axis]

    def sensor(self, axis: Axis) -> ControllerAngle:
        return ControllerAngle(self, axis)

    @property
    def answered(self) -> bool:
        """Whether every axis has told an angle."""
        with self._changed:
            return all(unit.courses[axis].angle_deg is not None for axis, unit in self._units.items())

    def angle_deg(self, axis: Axis) -> float:
        """Degrees on the rotor's own scale. Raises HardwareError: no connection, or its answer is too old."""
        with self._changed:
            unit = self.unit(axis)
            angle_deg, trouble = unit.courses[axis].angle_deg, unit.trouble(axis, self._clock())
        if trouble and trouble[0] is not Trouble.RUNS_ON:
            raise HardwareError(trouble[1])
        if angle_deg is None:
            raise HardwareError(f"{unit.name}: no answer yet")
        return angle_deg

    def trouble(self, axis: Axis) -> tuple[Trouble, str] | None:
        with self._changed:
            return self.unit(axis).trouble(axis, self._clock())

    def by_hand(self, axis: Axis) -> tuple[bool, bool]:
        """Whether it is being turned at its own controls, and whether it was turned away from where it was sent."""
        with self._changed:
            course = self.unit(axis).courses[axis]
            return course.by_hand(self._clock()), course.left_to_hand

    def waits(self, axis: Axis) -> bool:
        """Whether its controller does not bear its next target yet, and its motor is off meanwhile."""
        with self._changed:
            return self.unit(axis).courses[axis].waits
