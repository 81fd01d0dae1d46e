"""A rotor of control boxes that follow a knob, each knob replaced by a digital potentiometer: a positioned drive.

Knows leases, steps, and a model of the box: one speed, and a dead band in which it does not bother. The chips cannot be
asked and the box tells nothing, so the angle is modelled; `found` corrects it where the rotor's own pot is measured.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable
from dataclasses import dataclass

from hw.chips.mcp41010 import STEPS, Mcp41010
from hw.drives.relays import LONGEST_LEASE_S
from hw.drives.scale import Scale
from hw.ports import AngleSource, Axis, HardwareError, OutputLines

ENABLE = "box_enable"
"""The relay that feeds the boxes: without it they turn to the middle at power-on, where the chips start."""

REFRESH_S = 1.0
"""How often the steps are sent again: a chip whose supply dips forgets, and cannot say so."""


@dataclass(frozen=True, slots=True)
class BoxSpec:
    """One axis. `steps` are pairs of an angle on the rotor's scale and the wiper's step there, 0 to 256."""

    steps: tuple[tuple[float, float], ...] = ((0.0, 0.0), (360.0, 256.0))
    start_deg: float = 0.0
    """Where it is taken to stand when the program starts."""
    speed_dps: float = 6.0
    dead_band_deg: float = 2.0


class _Box:
    """One axis: what its chip has been told, and where that has brought the model."""

    def __init__(self, name: str, chip: Mcp41010, spec: BoxSpec, now_s: float) -> None:
        self.chip = chip
        self.spec = spec
        self.scale = Scale(name, spec.steps)
        self.scale.check(spec.start_deg)
        if self.scale.values[0] < 0 or self.scale.values[1] > STEPS:
            raise HardwareError(f"{name}: the calibration table names steps that are none: they are 0 to {STEPS}")
        self.step: int | None = None
        self.until_s: float | None = None
        self.angle_deg = spec.start_deg
        self._now_s = now_s

    @property
    def resolution_deg(self) -> float:
        low, high = self.scale.values
        return (self.scale.high_deg - self.scale.low_deg) / (high - low)

    def advance(self, now_s: float, powered: bool) -> None:
        """Let the model run as the box does: at one speed, until the error is within the dead band."""
        past_s, self._now_s = max(0.0, now_s - self._now_s), now_s
        if not powered or self.step is None:
            return
        error_deg = self.scale.angle_deg(self.step) - self.angle_deg
        way_deg = min(max(0.0, abs(error_deg) - self.spec.dead_band_deg), self.spec.speed_dps * past_s)
        self.angle_deg += way_deg if error_deg > 0 else -way_deg

    def order(self, angle_deg: float) -> None:
        """Send the nearest step, if it is another one. What the chip has been told is known only when it has been."""
        step = min(round(self.scale.value(angle_deg)), STEPS - 1)
        if step != self.step:
            self.chip.write(step)
            self.step = step

    def hold(self) -> None:
        """Order where it is: the error is then within the dead band, and the box stops."""
        if self.step is not None:
            self.order(self.scale.within(self.angle_deg))
        self.until_s = None


class DigipotDrive:
    """Safe to call from any thread. `clock` gives seconds; `until_s` of an aim is on the same clock.

    `enable`: the line `ENABLE`, where the relay is wired; it closes when both chips have been told a position. Raises
    HardwareError for a calibration table that is none.
    """

    def __init__(
        self,
        azimuth: tuple[Mcp41010, BoxSpec],
        elevation: tuple[Mcp41010, BoxSpec],
        clock: Callable[[], float],
        *,
        enable: OutputLines | None = None,
    ) -> None:
        self._clock = clock
        self._enable = enable
        self._powered = False
        self._refresh_s = 0.0
        self._boxes = {
            Axis.AZIMUTH: _Box("azimuth box", *azimuth, clock()),
            Axis.ELEVATION: _Box("elevation box", *elevation, clock()),
        }
        self._changed = threading.Condition(threading.RLock())

    # --- hw.ports.PositionedDrive

    def aim(self, axis: Axis, angle_deg: float, rate_dps: float, until_s: float) -> None:
        """As the port says, in steps; orders come faster than steps change, so that `rate_dps` does not matter here.

        Refuses an angle outside the axis's calibration table, and moves nothing then.
        """
        with self._changed:
            now_s = self._advance()
            box = self._boxes[axis]
            if until_s <= now_s:
                box.hold()
                return
            box.scale.check(angle_deg)
            self._feed(now_s)
            box.until_s = min(until_s, now_s + LONGEST_LEASE_S)
            box.order(angle_deg)
            self._changed.notify_all()

    def hold(self, axis: Axis) -> None:
        with self._changed:
            self._advance()
            self._boxes[axis].hold()

    def off(self) -> None:
        """Both boxes stop; one whose chip cannot be told does not keep the other going. Raises HardwareError."""
        with self._changed:
            self._advance()
            self._each(self._boxes.values(), _Box.hold)

    def release(self) -> None:
        """Take the boxes' supply. The next aim gives it back. Raises HardwareError where no relay can."""
        with self._changed:
            if self._enable is None:
                raise HardwareError("the control boxes cannot be released: no relay is wired to their supply")
            self._advance()
            self._enable.set({ENABLE: False})
            self._powered = False
            for box in self._boxes.values():
                box.until_s = None

    def due_s(self) -> float | None:
        with self._changed:
            moments = [box.until_s for box in self._boxes.values() if box.until_s is not None]
            return min([*moments, self._refresh_s] if self._powered else moments, default=None)

    def enforce(self, now_s: float) -> None:
        """Hold what has expired, and say again what has been said. Raises the first HardwareError."""
        with self._changed:
            self._advance()
            expired = [box for box in self._boxes.values() if box.until_s is not None and box.until_s <= now_s]
            self._each(expired, _Box.hold)
            if self._powered and now_s >= self._refresh_s:
                self._refresh_s = now_s + REFRESH_S
                self._each(self._boxes.values(), _say_again)

    def wait_until_due(self, patience_s: float) -> None:
        """Sleep until `enforce` has something to do, or an order came, or that long. For the guard thread."""
        with self._changed:
            due_s = self.due_s()
            left_s = patience_s if due_s is None else min(patience_s, due_s - self._clock())
            if left_s > 0:
                self._changed.wait(left_s)

    # --- how it is

    def sensor(self, axis: Axis) -> DigipotSensor:
        return DigipotSensor(self, axis)

    def angle_deg(self, axis: Axis) -> float:
        """Where the rotor is taken to be."""
        with self._changed:
            self._advance()
            return self._boxes[axis].angle_deg

    def found(self, axis: Axis, angle_deg: float) -> None:
        """The rotor has been measured to stand there now; the model goes on from that."""
        with self._changed:
            self._advance()
            self._boxes[axis].angle_deg = angle_deg

    def resolution_deg(self, axis: Axis) -> float:
        """What one step of the chip is on the rotor's scale: 1.41° where 256 are 360°."""
        return self._boxes[axis].resolution_deg

    def _advance(self) -> float:
        now_s = self._clock()
        for box in self._boxes.values():
            box.advance(now_s, self._powered)
        return now_s

    def _feed(self, now_s: float) -> None:
        """Give the boxes their supply, once the chips tell them to stay where they are."""
        if self._powered:
            return
        for box in self._boxes.values():
            box.step = None  # whatever was said before the supply went may be forgotten
            box.order(box.scale.within(box.angle_deg))
        if self._enable:
            self._enable.set({ENABLE: True})
        self._powered = True
        self._refresh_s = now_s + REFRESH_S

    def _each(self, boxes: Iterable[_Box], does: Callable[[_Box], None]) -> None:
        failures: list[HardwareError] = []
        for box in boxes:
            try:
                does(box)
            except HardwareError as failure:
                failures.append(failure)
        if failures:
            raise failures[0]


def _say_again(box: _Box) -> None:
    if box.step is not None:
        box.chip.write(box.step)


class DigipotSensor:
    """One axis of the drive as an angle sensor; its readings are degrees already."""

    source = AngleSource.MODELLED

    def __init__(self, drive: DigipotDrive, axis: Axis) -> None:
        self._drive = drive
        self._axis = axis

    def read(self) -> float:
        """Degrees on the rotor's own scale."""
        return self._drive.angle_deg(self._axis)
