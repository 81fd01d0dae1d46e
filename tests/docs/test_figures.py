"""The figures of the wiring pages, reckoned once more from the data sheets, and found on the pages."""

from __future__ import annotations

from pathlib import Path

import pytest

from docs.drawings.album import profile
from docs.drawings.figures import (
    ADC_LIMIT_V,
    POT_END_OHM,
    POT_OHM,
    OneShot,
    divided_v,
)
from tests.tables import every_row

DOCS = Path(__file__).parents[2] / "docs"


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


def test_the_page_says_what_the_one_shot_does() -> None:
    text = page("heartbeat.md")
    assert "0.7 × 330 kΩ × 2.2 µF = 0.51 s" in text
    assert "0.41 s" in text
    assert "0.62 s" in text


@every_row(
    ("socket_v", "adc_v"),
    [(0.20, 0.128), (2.20, 1.410), (4.20, 2.692), (4.50, 2.885), (5.00, 3.205)],
)
def test_the_divider_gives_what_the_profile_and_the_pages_say(socket_v: float, adc_v: float) -> None:
    assert divided_v(socket_v) == pytest.approx(adc_v, abs=0.0006)
    assert divided_v(socket_v) < ADC_LIMIT_V
    assert f"{adc_v:.3f}" in page("paths/g5500.md")


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
