"""Two motors behind H-bridges on the simulated slew drive: lines, duty and dead time as an oscilloscope shows them, the
loop, and what the encoder says against the drive.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from contextlib import suppress

import pytest

from firmware_sim.clock import SimClock
from firmware_sim.parts.motor import MotorSpec
from firmware_sim.rotors.h_bridge import BridgeAxisSpec, SimBridgeRotor
from hw.buses.gpio import GpioInputs, GpioOutputs, GpioPair
from hw.buses.pwm import KernelPwm
from hw.drives.bridge import Bridge
from hw.drives.bridge_axis import Amiss, BridgeAxis, BridgeSpec
from hw.drives.bridge_homing import BridgeEnd
from hw.drives.h_bridge import BridgedMotor, BridgeDrive
from hw.ports import Axis, Direction, HardwareError
from hw.sensors.quadrature import QuadratureCounter

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
MOTOR = MotorSpec(3.0, lag_s=0.1, relay_delay_s=0.0, backlash_deg=0.0, stop_low_deg=-10.0, stop_high_deg=370.0)
DEAD_S = 0.2
INDEX_DEG = -1.5
PINS = {"azimuth_plus": 22, "azimuth_minus": 23, "elevation_plus": 24, "elevation_minus": 25, "enable": 4}
WIRES = {AZ: (22, 23, 18, 16, 20), EL: (24, 25, 19, 21, 26)}


class Watch:
    """Writes down what the sentinel would hear."""

    def __init__(self) -> None:
        self.heard = ""

    def renew(self) -> None:
        self.heard += "+" if not self.heard.endswith("+") else ""

    def rest(self) -> None:
        self.heard += "-"

    def unbraked(self, lines: Collection[str]) -> None:
        """There is no brake."""


class Bench:
    """`one_line`: each bridge has one line for the direction. `one_channel`: each encoder has one channel.

    The azimuth has an index at INDEX_DEG.
    """

    def __init__(self, *, one_line: bool = False, one_channel: bool = False, start_deg: float = 90.0) -> None:
        self.clock, self.watch = SimClock(), Watch()
        azimuth, elevation = (
            BridgeAxisSpec(
                plus,
                None if one_line else minus,
                pwm,
                a,
                None if one_channel else b,
                40.0 if one_channel else 20.0,
                MOTOR,
                start_deg,
                index_pin,
                INDEX_DEG,
            )
            for (plus, minus, pwm, a, b), index_pin in zip(WIRES.values(), (6, None), strict=True)
        )
        self.one_channel, self.start_deg = one_channel, start_deg
        self.told_deg: float | None = None
        self.world = SimBridgeRotor(azimuth, elevation, self.clock, enable_pin=4)
        self.lines = GpioOutputs(self.world.gpio, "/dev/gpiochip0", PINS, consumer="test")
        motors = {axis: self._motor(axis, one_line=one_line) for axis in Axis}
        self.drive = BridgeDrive(motors, self.clock, enable=self.lines, watch=self.watch)
        self.clock.add_alarm(self.drive.due_s, self._ring)
        self.both_on = 0
        self.failures: list[str] = []
        self.world.gpio.on_edges.append(self._edges)

    def _motor(self, axis: Axis, *, one_line: bool) -> BridgedMotor:
        _, _, gpio, a, b = WIRES[axis]
        pwm = KernelPwm(self.world.pwm, gpio, 20_000.0, self.clock.sleep)
        name = axis.value
        minus = None if one_line else f"{name}_minus"
        bridge = Bridge(self.lines, pwm, f"{name}_plus", minus, dead_time_s=DEAD_S)
        channels = (a,) if self.one_channel else (a, b)
        pair = GpioPair(self.world.gpio, "/dev/gpiochip0", channels, consumer=name)
        counter = QuadratureCounter(pair, 20.0, self.clock)
        counter.place(self.start_deg)
        counter.fed, counter.way = lambda: (bridge.fed, bridge.off_s), lambda: bridge.last or Direction.PLUS
        end = None
        if axis is AZ:
            inputs = GpioInputs(self.world.gpio, "/dev/gpiochip0", {"index": 6}, consumer="index")

            def place(angle_deg: float) -> None:
                self.told_deg = angle_deg
                counter.place(angle_deg)

            end = BridgeEnd(lambda: inputs.read()["index"], INDEX_DEG, 0.5, 30.0, place)
        return BridgedMotor(BridgeAxis(BridgeSpec(3.0, 3.0, 0.1, 0.05)), bridge, counter, end=end)

    def _ring(self, now_s: float) -> None:
        try:
            self.drive.enforce(now_s)
        except HardwareError as fault:
            self.failures.append(str(fault))

    def _edges(self, _now_s: float, _changes: object) -> None:
        self.both_on += all(self.world.gpio.level(pin) for pin in (22, 23))

    def follow(self, seconds: float, angle_deg: float, rate_dps: float = 0.0) -> None:
        """The control loop's orders, twenty a second, for so long."""
        began_s = self.clock()
        while self.clock() < began_s + seconds - 1e-9:
            with suppress(HardwareError):
                at_deg = angle_deg + rate_dps * (self.clock() - began_s)
                self.drive.aim(AZ, at_deg, rate_dps, self.clock() + 0.25)
            self.clock.sleep(0.05)

    def home(self, seconds: float) -> None:
        """The control loop's orders until its end is found, or a fault."""
        end_s = self.clock() + seconds
        while self.told_deg is None and self.drive.amiss(AZ) is None and self.clock() < end_s:
            self.drive.seek(AZ, self.clock() + 0.25)
            self.clock.sleep(0.05)

    @property
    def shaft_deg(self) -> float:
        return self.world.shafts()[0]

    def is_off(self) -> bool:
        levels = [self.world.gpio.level(pin) for pin in PINS.values()]
        return not any(levels) and all(channel.share == 0.0 for channel in self.world.pwm.channels)


@pytest.fixture
def bench() -> Iterator[Bench]:
    bench = Bench()
    yield bench
    assert bench.both_on == 0
    assert bench.world.shorted_s == 0.0


@pytest.mark.parametrize("one_line", [False, True])
@pytest.mark.parametrize("to_deg", [120.0, 60.0, 90.2])
def test_it_comes_to_its_place_without_passing_it_and_is_off_there(to_deg: float, one_line: bool) -> None:
    bench = Bench(one_line=one_line)
    furthest_deg = 0.0

    def look(_now_s: float) -> None:
        nonlocal furthest_deg
        furthest_deg = max(furthest_deg, (bench.shaft_deg - to_deg) * (1 if to_deg > 90 else -1))

    bench.clock.every(0.01, look)
    bench.follow(16.0, to_deg)
    assert bench.shaft_deg == pytest.approx(to_deg, abs=0.1)
    assert furthest_deg < 0.15
    assert bench.world.pwm.channels[0].share == 0.0, "no duty is left on at the place"
    assert not any(bench.world.gpio.level(pin) for pin in (22, 23))
    bench.clock.sleep(1.0)
    assert bench.is_off()


def test_a_target_that_moves_is_followed_within_two_counts(bench: Bench) -> None:
    bench.follow(4.0, 90.0, 1.0)
    worst_deg = 0.0
    for step in range(100):
        bench.follow(0.1, 94.0 + 0.1 * step, 1.0)
        worst_deg = max(worst_deg, abs(bench.shaft_deg - (94.0 + 0.1 * (step + 1))))
    assert worst_deg < 0.1


def test_the_moon_is_followed_in_steps_and_not_by_a_motor_that_hums(bench: Bench) -> None:
    fed = 0
    for step in range(600):
        bench.follow(0.1, 90.0 + 0.0004 * step, 0.004)
        fed += bench.world.pwm.channels[0].share > 0.0
    assert bench.shaft_deg == pytest.approx(90.24, abs=0.1)
    assert 0 < fed < 60


def test_it_gathers_speed_and_brakes_as_the_file_says(bench: Bench) -> None:
    bench.follow(0.5, 120.0)
    assert bench.world.azimuth.motor.speed_dps == pytest.approx(1.5, abs=0.4)
    bench.follow(1.5, 120.0)
    assert bench.world.azimuth.motor.speed_dps == pytest.approx(3.0, abs=0.1)
    from_deg = bench.shaft_deg
    bench.drive.hold(AZ)
    bench.clock.sleep(2.0)
    assert bench.shaft_deg - from_deg == pytest.approx(1.5 + 0.3, abs=0.2)
    assert bench.is_off()


def test_a_reversal_waits_out_its_dead_time(bench: Bench) -> None:
    seen: dict[bool, float] = {}
    switched = {(22, False), (23, True)}
    bench.follow(2.0, 100.0)
    bench.world.gpio.on_edges.append(
        lambda now_s, changes: seen.update({level: now_s for pin, level in changes.items() if (pin, level) in switched})
    )
    bench.follow(3.0, 80.0)
    assert seen[True] - seen[False] >= DEAD_S
    assert bench.world.azimuth.motor.drive == -1


def test_off_is_duty_0_and_every_line_off_at_once_and_the_watch_is_told(bench: Bench) -> None:
    bench.follow(2.0, 300.0)
    assert bench.watch.heard == "+"
    bench.drive.off()
    assert bench.is_off()
    assert bench.watch.heard == "+-"
    bench.follow(5.0, 94.0)
    assert bench.shaft_deg == pytest.approx(94.0, abs=0.1)


def test_a_cut_holds_the_enable_line_off_until_it_is_restored(bench: Bench) -> None:
    bench.follow(1.0, 300.0)
    assert bench.drive.cut()
    from_deg = bench.shaft_deg
    bench.follow(3.0, 300.0)
    assert bench.is_off()
    assert bench.shaft_deg - from_deg < 0.5
    bench.drive.restore()
    bench.follow(3.0, 300.0)
    assert bench.shaft_deg - from_deg > 3.0


def test_a_failed_transistor_that_turns_a_motor_whose_lines_are_off_is_seen_within_two_seconds() -> None:
    bench = Bench()
    bench.clock.sleep(3.0)
    bench.world.azimuth.motor.pushed = 1.0  # past the enable too
    bench.clock.sleep(2.0)
    found = bench.drive.amiss(AZ)
    assert found is not None
    assert found[0] is Amiss.TURNING


def test_a_start_that_has_to_wait_begins_nothing(bench: Bench) -> None:
    """As while the card has not taken the mark that the axis moves."""
    waiting = Bench()
    waiting.drive._motors[AZ].start = lambda feed: Direction.OFF
    waiting.follow(3.0, 120.0)
    assert waiting.shaft_deg == 90.0
    assert waiting.drive.amiss(AZ) is None


def test_where_is_nowhere_is_refused(bench: Bench) -> None:
    with pytest.raises(HardwareError, match="nowhere to aim at"):
        bench.drive.aim(AZ, float("nan"), 0.0, bench.clock() + 0.25)


@pytest.mark.parametrize("one_channel", [False, True])
@pytest.mark.parametrize("start_deg", [4.03, -2.2, INDEX_DEG])
def test_it_finds_its_index_from_above_and_from_it(start_deg: float, one_channel: bool) -> None:
    bench = Bench(start_deg=start_deg, one_channel=one_channel)
    bench.home(80.0)
    assert bench.drive.amiss(AZ) is None
    assert bench.told_deg is not None
    # A count of its encoder, and a round of the loop at 0.5°/s; the way that it coasts is counted.
    assert bench.told_deg == pytest.approx(bench.shaft_deg, abs=0.07)
    bench.drive.seek(AZ, bench.clock() + 0.25)
    bench.clock.sleep(2.0)
    assert bench.is_off(), "an order that comes late begins nothing anew"
    bench.follow(6.0, 3.0)
    assert bench.shaft_deg == pytest.approx(3.0, abs=0.15)


def test_a_homing_that_nobody_renews_ends_and_begins_anew(bench: Bench) -> None:
    bench.home(2.0)
    bench.clock.sleep(1.0)
    assert bench.is_off()
    from_deg = bench.shaft_deg
    bench.home(2.0)
    assert bench.shaft_deg < from_deg - 0.5
    bench.drive.off()
    assert bench.is_off()


@pytest.mark.parametrize(
    ("fault", "start_deg", "says"),
    [
        ("azimuth-index-dead", 40.0, "no end came in 40°"),
        ("azimuth-index-stuck", 20.0, "its end still shows 5° above it"),
    ],
)
def test_an_index_that_does_not_work_ends_the_homing(fault: str, start_deg: float, says: str) -> None:
    bench = Bench(start_deg=start_deg)
    bench.world.inject(fault)
    bench.home(120.0)
    found = bench.drive.amiss(AZ)
    assert found is not None
    assert found[0] is Amiss.HOMING
    assert found[1].startswith(says)
    bench.clock.sleep(0.5)
    assert bench.is_off()


def test_a_spark_on_the_wire_of_the_index_is_not_taken_for_it() -> None:
    bench = Bench(start_deg=20.0)
    bench.home(4.0)
    bench.world.inject("azimuth-index-stuck")
    bench.home(0.1)
    bench.world.clear("azimuth-index-stuck")
    bench.home(90.0)
    found = bench.drive.amiss(AZ)
    assert found is not None
    assert "stopped at two places" in found[1]


def test_one_channel_counts_the_way_that_its_motor_is_driven() -> None:
    bench = Bench(one_channel=True)
    for to_deg in (96.0, 88.0, 91.5):
        bench.follow(6.0, to_deg)
        assert bench.shaft_deg == pytest.approx(to_deg, abs=0.12)
    bench.world.inject("azimuth-motor-stalled")
    bench.follow(1.5, 120.0)
    assert bench.drive.amiss(AZ) is not None
