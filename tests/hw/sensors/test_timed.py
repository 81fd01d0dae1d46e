"""An angle that is reckoned by time: a motor of 6°/s one way and 5°/s the other, between stops at 0° and 360°."""

from __future__ import annotations

import pytest

from firmware_sim.clock import SimClock
from hw.drives.relays import RELAYS
from hw.ports import Axis, Direction
from hw.sensors.pulses import TappedLines
from hw.sensors.timed import TimedAngle, TimedMotor
from tests.tables import every_row

PLUS, MINUS = Direction.PLUS, Direction.MINUS
MOTOR = TimedMotor(6.0, 5.0, start_s=0.0, lag_s=0.1, low_deg=0.0, high_deg=360.0, error_share=0.02, start_error_deg=0.1)


class NoLines:
    def set(self, levels: dict[str, bool]) -> None: ...

    def close(self) -> None: ...


class Rig:
    """What the relays' lines do is all that the model is told."""

    def __init__(self, motor: TimedMotor = MOTOR, at_deg: float = 100.0) -> None:
        self.clock = SimClock(50.0)
        self.lines = TappedLines(NoLines(), self.clock)
        self.angle = TimedAngle(Axis.AZIMUTH, self.lines, motor, self.clock)
        self.angle.place(at_deg)

    def closed(self, direction: Direction, seconds: float) -> None:
        """A relay closes for so long, and the motor comes to rest. Nobody reads meanwhile."""
        self.lines.set({RELAYS[Axis.AZIMUTH, direction]: True})
        self.clock.sleep(seconds)
        self.lines.set({RELAYS[Axis.AZIMUTH, direction]: False})
        self.clock.sleep(2.0)


@every_row(
    ("direction", "seconds", "start_s", "stands_deg"),
    [
        (PLUS, 10.0, 0.0, 160.0),  # what it loses while it starts it gives back while it coasts
        (MINUS, 10.0, 0.0, 50.0),  # each way has its own speed
        (PLUS, 10.0, 0.5, 157.0),  # the motor takes half a second to start
        (PLUS, 0.3, 0.5, 100.0),  # and does not start at all within less
        (PLUS, 90.0, 0.0, 360.0),  # at an end stop its own switch ends it
        (MINUS, 90.0, 0.0, 0.0),
    ],
)
def test_a_run_of_that_time_leads_there(
    direction: Direction, seconds: float, start_s: float, stands_deg: float
) -> None:
    motor = TimedMotor(6.0, 5.0, start_s, 0.1, 0.0, 360.0, error_share=0.02, start_error_deg=0.1)
    rig = Rig(motor)
    rig.closed(direction, seconds)
    assert rig.angle.read() == pytest.approx(stands_deg, abs=0.01)
    assert rig.angle.at_rest


def test_it_turns_while_the_relay_is_closed_and_coasts_when_it_has_opened() -> None:
    rig = Rig()
    rig.lines.set({RELAYS[Axis.AZIMUTH, PLUS]: True})
    rig.clock.sleep(1.0)
    assert rig.angle.read() == pytest.approx(100.0 + 6.0 * (1.0 - 0.1), abs=0.01)
    rig.lines.set({RELAYS[Axis.AZIMUTH, PLUS]: False})
    rig.clock.sleep(0.1)
    assert not rig.angle.at_rest
    assert rig.angle.read() == pytest.approx(106.0 - 0.6 * 0.368, abs=0.01)


def test_what_it_may_be_off_by_grows_with_the_way_and_with_each_start_and_is_small_again_at_the_stop() -> None:
    rig = Rig()
    assert rig.angle.error_deg == pytest.approx(1.0)
    rig.closed(PLUS, 10.0)
    rig.angle.read()
    assert rig.angle.error_deg == pytest.approx(1.0 + 0.02 * 60.0 + 0.1, abs=0.01)
    for _ in range(10):
        rig.closed(MINUS, 0.5)
    rig.angle.read()
    assert rig.angle.error_deg == pytest.approx(1.0 + 0.02 * (60.0 + 25.0) + 0.1 * 11, abs=0.01)
    rig.angle.place(0.0)
    assert rig.angle.error_deg == pytest.approx(1.0)
