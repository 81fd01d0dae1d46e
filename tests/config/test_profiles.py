"""The shipped configurations for real rotors: each loads, aims nothing before it is set up, and flies a pass."""

from __future__ import annotations

import pytest

from hw.ports import Axis
from rotator.assembly.settings import missing
from rotator.cli.rehearse import simulated
from rotator.config.axes import AxisTable
from rotator.config.load import ConfigError, parse, profiles, shipped
from rotator.config.model import Config
from rotator.control.axis.calibration_table import Calibration
from rotator.exchange.faults import Missing
from rotator.rehearsal.flight import fly, plant_maker
from rotator.rehearsal.passes import SHIPPED, Pass, read_pass
from tests.search import some

POTS = ["f1efw", "g5500", "spid"]
OTHERS = ["isel", "orbit360", "servos", "u100"]
"""Rotors whose angles need no calibration: counted, told by their controllers, or modelled."""
NAMES = sorted(POTS + OTHERS)
KINDS = {"isel": "moteus", "orbit360": "digipot", "servos": "servo", "u100": "relay-pulse"}


def profile(name: str) -> Config:
    return parse(shipped(name), name)


def axes(config: Config) -> list[AxisTable]:
    return [config.azimuth, config.elevation]


def test_there_are_these() -> None:
    assert profiles() == NAMES


def test_a_name_that_is_not_there() -> None:
    with pytest.raises(ConfigError, match=r"no such configuration\. Did you mean g5500\? There are: simulated, "):
        shipped("g550")


def test_a_name_as_the_rotor_is_called() -> None:
    assert shipped("G5500") == shipped("g5500")


@pytest.mark.parametrize("name", NAMES)
def test_it_is_for_real_hardware_and_keeps_its_state_there(name: str) -> None:
    config = profile(name)
    assert config.rotor.hardware == "pi"
    assert config.state.path == "/var/lib/rotator/state.json"
    assert config.link


@pytest.mark.parametrize("name", NAMES)
def test_as_shipped_it_may_not_be_aimed(name: str) -> None:
    for table in axes(profile(name)):
        assert missing(table, calibrated=True) == (Missing.DIRECTION_CHECK,)


@pytest.mark.parametrize("name", POTS)
def test_the_whole_range_lies_within_the_readings_that_are_believed(name: str) -> None:
    for table in axes(profile(name)):
        assert table.calibration is not None
        raws = [raw for raw, _ in table.calibration]
        assert min(raws) > table.lowest_reading + 0.015
        assert max(raws) < table.highest_reading - 0.015
        assert (table.calibration[0][1], table.calibration[-1][1]) == (table.min_deg, table.max_deg)


@pytest.mark.search
@pytest.mark.parametrize("name", some(POTS))
def test_it_flies_the_beginning_of_a_pass(name: str) -> None:
    """The whole of it is in tests/flights, and there the others fly all twelve."""
    whole = read_pass(SHIPPED / "mid-1-iss.csv")
    first = Pass("two minutes and a half", tuple(row for row in whole.rows if row[0] <= 150.0))
    _, summary = fly(first, plant_maker(simulated(profile(name))))
    assert summary.relay_starts is not None
    assert 0 < summary.relay_starts < 30
    assert summary.rms_deg < 4.0


@pytest.mark.parametrize("name", OTHERS)
def test_the_same_file_with_sim_in_it_is_a_simulation(name: str) -> None:
    config = parse(shipped(name).replace('hardware = "pi"', 'hardware = "sim"'), name)
    assert config.rotor.hardware == "sim"
    assert config.rotor.type == KINDS[name]
    assert [link.protocol for link in config.link if link.tcp] == ["rotctld"]
    assert [link.serial for link in config.link if link.serial] == ["/dev/ttyGS0"]


@pytest.mark.parametrize("name", OTHERS)
def test_its_angles_need_no_calibration(name: str) -> None:
    config = profile(name)
    assert all(config.in_degrees(axis) for axis in Axis)


# --- what the builders of the originals say of theirs


def test_a_u100_as_ko6th_built_it() -> None:
    config = profile("u100")
    pulses, relays = config.pulses, config.relays
    assert [relays.azimuth_cw, relays.azimuth_ccw, relays.elevation_up, relays.elevation_down] == [22, 23, 24, 25]
    assert (pulses.azimuth.contact, pulses.elevation.contact) == (16, 20)
    assert config.azimuth.max_deg / pulses.azimuth.spacing_deg == 72
    assert config.elevation.max_deg / pulses.elevation.spacing_deg == 36
    assert relays.one_at_a_time
    assert relays.dead_time_s == 0.5


def test_isels_two_moteus() -> None:
    config = profile("isel")
    azimuth, elevation = config.moteus.azimuth, config.moteus.elevation
    assert (azimuth.id, elevation.id) == (1, 2)
    assert (azimuth.zero_rev, azimuth.zero_rev + azimuth.rev_per_turn) == (0, 1)
    assert [elevation.zero_rev + degrees / 360 * elevation.rev_per_turn for degrees in (0, 90)] == [-0.25, -0.5]
    assert 1 / config.control.rate_hz == 0.02
    assert (config.elevation.min_deg, config.elevation.max_deg) == (0, 90)


def test_two_servos_of_180_degrees_go_over_the_top() -> None:
    config = profile("servos")
    assert (config.azimuth.max_deg, config.elevation.max_deg) == (180, 180)
    assert config.mount.flip == "over-top"
    warning, _, _ = shipped("servos").partition('flip = "over-top"')
    assert "A person must have seen" in " ".join(warning.replace("#", " ").split())
    assert config.link[0].protocol == "easycomm2"


def test_aa2txs_digital_pots_have_no_supply_before_they_are_told() -> None:
    config = profile("orbit360")
    assert config.digipot.enable is not None
    (low_deg, low), (high_deg, high) = config.digipot.elevation.steps
    assert (high_deg - low_deg, high - low) == (90, 64)


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
