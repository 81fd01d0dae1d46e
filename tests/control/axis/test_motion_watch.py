"""Whether an axis does what its relays tell it: readings and relays by hand, at 20 Hz, with and without noise."""

from __future__ import annotations

import random

import pytest

from hw.ports import Axis, Direction
from rotator.control.axis.motion_watch import MotionWatch
from rotator.control.sky.mount import Range
from rotator.exchange.faults import Fault
from rotator.exchange.motor import ALL_OPEN, Motor
from tests.control.axis.switch import Switch
from tests.search import examples

MINUS, OFF, PLUS = Direction
STEP_S = 0.05
NOISES_DEG = pytest.mark.parametrize("noise_deg", [0.0, 0.1, 0.4])
SPEEDS_DPS = pytest.mark.parametrize("speed_dps", [0.5, 2.7, 6.0, 60.0])
BOTH_WAYS = pytest.mark.parametrize("way", [PLUS, MINUS], ids=["plus", "minus"])


class Bench:
    """A watched azimuth axis. It really turns at the speed that the test sets."""

    def __init__(
        self, speed_dps: float = 6.0, noise_deg: float = 0.1, *, master: bool = False, at_deg: float = 200.0
    ) -> None:
        motor = Motor(speed_dps, speed_dps * 0.15)
        motors = {PLUS: motor, MINUS: motor}
        self.watch = MotionWatch(
            Axis.AZIMUTH, Range(0.0, 450.0), motors, master=master, trusts=ALL_OPEN, placed=True, look=False
        )
        self._switch = Switch(self.watch.note_relays)
        self.speed_dps = speed_dps
        self.now_s = 1000.0
        self.angle_deg = at_deg
        self._noise_deg = noise_deg
        self._chance = random.Random(7)
        self.pass_by(2.0)

    def read(self, off_deg: float = 0.0) -> Fault | None:
        self.now_s += STEP_S
        return self.watch.see(self.now_s, self.angle_deg + off_deg + self._chance.gauss(0.0, self._noise_deg))

    def pass_by(self, seconds: float, dps: float = 0.0) -> Fault | None:
        """Turn that fast for so long, or until there is a fault."""
        for _ in range(round(seconds / STEP_S)):
            self.angle_deg += dps * STEP_S
            fault = self.read()
            if fault is not None:
                return fault
        return None

    def time_to_fault(self, seconds: float, dps: float = 0.0) -> tuple[str, float]:
        began_s = self.now_s
        fault = self.pass_by(seconds, dps)
        return (fault.name if fault else "", self.now_s - began_s)

    def drive(self, way: Direction) -> None:
        self._switch.to(self.now_s, way)

    def run(self, way: Direction, seconds: float) -> Fault | None:
        """Drive it, and let it turn as it should."""
        self.drive(way)
        return self.pass_by(seconds, way * self.speed_dps)

    def end_run(self) -> Fault | None:
        self.drive(OFF)
        return self.pass_by(0.15, 0.0)


# --- nothing is wrong


@NOISES_DEG
@SPEEDS_DPS
def test_runs_and_rests_are_no_fault(speed_dps: float, noise_deg: float) -> None:
    bench = Bench(speed_dps, noise_deg)
    for way in (PLUS, PLUS, MINUS, PLUS, MINUS, MINUS):
        assert bench.run(way, min(10.0, 100.0 / speed_dps)) is None
        assert bench.end_run() is None
        assert bench.pass_by(3.0) is None
        assert bench.watch.notices == ()


@SPEEDS_DPS
def test_a_motor_said_to_be_faster_or_slower_than_it_is_may_run(speed_dps: float) -> None:
    bench = Bench(6.0)
    for way in (PLUS, MINUS):
        bench.drive(way)
        assert bench.pass_by(min(60.0, 100.0 / speed_dps), way * speed_dps) is None
        assert bench.end_run() is None


@pytest.mark.search
@NOISES_DEG
def test_hours_of_standing_are_quiet(noise_deg: float) -> None:
    bench = Bench(2.7, noise_deg)
    assert bench.pass_by(float(examples(3600))) is None
    assert bench.watch.notices == ()


@pytest.mark.parametrize("opens_s", [0.0, 0.05, 0.2])
def test_a_stop_and_the_same_order_leave_a_stalled_motor_what_its_first_run_has_shown(opens_s: float) -> None:
    bench = Bench()
    bench.drive(PLUS)
    assert bench.pass_by(1.0) is None
    bench.drive(OFF)
    assert bench.pass_by(opens_s) is None
    bench.drive(PLUS)
    name, after_s = bench.time_to_fault(3.0)
    assert name == "motor runs and pot stands still"
    assert 0.0 < after_s < 1.0


@pytest.mark.parametrize("way", [OFF, PLUS])
def test_one_spark_is_nothing(way: Direction) -> None:
    bench = Bench()
    bench.run(way, 3.0)
    for _ in range(10):
        assert bench.read(off_deg=90.0) is None
        assert bench.pass_by(0.5, way * 6.0) is None
    assert bench.watch.notices == ()


def test_an_axis_that_is_suddenly_elsewhere_is_watched_there() -> None:
    bench = Bench()
    bench.angle_deg = 20.0
    assert bench.pass_by(5.0) is None
    assert bench.watch.notices == ()
    bench.drive(PLUS)
    assert bench.time_to_fault(5.0)[0] == "motor runs and pot stands still"


# --- driven, and it stands


@NOISES_DEG
@SPEEDS_DPS
@BOTH_WAYS
def test_a_motor_that_does_not_start(speed_dps: float, noise_deg: float, way: Direction) -> None:
    bench = Bench(speed_dps, noise_deg)
    bench.drive(way)
    name, after_s = bench.time_to_fault(4.0)
    assert name == "motor runs and pot stands still"
    assert after_s <= (2.0 if noise_deg < 0.4 else 2.4)


@pytest.mark.parametrize(("at_deg", "way"), [(447.0, MINUS), (2.0, PLUS)])
def test_standing_at_its_end_and_driven_inward_it_is_stuck(at_deg: float, way: Direction) -> None:
    bench = Bench(at_deg=at_deg)
    bench.drive(way)
    assert bench.time_to_fault(4.0)[0] == "motor runs and pot stands still"


# --- driven, and it goes elsewhere


def test_a_motor_that_drags_is_on_for_longer_than_the_travel_takes() -> None:
    bench = Bench(at_deg=0.0)
    bench.run(PLUS, 5.0)
    bench.end_run()
    bench.pass_by(2.0)
    bench.drive(PLUS)
    name, after_s = bench.time_to_fault(300.0, 0.4 * 6.0)
    assert name == "motor on longer than the travel takes"
    assert after_s == pytest.approx(1.3 * 450.0 / 6.0 + 5.0, rel=0.1)


# --- not driven, and it turns


def welded(*, master: bool) -> tuple[Bench, Fault]:
    bench = Bench(master=master)
    bench.run(PLUS, 4.0)
    bench.drive(OFF)
    fault = bench.pass_by(5.0, 6.0)
    assert fault is not None
    return bench, fault


def test_while_it_turns_the_fault_comes_straight_back() -> None:
    bench, _ = welded(master=False)
    bench.watch.acknowledge()
    assert bench.time_to_fault(1.0, 6.0) == ("relay welded", pytest.approx(STEP_S))
