"""The figures of the wiring pages, reckoned once more from the data sheets, and found on the pages."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from docs.drawings.album import profile
from docs.drawings.figures import (
    ADC_LIMIT_V,
    BASE_OHM,
    BUS_FARAD,
    DIVIDER_LOWER_OHM,
    DIVIDER_UPPER_OHM,
    LAMP_OHM,
    METER_FULL_A,
    METER_SERIES_OHM,
    METER_TRIMMER_OHM,
    PI_SUPPLY_V,
    POT_END_OHM,
    POT_OHM,
    SWITCH_PULL_OHM,
    ContactLoop,
    OneShot,
    braked_v,
    divided_v,
)

DOCS = Path(__file__).parents[2] / "docs"
EDGE_EVERY_S = 0.1
"""The control loop changes the line's level 20 times a second at least: ten rising edges."""


def ends(pot_ohm: float, end_ohm: float) -> tuple[float, float]:
    """What a pot with a resistor at each end reads at its two ends, as shares of the supply."""
    whole_ohm = pot_ohm + 2 * end_ohm
    return end_ohm / whole_ohm, (pot_ohm + end_ohm) / whole_ohm


def page(name: str) -> str:
    return " ".join((DOCS / name).read_text(encoding="utf-8").split())


def test_the_one_shot_lasts_half_a_second() -> None:
    shot = OneShot()
    assert shot.pulse_s == pytest.approx(0.7 * 330e3 * 2.2e-6) == pytest.approx(0.508, abs=0.001)
    assert (shot.shortest_s, shot.longest_s) == (pytest.approx(0.41, abs=0.005), pytest.approx(0.62, abs=0.005))


def test_it_does_not_drop_out_between_two_beats_and_not_for_three_missed_ones() -> None:
    assert OneShot().shortest_s > 4 * EDGE_EVERY_S


def test_the_page_says_what_the_one_shot_does() -> None:
    text = page("heartbeat.md")
    assert "0.7 × 330 kΩ × 2.2 µF = 0.51 s" in text
    assert "0.41 s" in text
    assert "0.62 s" in text


def test_the_transistor_is_driven_far_into_saturation() -> None:
    """At 4 mA the output still gives 3.84 V (SCHS123); the base takes 0.8 V of them, the coil 80 mA."""
    base_a = (3.84 - 0.8) / BASE_OHM
    assert base_a < 0.004
    assert 0.080 / base_a < 30
    assert "3 mA into the base, 80 mA through the coil" in page("heartbeat.md")


@pytest.mark.parametrize(
    ("socket_v", "adc_v"),
    [(0.20, 0.128), (2.20, 1.410), (4.20, 2.692), (4.50, 2.885), (5.00, 3.205)],
)
def test_the_divider_gives_what_the_profile_and_the_pages_say(socket_v: float, adc_v: float) -> None:
    assert divided_v(socket_v) == pytest.approx(adc_v, abs=0.0006)
    assert divided_v(socket_v) < ADC_LIMIT_V
    assert f"{adc_v:.3f}" in page("paths/g5500.md")


def test_the_g5500s_supply_is_five_volts_behind_the_divider() -> None:
    assert (DIVIDER_UPPER_OHM, DIVIDER_LOWER_OHM) == (56_000, 100_000)
    assert profile("g5500").adc.supply_v == pytest.approx(divided_v(5.0), abs=0.001)


def test_the_f1efws_pots_read_what_its_profile_says() -> None:
    low, high = ends(POT_OHM, POT_END_OHM)
    box = profile("f1efw")
    for table in (box.azimuth, box.elevation):
        assert table.calibration is not None
        assert (table.calibration[0][0], table.calibration[-1][0]) == (
            pytest.approx(low, abs=0.001),
            pytest.approx(high, abs=0.001),
        )


@pytest.mark.parametrize(("pot_ohm", "end_ohm"), [(500, 33), (1000, 68), (5000, 330), (10_000, 680)])
def test_the_end_resistors_of_the_table_keep_the_wiper_off_the_rails(pot_ohm: float, end_ohm: float) -> None:
    low, high = ends(pot_ohm, end_ohm)
    assert low > 0.05
    assert high < 0.95
    assert f"{low:.3f} to {high:.3f}" in page("wiring.md")


def test_an_ssr_behind_the_uln2803_sees_enough() -> None:
    """A CX240D5 closes from 3.0 V on and takes 15 mA, at which a ULN2803 keeps about 1 V for itself."""
    assert 5.0 - 1.0 > 3.0
    assert "which leaves it about 4 V" in page("ssr.md")


def test_what_a_snubber_lets_through() -> None:
    assert 24 * 2 * math.pi * 50 * 100e-9 == pytest.approx(0.75e-3, abs=0.01e-3)
    assert "0.75 mA" in page("ssr.md")


@pytest.mark.parametrize(("motor_a", "fuse_a"), [(1.0, 2.0), (2.0, 4.0)])
def test_the_fuse_is_the_next_standard_size_above_both_motors(motor_a: float, fuse_a: float) -> None:
    sizes_a = (0.5, 0.63, 0.8, 1.0, 1.25, 1.6, 2.0, 2.5, 3.15, 4.0, 5.0, 6.3)
    assert next(size_a for size_a in sizes_a if size_a >= 2 * motor_a) == fuse_a
    assert f"of {motor_a:g} A, {fuse_a:g} A" in page("wiring.md")


def test_a_contacts_loop_lights_its_opto_well_and_burns_no_resistor() -> None:
    loop, page_ = ContactLoop(), page("paths/u100.md")
    assert loop.supply_v == pytest.approx(24 * math.sqrt(2) - 0.7) == pytest.approx(33.2, abs=0.1)
    assert loop.led_a == pytest.approx(0.010, abs=0.0005)
    assert loop.resistor_w == pytest.approx(0.31, abs=0.01)
    assert loop.ripple_v < 0.15 * loop.supply_v
    assert "3.3 kΩ, 1 W | 10 mA through the opto" in page_
    assert "33 V DC of the 24 V AC" in page_


def test_the_loops_parts_bear_a_transformer_without_load() -> None:
    """A small transformer gives up to a fifth more than is written on it, and the mains a tenth more."""
    loop = ContactLoop(transformer_v=24 * 1.2 * 1.1)
    assert loop.supply_v < 63
    assert loop.resistor_w < 1
    assert loop.led_a < 0.050


def test_oe_is_held_high_against_the_boards_own_resistor() -> None:
    """A PCA9685 takes 0.7 of its supply for high (NXP, table 13)."""
    high_v = PI_SUPPLY_V * 10_000 / (10_000 + SWITCH_PULL_OHM)
    assert high_v > 0.7 * PI_SUPPLY_V + 0.5
    assert PI_SUPPLY_V / SWITCH_PULL_OHM < 0.008


def test_what_braking_does_to_the_capacitor() -> None:
    page_ = page("paths/isel.md")
    assert 0.5 * math.radians(30) ** 2 == pytest.approx(0.14, abs=0.005)
    for speed_dps, volts in ((30, 25.2), (90, 33), (300, 80)):
        assert braked_v(24, 1.0, speed_dps, BUS_FARAD) == pytest.approx(volts, rel=0.01)
        assert f"{volts} V" in page_


def test_a_meters_trimmer_reaches_full_scale_from_both_sides() -> None:
    least_ohm = PI_SUPPLY_V / METER_FULL_A - 200
    assert least_ohm > METER_SERIES_OHM
    assert METER_SERIES_OHM + METER_TRIMMER_OHM > PI_SUPPLY_V / METER_FULL_A
    assert "3.3 V ÷ 3.3 kΩ is full scale" in page("panel.md")


def test_a_lamp_takes_what_an_output_gives() -> None:
    """A PCA9685 gives 10 mA at high; a red LED takes 2 V of the 3.3."""
    lamp_a = (PI_SUPPLY_V - 2.0) / LAMP_OHM
    assert lamp_a == pytest.approx(0.004, abs=0.0005)
    assert "330 Ω each, 4 mA" in page("panel.md")


def test_a_step_of_the_servos_chip() -> None:
    tick_us = 1e6 / 25e6 * 122
    low_us, high_us = (us for _, us in profile("servos").servo.azimuth.pulses_us)
    assert tick_us == pytest.approx(4.88)
    assert 180 / (high_us - low_us) * tick_us == pytest.approx(0.49, abs=0.01)
    assert "600 to 2400 µs; a step of the chip is then half a degree" in page("paths/servos.md")


def test_a_step_of_the_digital_pot() -> None:
    points = profile("orbit360").digipot
    (low_deg, low), (high_deg, high) = points.azimuth.steps
    assert (high_deg - low_deg) / (high - low) == pytest.approx(1.41, abs=0.005)
    (low_deg, low), (high_deg, high) = points.elevation.steps
    assert (high_deg - low_deg) / (high - low) == pytest.approx(1.41, abs=0.005)
    assert "1.41° each" in page("paths/orbit360.md")


def test_an_upside_down_elevation_shows_what_the_moteus_page_says() -> None:
    elevation = profile("isel").moteus.elevation
    shown = [elevation.zero_rev + degrees / 360 * elevation.rev_per_turn for degrees in (0, 90)]
    assert shown == [-0.25, -0.5]
    assert "0° is -0.25 turns, 90° is -0.5" in page("paths/isel.md")


def test_three_periods_of_a_u_100() -> None:
    box = profile("u100")
    assert 3 * box.pulses.azimuth.spacing_deg / box.azimuth.speed_dps == 2.5
    assert "2.5 s at 5° and 6°/s" in page("paths/u100.md")
