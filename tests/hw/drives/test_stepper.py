"""Two steppers on simulated chips: a lease that ends, homing, power cuts, an encoder, ENN and its watch."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

import pytest

from firmware_sim.clock import SimClock
from firmware_sim.parts.stepper import StepperMotorSpec
from firmware_sim.rotors.stepper import SimStepperRotor, StepperAxisSpec
from hw.buses.gpio import GpioOutputs
from hw.buses.spi import KernelSpi
from hw.chips.tmc5160 import Model
from hw.drives.stepper import ENABLE, StepperDrive
from hw.drives.stepper_axis import Home, StepperSpec, Trouble
from hw.ports import Axis, HardwareError

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
ENN = 4
SPEC = StepperSpec(
    "azimuth", Model.TMC5160, 54.0, 12.0, 6.0, 1.0, 0.4, 0.075, middle_deg=180.0, span_deg=362.0, home_deg=-2.0
)


class Watch:
    def __init__(self) -> None:
        self.heard = ""

    def renew(self) -> None:
        self.heard += "+"

    def rest(self) -> None:
        self.heard += "-"

    def unbraked(self, lines: Collection[str]) -> None:
        raise AssertionError("steppers have no brake")


class Bench:
    """`start_deg`: where the azimuth really stands. Its stop is at -2°."""

    def __init__(
        self,
        start_deg: float = 90.0,
        kept_deg: float | None = 90.0,
        spec: StepperSpec = SPEC,
        world: SimStepperRotor | None = None,
        clock: SimClock | None = None,
    ) -> None:
        self.clock = clock or SimClock(100.0)
        model = spec.model.key
        motor = StepperMotorSpec(start_deg, spec.gear, low_deg=-2.0, high_deg=362.0, encoder=spec.encoder)
        switch_deg = -1.5 if spec.home is Home.SWITCH else None
        self.world = world or SimStepperRotor(
            StepperAxisSpec(0, model, switch_deg=switch_deg, motor=motor),
            StepperAxisSpec(1, model),
            self.clock,
            enable_pin=ENN,
        )
        self.motor = self.world.azimuth.motor
        gpio = self.world.gpio
        self.lines = GpioOutputs(gpio, gpio.paths()[0], {ENABLE: ENN}, consumer="test", active_low=True)
        self.watch = Watch()
        bus = KernelSpi(self.world.spidev, 0, {"azimuth": 0, "elevation": 1}, mode=3)
        specs = {AZ: spec, EL: replace(spec, select="elevation", home=Home.NONE)}
        self.drive = StepperDrive(bus, specs, self.clock, self.lines, self.watch)
        self.drive.begin(AZ, kept_deg, "" if kept_deg is not None else "not done yet")
        self.drive.begin(EL, 0.0)
        self.clock.add_alarm(self.drive.due_s, self.drive.enforce)

    @property
    def at_deg(self) -> float:
        """Where the azimuth really stands."""
        return self.world.antenna()[0]

    def go(self, angle_deg: float, seconds: float, rate_dps: float = 0.0) -> None:
        """Aim there, twenty times a second, and look as often."""
        began_s = self.clock()
        while self.clock() < began_s + seconds - 1e-6:
            now_s = self.clock()
            self.drive.aim(AZ, angle_deg + rate_dps * (now_s - began_s), rate_dps, now_s + 0.25)
            self.clock.sleep(0.05)
            self.drive.angle_deg(AZ)

    def home(self, seconds: float) -> None:
        end_s = self.clock() + seconds
        while self.drive.lost(AZ) and self.drive.trouble(AZ) is None and self.clock() < end_s:
            self.drive.seek(AZ, self.clock() + 0.25)
            self.clock.sleep(0.05)
            self.drive.angle_deg(AZ)


@pytest.mark.parametrize("driven_s", [0.05, 0.4, 1.0, 4.0])
def test_a_program_that_dies_leaves_no_motor_running(driven_s: float) -> None:
    """Without a guard: the chip itself has no further target than it reaches in its last command, and needs to stop."""
    bench = Bench()
    bench.go(360.0, driven_s)
    at_deg, now_dps = bench.at_deg, min(6.0 * driven_s, 12.0)
    then_dps = min(now_dps + 6.0 * 0.25, 12.0)
    bench.clock._alarms.clear()
    bench.clock.sleep(30.0)
    assert 0.0 < bench.at_deg - at_deg <= (now_dps + then_dps) / 2.0 * 0.25 + then_dps**2 / 12.0 + 0.1


def test_renewed_orders_gather_the_whole_speed_and_turn_back() -> None:
    bench = Bench()
    bench.go(360.0, 2.0)
    at_deg = bench.at_deg
    bench.go(360.0, 1.0)
    assert bench.at_deg - at_deg == pytest.approx(12.0, abs=0.2)
    bench.go(30.0, 3.0)
    at_deg = bench.at_deg
    bench.go(30.0, 1.0)
    assert bench.at_deg - at_deg < -6.0


def test_an_expired_order_brakes_and_the_watch_hears_of_it() -> None:
    bench = Bench()
    bench.go(360.0, 4.0)
    assert bench.watch.heard.endswith("+")
    bench.clock.sleep(2.5)
    assert bench.watch.heard.endswith("-")
    stood_deg = bench.at_deg
    bench.clock.sleep(2.0)
    assert bench.at_deg == stood_deg
    assert bench.world.azimuth.chip.feeds, "it holds"


@pytest.mark.parametrize("model", Model)
@pytest.mark.parametrize("home", [Home.STALL, Home.SWITCH])
@pytest.mark.parametrize("gear", [54.0, -54.0])
def test_homing(model: Model, home: Home, gear: float) -> None:
    end_deg = -1.5 if home is Home.SWITCH else -2.0
    bench = Bench(30.0, None, replace(SPEC, model=model, home=home, gear=gear, home_deg=end_deg))
    with pytest.raises(HardwareError, match="does not answer"):
        bench.drive._axes[AZ].angle_deg  # noqa: B018 - before the first look there is none
    bench.drive.angle_deg(AZ)
    assert bench.drive.lost(AZ) == "not done yet"
    bench.home(60.0)
    assert (bench.drive.lost(AZ), bench.drive.trouble(AZ)) == ("", None)
    # A turn of the field is 0.13°, and at its speed it runs 0.2° from one look at the switch to the next.
    assert bench.drive.angle_deg(AZ) == pytest.approx(bench.at_deg, abs=0.15)
    bench.go(45.0, 10.0)
    assert bench.at_deg == pytest.approx(45.0, abs=0.15)


def test_a_branch_is_not_taken_for_the_end() -> None:
    bench = Bench(40.0, None, replace(SPEC, home=Home.STALL))
    bench.drive.angle_deg(AZ)
    for _ in range(40):
        bench.drive.seek(AZ, bench.clock() + 0.25)
        bench.clock.sleep(0.05)
    bench.motor.held = True
    for _ in range(10):
        bench.drive.seek(AZ, bench.clock() + 0.25)
        bench.clock.sleep(0.05)
    bench.motor.held = False
    bench.home(60.0)
    trouble = bench.drive.trouble(AZ)
    assert trouble is not None
    assert trouble[0] is Trouble.HOMING
    assert "stopped at two places" in trouble[1]
    assert bench.drive.lost(AZ)


def test_homing_that_begins_at_the_open_switch() -> None:
    bench = Bench(-1.8, None, replace(SPEC, home=Home.SWITCH, home_deg=-1.5))
    bench.home(60.0)
    assert (bench.drive.lost(AZ), bench.drive.trouble(AZ)) == ("", None)
    assert bench.drive.angle_deg(AZ) == pytest.approx(bench.at_deg, abs=0.15)


def test_a_broken_wire_of_the_switch() -> None:
    bench = Bench(30.0, None, replace(SPEC, home=Home.SWITCH))
    bench.world.inject("azimuth-switch-broken")
    bench.home(60.0)
    trouble = bench.drive.trouble(AZ)
    assert trouble is not None
    assert trouble[1].startswith("its end still shows 5° above it")


def test_a_switch_that_never_opens() -> None:
    bench = Bench(30.0, None, replace(SPEC, home=Home.SWITCH, span_deg=20.0))
    bench.world.azimuth._switch_deg = None
    bench.home(30.0)
    trouble = bench.drive.trouble(AZ)
    assert trouble is not None
    assert "no end came" in trouble[1]


def restarted(bench: Bench, kept_deg: float | None, spec: StepperSpec = SPEC) -> Bench:
    bench.lines.close()
    return Bench(kept_deg=kept_deg, spec=spec, world=bench.world, clock=bench.clock)


def test_a_new_program_goes_on_with_the_count_of_its_chip() -> None:
    bench = Bench()
    bench.go(120.0, 6.0)
    again = restarted(bench, 90.0)
    assert again.drive.angle_deg(AZ) == pytest.approx(120.0, abs=0.001)
    assert again.drive.lost(AZ) == ""


@pytest.mark.parametrize("angle_deg", [100.03, 117.77, 121.31])
def test_after_a_power_cut_the_kept_place_is_right_to_the_microstep(angle_deg: float) -> None:
    bench = Bench(30.0, None, replace(SPEC, home=Home.STALL))
    bench.home(60.0)
    bench.go(angle_deg, 15.0)
    kept_deg = bench.drive.angle_deg(AZ)
    stood_deg = bench.at_deg
    bench.world.inject("azimuth-chip-dips")
    again = restarted(bench, round(kept_deg, 3))
    again.drive.angle_deg(AZ)
    again.go(angle_deg, 2.0)
    assert again.at_deg == pytest.approx(stood_deg, abs=0.001)


def test_a_power_cut_without_a_gear_that_holds() -> None:
    bench = Bench(spec=replace(SPEC, self_locking=False))
    bench.drive.angle_deg(AZ)
    assert "its gear does not hold" in bench.drive.lost(AZ)


def test_an_encoder_sees_lost_steps_and_still_knows_the_place() -> None:
    bench = Bench(spec=replace(SPEC, encoder=4000))
    bench.go(100.0, 4.0)
    bench.motor.held = True
    with pytest.raises(HardwareError, match="between motor and encoder"):
        bench.go(140.0, 4.0)
    trouble = bench.drive.trouble(AZ)
    assert trouble is not None
    assert trouble[0] is Trouble.STEPS_LOST
    assert bench.drive.lost(AZ) == ""
    bench.motor.held = False
    bench.clock.sleep(2.0)
    bench.drive.acknowledge(AZ)
    bench.go(140.0, 8.0)
    assert bench.at_deg == pytest.approx(140.0, abs=0.15)


def test_to_let_go_takes_the_current_and_the_next_order_gives_it_back() -> None:
    bench = Bench()
    bench.go(95.0, 3.0)
    bench.drive.release()
    assert bench.world.gpio.level(ENN)
    assert not bench.world.azimuth.chip.feeds
    bench.go(100.0, 3.0)
    assert bench.at_deg == pytest.approx(100.0, abs=0.001)
