"""The shipped configurations for real rotors: each loads, aims nothing before it is set up, and flies a pass."""

from __future__ import annotations

import pytest

from firmware_sim.parts.pot import SimPot
from rotator.assembly.settings import missing
from rotator.assembly.simulated_axes import SimulatedAxes
from rotator.cli.rehearse import simulated
from rotator.config.axes import AxisTable
from rotator.config.load import ConfigError, parse, shipped
from rotator.config.model import Config
from rotator.control.axis.calibration_table import Calibration
from rotator.exchange.faults import Missing
from rotator.rehearsal.flight import fly, plant_maker
from rotator.rehearsal.passes import SHIPPED, Pass, read_pass
from tests.search import some

POTS = ["f1efw", "g1000", "g450", "g5500", "ham4", "spid"]
OTHERS = ["controller", "isel", "orbit360", "satnogs", "servos", "slew-drive", "u100"]
"""Rotors whose angles need no calibration: counted, told by their controllers, or modelled."""
NAMES = sorted(POTS + OTHERS)
KINDS = {
    "controller": "controller",
    "isel": "moteus",
    "orbit360": "digipot",
    "satnogs": "stepper",
    "servos": "servo",
    "slew-drive": "h-bridge",
    "u100": "relay-pulse",
}


def profile(name: str) -> Config:
    return parse(shipped(name), name)


def axes(config: Config) -> list[AxisTable]:
    return [config.axis(axis) for axis in config.fitted]


def test_a_name_as_the_rotor_is_called_and_one_that_is_not_there() -> None:
    assert shipped("G5500") == shipped("g5500")
    with pytest.raises(ConfigError, match=r"no such configuration\. Did you mean g5500\? There are: simulated, "):
        shipped("g550")


@pytest.mark.parametrize("name", NAMES)
def test_it_is_for_real_hardware_and_may_not_be_aimed_as_shipped(name: str) -> None:
    config = profile(name)
    assert config.rotor.hardware == "pi"
    assert config.state.path == "/var/lib/rotator/state.json"
    assert config.link
    for table in axes(config):
        assert missing(table, calibrated=True) == (Missing.DIRECTION_CHECK,)


@pytest.mark.parametrize("name", POTS)
def test_the_whole_range_lies_within_the_readings_that_are_believed(name: str) -> None:
    for table in axes(profile(name)):
        assert table.calibration is not None
        raws = [raw for raw, _ in table.calibration]
        assert min(raws) > table.lowest_reading + 0.015
        assert max(raws) < table.highest_reading - 0.015
        assert (table.calibration[0][1], table.calibration[-1][1]) == (table.min_deg, table.max_deg)


@pytest.mark.parametrize("name", POTS)
def test_its_simulated_pots_read_what_the_file_says_up_to_the_stops(name: str) -> None:
    config = parse(shipped(name).replace('hardware = "pi"', 'hardware = "sim"'), name)
    parts = SimulatedAxes(config, lambda: 0.0, None, (0.0, 0.0))
    for axis in config.fitted:
        table, motor, pot = config.axis(axis), parts.motor(axis), SimPot(parts.pot(axis), config.adc.supply_v)
        for stop_deg in (motor.stop_low_deg, motor.stop_high_deg):
            assert table.lowest_reading < pot.ratio(stop_deg) < table.highest_reading


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


# --- what the builders of the originals say of theirs


def test_a_u100_as_ko6th_built_it() -> None:
    config = profile("u100")
    pulses, relays = config.pulses, config.relays
    assert list(relays.contacts.values()) == [22, 23, 24, 25]
    assert (pulses.azimuth.contact, pulses.elevation.contact) == (16, 20)
    assert config.azimuth.max_deg / pulses.azimuth.spacing_deg == 72
    assert config.elevation.max_deg / pulses.elevation.spacing_deg == 36
    assert (relays.one_at_a_time, relays.dead_time_s) == (True, 0.5)


def test_isels_two_moteus_two_servos_and_aa2txs_digital_pots() -> None:
    azimuth, elevation = profile("isel").moteus.azimuth, profile("isel").moteus.elevation
    assert (azimuth.id, azimuth.zero_rev, azimuth.rev_per_turn) == (1, 0, 1)
    assert [elevation.zero_rev + degrees / 360 * elevation.rev_per_turn for degrees in (0, 90)] == [-0.25, -0.5]
    servos = profile("servos")
    assert (servos.azimuth.max_deg, servos.elevation.max_deg, servos.mount.flip) == (180, 180, "over-top")
    warning, _, _ = shipped("servos").partition('flip = "over-top"')
    assert "A person must have seen" in " ".join(warning.replace("#", " ").split())
    digipot = profile("orbit360").digipot
    assert digipot.enable is not None, "no supply before they are told"
    (low_deg, low), (high_deg, high) = digipot.elevation.steps
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


@pytest.mark.parametrize(("name", "pot", "end"), [("f1efw", 500, 33), ("spid", 10_000, 680)])
def test_end_resistors_as_reckoned(name: str, pot: float, end: float) -> None:
    whole = pot + 2 * end
    for table in axes(profile(name)):
        assert table.calibration is not None
        assert table.calibration[0][0] == pytest.approx(end / whole, abs=0.0006)
        assert table.calibration[-1][0] == pytest.approx((pot + end) / whole, abs=0.0006)
