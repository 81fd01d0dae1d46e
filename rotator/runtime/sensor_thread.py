"""Reads the rotor's sensors in a thread of their own, so that a slow or hanging bus delays no order.

Knows when to read. Does not know what a reading means: the axis judges it, and its age.
"""

from __future__ import annotations

import threading
from collections.abc import Callable

from hw.ports import AngleSensor, Axis, HardwareError, KnowsSince
from hw.urgent import hurry
from rotator.control.axis.readings import Reading
from rotator.rotors.port import Rotor
from rotator.runtime.bell import Bell
from rotator.runtime.journal import Journal

NAMES = {axis: axis.value for axis in Axis}
"""What the journal calls the sensor of each axis."""
SENSORS_THREAD = "sensors"
"""The name of the thread."""
LONGEST_READ_S = 0.2
SLOW = f"a reading took more than {LONGEST_READ_S:g} s"
"""Such a reading may be of any moment since it began: the bus hung, or the computer stood still meanwhile."""
JOIN_S = 1.0
"""How long the end waits for the thread, in seconds."""
FIRST_S = 3.0
"""An axis without a reading for this time after the start is silent: its bus hangs, and no answer ever comes."""
NEVER_READ = "no reading since the start: the bus hangs"


class SensorThread:
    """`on_round`: called when every sensor has been read once more, and when the thread has failed."""

    def __init__(
        self,
        rotor: Rotor,
        clock: Callable[[], float],
        period_s: float,
        journal: Journal,
        on_round: Callable[[], None],
    ) -> None:
        self.failure: Exception | None = None
        """The bug that ended the thread; None: the thread runs."""
        self._rotor = rotor
        self._since = {axis: each for axis, each in rotor.sensors.items() if isinstance(each, KnowsSince)}
        """The sensors that know since when their reading holds. Found once: Python takes its time over that."""
        self._clock = clock
        self._period_s = period_s
        self._journal = journal
        self._on_round = on_round
        self._readings: dict[Axis, Reading] = {}
        self._begun_s: float | None = None
        """When the control loop first asked for readings; None: not yet."""
        self._stopping = False
        self._due = Bell()
        """Rings when the thread must not wait for its next round."""
        self._thread = threading.Thread(target=self._keep_reading, name=SENSORS_THREAD, daemon=True)

    @property
    def readings(self) -> dict[Axis, Reading]:
        """The latest reading of each axis. An axis without a reading yet is missing here, for FIRST_S at most."""
        now_s = self._clock()
        self._begun_s = now_s if self._begun_s is None else self._begun_s
        if len(self._readings) == len(self._rotor.sensors) or now_s - self._begun_s < FIRST_S:
            return dict(self._readings)
        return dict.fromkeys(self._rotor.sensors, Reading(self._begun_s, None, NEVER_READ)) | self._readings

    def read_all(self) -> None:
        """Read every sensor once: by the thread, or by hand in simulated time."""
        for axis, sensor in self._rotor.sensors.items():
            self._readings[axis] = self._read(axis, sensor)

    def start(self) -> None:
        self._thread.start()

    def stop(self) -> None:
        """Let the thread end. May be called twice, and from any thread."""
        self._stopping = True
        self._due.ring()

    def join(self) -> None:
        """Wait for the end, but not for a bus that hangs: a thread that only reads cannot move anything."""
        if self._thread.is_alive():
            self._thread.join(timeout=JOIN_S)

    def _keep_reading(self) -> None:
        hurry()
        try:
            due_s = self._clock()
            while not self._stopping:
                self.read_all()
                self._on_round()
                # If it is late, it goes on from now: a burst of readings would not help.
                due_s = max(due_s + self._period_s, self._clock())
                self._due.wait(due_s - self._clock())
        except Exception as failure:
            # The control thread raises this failure, which stops the motors.
            self.failure = failure
            self._on_round()

    def _read(self, axis: Axis, sensor: AngleSensor) -> Reading:
        begun_s = self._clock()
        since_s = self._since[axis].since_s if axis in self._since else begun_s
        raw, trouble = None, ""
        try:
            raw = sensor.read()
        except HardwareError as fault:
            trouble = str(fault)
        now_s = self._clock()
        late = not trouble and now_s - begun_s > LONGEST_READ_S
        if late:
            raw, trouble = None, SLOW
        self._journal.note(NAMES[axis], trouble)
        return Reading(now_s, raw, trouble, self._rotor.condition(axis), since_s, late)
