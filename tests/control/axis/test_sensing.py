"""Whether a sensor can be believed: the window, how long a bad reading may last, silence, staleness."""

from __future__ import annotations

import math

import pytest

from hw.ports import Axis
from rotator.control.axis.calibration_table import Calibration
from rotator.control.axis.readings import ANYTHING, Reading, Window
from rotator.control.axis.sensing import BAD_FOR_S, JUMPED, JUMPED_SHOWN_S, STALE_S, Sensing
from rotator.exchange.faults import Fault, FaultKind

HALF_CIRCLE = Calibration(((0.05, 0.0), (0.95, 180.0)))
STEP_S = 0.05
BAD = [0.0, 0.019, 0.981, 1.0, -0.001, 1.2, math.nan, math.inf, None]


class Bench:
    """An elevation pot looked at twenty times a second."""

    def __init__(self, calibration: Calibration | None = HALF_CIRCLE) -> None:
        self.sensing = Sensing(Axis.ELEVATION, Window(0.02, 0.98), calibration)
        self.now_s = 5000.0

    def read(self, raw: float | None, problem: str = "") -> Fault | None:
        self.now_s += STEP_S
        return self.sensing.take(Reading(self.now_s, raw, problem), self.now_s)

    def read_for(self, seconds: float, raw: float | None) -> list[Fault | None]:
        return [self.read(raw) for _ in range(round(seconds / STEP_S))]


@pytest.fixture
def bench() -> Bench:
    return Bench()


def test_before_the_first_reading_nothing_is_believed(bench: Bench) -> None:
    assert not bench.sensing.believable
    assert bench.sensing.angle_deg is None
    assert bench.sensing.places == ()


@pytest.mark.parametrize(("raw", "angle_deg"), [(0.02, -6.0), (0.05, 0.0), (0.5, 90.0), (0.95, 180.0), (0.98, 186.0)])
def test_a_reading_within_the_window_is_an_angle(bench: Bench, raw: float, angle_deg: float) -> None:
    assert bench.read(raw) is None
    assert bench.sensing.believable
    assert bench.sensing.angle_deg == pytest.approx(angle_deg)


def test_without_a_calibration_there_is_a_reading_but_no_angle() -> None:
    bench = Bench(None)
    assert bench.read(0.5) is None
    assert (bench.sensing.raw, bench.sensing.angle_deg, bench.sensing.believable) == (0.5, None, True)


@pytest.mark.parametrize("raw", BAD)
def test_the_very_first_bad_reading_is_not_believed(bench: Bench, raw: float | None) -> None:
    bench.read(0.5)
    assert bench.read(raw) is None, "one bad reading is no fault yet"
    assert not bench.sensing.believable
    assert bench.sensing.angle_deg == pytest.approx(90.0), "the last good angle is kept"


@pytest.mark.parametrize("raw", BAD)
def test_bad_readings_that_last_are_a_fault_at_the_third_or_fourth(bench: Bench, raw: float | None) -> None:
    bench.read(0.5)
    faults = bench.read_for(4 * STEP_S, raw)
    assert faults[:2] == [None, None]
    assert faults[3] is not None


@pytest.mark.parametrize("raw", BAD)
def test_a_sensor_bad_from_the_start_is_a_fault_as_soon(bench: Bench, raw: float | None) -> None:
    assert bench.read_for(4 * STEP_S, raw)[3] is not None


def test_a_good_reading_ends_the_fault(bench: Bench) -> None:
    bench.read(0.5)
    bench.read_for(1.0, 1.0)
    assert bench.read(0.6) is None
    assert bench.sensing.angle_deg == pytest.approx(110.0)


def test_the_same_reading_again_grows_old(bench: Bench) -> None:
    bench.read(0.5)
    old, read_s = Reading(bench.now_s, 0.5), bench.now_s
    assert bench.sensing.take(old, read_s + STALE_S - 0.01) is None
    assert bench.sensing.believable
    bench.sensing.take(old, read_s + STALE_S + 0.01)
    assert not bench.sensing.believable
    fault = bench.sensing.take(old, read_s + STALE_S + 0.01 + BAD_FOR_S + 0.01)
    assert fault is not None
    assert (fault.name, fault.limit) == ("sensor late", f"{STALE_S:g} s")


# --- a fault names the axis, what was measured, the limit, and the page that explains it


def test_a_broken_pot_explains_itself(bench: Bench) -> None:
    fault = bench.read_for(0.5, 0.004)[-1]
    assert fault == Fault(FaultKind.POT_OPEN, Axis.ELEVATION, "reads 0.004", "0.02 to 0.98")
    assert str(fault) == (
        "elevation: pot open or shorted: reads 0.004, limit 0.02 to 0.98. Check the pot's wires and its supply"
        " (rotator help pot-open-or-shorted)"
    )
    assert bench.sensing.raw == 0.004, "the raw value is shown, for a person who looks for the break"


def test_a_silent_sensor_says_why(bench: Bench) -> None:
    for _ in range(10):
        fault = bench.read(None, "I2C bus 1: the device does not answer (address 0x48)")
    assert fault is not None
    assert (fault.name, fault.measured) == ("sensor silent", "I2C bus 1: the device does not answer (address 0x48)")


# --- a pot's wires


@pytest.mark.parametrize(
    ("window", "blind"),
    [
        (Window(0.02, 0.98), False),
        (Window(0.0, 0.98), True),
        (Window(0.02, 1.0), True),
        (Window(-0.01, 1.01), True),
        # A magnet over its chip: all the way round, and a broken wire is silence.
        (Window(-0.01, 1.01, pot=False), False),
        (Window(0.0, 1.0, pot=False), False),
        (ANYTHING, False),
    ],
)
def test_only_a_pot_can_be_blind_to_its_wires(window: Window, blind: bool) -> None:
    assert window.blind is blind


def test_an_axis_that_reads_elsewhere_all_at_once_is_believed_and_it_is_said() -> None:
    """As with the ends of a pot swapped at rest: no motor has turned it there."""
    bench = Bench()
    bench.sensing = Sensing(Axis.ELEVATION, Window(0.02, 0.98), HALF_CIRCLE, fastest_dps=3.0)
    bench.read_for(1.0, 0.2)
    assert bench.sensing.notice is None
    bench.read_for(0.2, 0.8)
    assert bench.sensing.angle_deg == pytest.approx(150.0)
    assert bench.sensing.notice == JUMPED
    bench.read_for(JUMPED_SHOWN_S, 0.8)
    assert bench.sensing.notice is None


# --- a loose wire: out, back, and out again


def read_angles(bench: Bench, *angles_deg: float) -> list[Fault | None]:
    return [bench.read(0.05 + angle_deg / 200.0) for angle_deg in angles_deg]


@pytest.mark.parametrize("out_deg", [40.0, -40.0, 5.1])
def test_out_back_and_out_again_is_a_loose_wire(bench: Bench, out_deg: float) -> None:
    *before, fault = read_angles(bench, 90.0, 90.0, 90.0 + out_deg, 90.0, 90.0 + out_deg)
    assert before == [None] * 4, "out and back may be a spark"
    assert fault is not None
    assert fault.kind is FaultKind.POT_JUMPS
    assert fault.measured == f"by {abs(out_deg):.0f}°, 3 times in 0.3 s"
    assert fault.limit == "5° from one reading to the next"


def test_the_fault_ends_when_the_readings_stay_for_a_while(bench: Bench) -> None:
    assert read_angles(bench, 90.0, 130.0, 90.0, 130.0)[-1] is not None
    again = bench.sensing.take(Reading(bench.now_s, 0.7), bench.now_s)
    assert again is not None, "no new reading has come"
    assert read_angles(bench, *[130.0] * 8)[-1] is None


@pytest.mark.parametrize(
    "angles_deg",
    [
        (90.0, 94.9, 90.0, 94.9, 90.0),
        (90.0, 100.0, 110.0, 120.0, 130.0),
        (130.0, 120.0, 110.0, 100.0, 90.0),
        (90.0, 130.0, 90.0, 90.0, 90.0, 90.0, 90.0, 130.0, 90.0, 90.0),
        (90.0, 130.0, 130.0, 130.0, 90.0, 90.0, 90.0, 130.0, 130.0, 130.0),
    ],
    ids=["within 5 degrees", "one way", "the other way", "two sparks", "to and fro, slowly"],
)
def test_what_is_no_loose_wire(bench: Bench, angles_deg: tuple[float, ...]) -> None:
    assert read_angles(bench, *angles_deg) == [None] * len(angles_deg)


def test_after_a_gap_a_reading_elsewhere_is_no_jump(bench: Bench) -> None:
    found = []
    for angle_deg in (90.0, 130.0) * 5:
        found += read_angles(bench, angle_deg)
        bench.now_s += 0.3
    assert found == [None] * 10
