"""One hobby servo: its next pulse, and the angle at which the model assumes it.

Knows how fast the ordered angle may move. Knows no chip, no thread and no other axis. A servo reports nothing, so the
angle is a model, which assumes that the servo can follow its pulses.
"""

from __future__ import annotations

from dataclasses import dataclass

from hw.drives.scale import CommandScale

FRAME_S = 0.02
"""A servo gets a pulse 50 times a second, and takes each new width."""


@dataclass(frozen=True, slots=True)
class ServoSpec:
    """One servo on the board's output `channel`. `pulses_us`: pairs of an angle on the rotor's scale and a width."""

    channel: int
    pulses_us: tuple[tuple[float, float], ...]
    start_deg: float
    """The angle of the first pulse. The servo jumps to it at its own speed, which no pulse can slow down."""
    slew_dps: float
    """How fast the ordered angle moves; it must be less than the servo's own speed."""


@dataclass(frozen=True, slots=True)
class _Course:
    """A line in time: `angle_deg` at the moment `since_s`, moving on at `rate_dps`, until `until_s`."""

    angle_deg: float
    rate_dps: float
    since_s: float
    until_s: float

    def at(self, now_s: float) -> float:
        return self.angle_deg + self.rate_dps * (now_s - self.since_s)


class ServoAxis:
    """`name` opens each error. Raises HardwareError for a wrong table of pulses, or a start outside it."""

    def __init__(self, name: str, spec: ServoSpec) -> None:
        self.spec = spec
        self.scale = CommandScale(name, spec.pulses_us)
        self.scale.check(spec.start_deg)
        self.angle_deg = spec.start_deg
        self.pulsing = False
        self.settled_s = float("inf")
        """End of the jump of the first pulse, even for the whole travel; infinite before the first pulse."""
        self.moved_s = float("-inf")
        """When the pulse last changed."""
        self.limp = False
        """Stopped during the jump of the first pulse. Then only the end of its pulses stops a servo."""
        self._course: _Course | None = None
        self._stepped_s = float("-inf")
        self._jump_s = self._longest_jump_s
        """How long the jump may still take. Short presses add up: the servo goes on from where it went limp."""

    def found(self, angle_deg: float, *, holds: bool) -> None:
        """The board's last pulse was for this angle. `holds`: it still makes that pulse, and the servo stands there."""
        self.angle_deg = self.scale.nearest_deg(angle_deg)
        self._jump_s = self._longest_jump_s
        if holds:
            self.pulsing, self.settled_s = True, float("-inf")

    def aim(self, angle_deg: float, rate_dps: float, now_s: float, until_s: float) -> None:
        """Raises HardwareError for an angle outside the calibration table."""
        self.scale.check(angle_deg)
        self._course = _Course(angle_deg, rate_dps, now_s, until_s)
        self.limp = False

    def hold(self, now_s: float) -> None:
        """Keep the present pulse: a servo holds at the angle of its pulse. During the first jump, end the pulses."""
        self.limp = self.limp or (self.pulsing and now_s < self.settled_s)
        self._course = None

    def expire(self, now_s: float) -> None:
        if self._course and self._course.until_s <= now_s:
            self.hold(now_s)

    def wake(self, now_s: float) -> None:
        """The chip now starts to send pulses. After `sleep(lost=True)` the servo jumps from an unknown angle."""
        self.pulsing, self.moved_s = True, now_s
        if self._lost:
            self.settled_s = now_s + self._jump_s

    def sleep(self, *, lost: bool) -> None:
        """The chip now stops its pulses. `lost`: the servo is limp, and wind may turn it."""
        self.pulsing = self.limp = False
        if lost:
            self.settled_s = float("inf")
            self._jump_s = self._longest_jump_s

    def stop_jump(self, now_s: float) -> None:
        """The chip now stops its pulses, before the jump is over."""
        self._jump_s = max(0.0, self.settled_s - now_s)
        self.pulsing = self.limp = False
        self.settled_s = float("inf")

    @property
    def width_us(self) -> float:
        return self.scale.value(self.angle_deg)

    @property
    def under_way(self) -> bool:
        return self._course is not None

    def due_s(self) -> float:
        """When the next step is due, or the present command expires; infinite: there is no command."""
        if self.limp:
            return float("-inf")
        if self._course is None:
            return float("inf")
        if self._arrived:
            return self._course.until_s
        if not self.pulsing:
            return self._stepped_s
        return min(max(self._stepped_s + FRAME_S, self.settled_s), self._course.until_s)

    def next_deg(self, now_s: float) -> float:
        """The angle of the next pulse: as near to the course as the slew rate allows, also after a late call."""
        if self._course is None or not self.pulsing:
            return self.angle_deg
        most_deg = self.spec.slew_dps * min(now_s - self._stepped_s, 2 * FRAME_S)
        error_deg = self.scale.nearest_deg(self._course.at(now_s)) - self.angle_deg
        return self.angle_deg + min(max(error_deg, -most_deg), most_deg)

    def stepped(self, angle_deg: float, now_s: float) -> None:
        """The pulse for `angle_deg` has been sent."""
        if angle_deg != self.angle_deg:
            self.angle_deg, self.moved_s = angle_deg, now_s
        self._stepped_s = now_s

    @property
    def _longest_jump_s(self) -> float:
        """Seconds from the farther end of its travel to the angle of the first pulse."""
        start_deg = self.angle_deg
        return max(start_deg - self.scale.low_deg, self.scale.high_deg - start_deg) / self.spec.slew_dps

    @property
    def _lost(self) -> bool:
        return self.settled_s == float("inf")

    @property
    def _arrived(self) -> bool:
        """Whether the command is to stay at one angle, and the pulse of that angle has been sent."""
        course = self._course
        return course is not None and not self._lost and course.rate_dps == 0 and course.angle_deg == self.angle_deg
