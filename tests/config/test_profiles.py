"""The shipped configurations for real rotors: each loads, aims nothing before it is set up, and flies a pass."""

from __future__ import annotations

from pathlib import Path

import pytest

from rotator.app import missing
from rotator.cli.rehearse import simulated
from rotator.config.load import ConfigError, parse, profiles, shipped
from rotator.config.model import AxisTable, Config
from rotator.control.calibration import Calibration
from rotator.passes import read_pass
from rotator.rehearsal import fly, plant_maker

PASSES = Path(__file__).parents[1] / "passes"
NAMES = ["f1efw", "g5500", "spid"]


def profile(name: str) -> Config:
    return parse(shipped(name), name)


def axes(config: Config) -> list[AxisTable]:
    return [config.azimuth, config.elevation]


def test_there_are_these() -> None:
    assert profiles() == NAMES


def test_a_name_that_is_not_there() -> None:
    with pytest.raises(ConfigError, match="did you mean g5500"):
        shipped("g550")


@pytest.mark.parametrize("name", NAMES)
def test_it_is_for_real_hardware_and_keeps_its_state_there(name: str) -> None:
    config = profile(name)
    assert config.rotor.hardware == "pi"
    assert config.state.path == "/var/lib/rotator/state.json"
    assert config.link


@pytest.mark.parametrize("name", NAMES)
def test_as_shipped_it_may_not_be_aimed(name: str) -> None:
    for table in axes(profile(name)):
        assert "direction check" in missing(table)


@pytest.mark.parametrize("name", NAMES)
def test_the_whole_range_lies_within_the_readings_that_are_believed(name: str) -> None:
    for table in axes(profile(name)):
        assert table.calibration is not None
        raws = [raw for raw, _ in table.calibration]
        assert min(raws) > table.lowest_reading + 0.015
        assert max(raws) < table.highest_reading - 0.015
        assert (table.calibration[0][1], table.calibration[-1][1]) == (table.min_deg, table.max_deg)


@pytest.mark.parametrize("name", NAMES)
def test_it_flies_a_pass(name: str) -> None:
    _, summary = fly(read_pass(PASSES / "mid-1-iss.csv"), plant_maker(simulated(profile(name))))
    assert summary.relay_starts is not None
    assert 0 < summary.relay_starts < 100
    assert summary.rms_deg < 4.0


@pytest.mark.parametrize(
    ("axis", "volts", "angle_deg"),
    [
        ("azimuth", 0.22, 0.0),
        ("azimuth", 4.23, 450.0),
        ("elevation", 0.20, 0.0),
        ("elevation", 2.20, 90.0),
        ("elevation", 4.20, 180.0),
    ],
)
def test_a_g5500_behind_its_divider(axis: str, volts: float, angle_deg: float) -> None:
    config = profile("g5500")
    table: AxisTable = getattr(config, axis)
    assert table.calibration is not None
    at_converter_v = volts * 100 / (56 + 100)
    raw = at_converter_v / config.adc.supply_v
    assert Calibration(tuple(table.calibration)).degrees(raw) == pytest.approx(angle_deg, abs=0.2)
    assert table.lowest_reading < raw < table.highest_reading


def test_a_g5500_at_its_largest_setting_does_not_hurt_the_converter() -> None:
    assert 5.0 * 100 / (56 + 100) < 3.3


@pytest.mark.parametrize(("name", "pot", "end"), [("f1efw", 500, 33), ("spid", 10_000, 680)])
def test_end_resistors_as_reckoned(name: str, pot: float, end: float) -> None:
    whole = pot + 2 * end
    for table in axes(profile(name)):
        assert table.calibration is not None
        assert table.calibration[0][0] == pytest.approx(end / whole, abs=0.0006)
        assert table.calibration[-1][0] == pytest.approx((pot + end) / whole, abs=0.0006)
