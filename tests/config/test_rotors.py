"""What is usual for each kind of rotor stands in for what the file leaves out, and for nothing else."""

from __future__ import annotations

import copy
from typing import Any

import pytest

from rotator.config.load import ConfigError, parse
from rotator.config.model import Config
from rotator.config.rotors import USUAL, with_usual

KINDS = list(USUAL)


def rotor(kind: str, hardware: str = "sim") -> dict[str, Any]:
    return {"rotor": {"type": kind, "hardware": hardware}}


def figures(config: Config) -> tuple[float, ...]:
    """Speeds of the file's axes and of the simulated motors."""
    sim = config.sim
    return config.azimuth.speed_dps, config.elevation.speed_dps, sim.azimuth.speed_dps, sim.elevation.speed_dps


@pytest.mark.parametrize(
    ("kind", "speeds_dps", "most_deg"),
    [
        ("relay-pot", (6.0, 2.7, 6.0, 2.7), (450.0, 180.0)),
        ("relay-pulse", (6.0, 6.0, 6.0, 6.0), (450.0, 180.0)),
        ("moteus", (30.0, 30.0, 30.0, 30.0), (450.0, 180.0)),
        ("servo", (60.0, 60.0, 60.0, 60.0), (180.0, 180.0)),
        ("digipot", (6.0, 6.0, 6.0, 6.0), (360.0, 90.0)),
    ],
)
def test_a_file_that_names_the_kind_alone(
    kind: str, speeds_dps: tuple[float, ...], most_deg: tuple[float, float]
) -> None:
    config = parse(f'[rotor]\ntype = "{kind}"\n', "a file")
    assert figures(config) == speeds_dps
    assert (config.azimuth.max_deg, config.elevation.max_deg) == most_deg


def test_every_kind_is_here() -> None:
    assert {kind: Config.model_validate(rotor(kind)).rotor.type for kind in KINDS} == {kind: kind for kind in KINDS}


def test_what_the_file_says_is_left_as_it_is() -> None:
    said = rotor("servo") | {"azimuth": {"speed_dps": 20.0}, "sim": {"elevation": {"speed_dps": 11.0}}}
    filled = with_usual(said)
    assert filled["azimuth"] == {"speed_dps": 20.0, "max_deg": 180.0}
    assert filled["sim"]["elevation"] == {"speed_dps": 11.0}
    assert filled["sim"]["azimuth"] == {"speed_dps": 60.0}


def test_nor_is_the_file_s_own_table_written_to() -> None:
    said = rotor("digipot") | {"azimuth": {"min_deg": 1.0}, "sim": {"azimuth": {"lag_s": 0.2}}}
    before = copy.deepcopy(said)
    with_usual(said)
    assert said == before


@pytest.mark.parametrize("kind", ["servo", "digipot"])
def test_on_real_hardware_no_limit_is_usual(kind: str) -> None:
    filled = with_usual(rotor(kind, "pi"))
    assert "max_deg" not in filled.get("azimuth", {})
    assert "max_deg" not in filled.get("elevation", {})
    assert filled["elevation"]["speed_dps"] in (6.0, 60.0), "but its speed is"


def test_so_that_a_servo_on_a_pi_has_to_be_given_its_limits() -> None:
    with pytest.raises(ConfigError, match=r"azimuth: min_deg 0 to max_deg 450 goes beyond servo\.azimuth\.pulses_us"):
        parse('[rotor]\ntype = "servo"\nhardware = "pi"\n', "a file")


@pytest.mark.parametrize("said", [{}, {"rotor": {}}, {"rotor": {"hardware": "pi"}}, rotor("relay-pot")])
def test_a_relay_rotor_has_the_defaults_and_no_more(said: dict[str, Any]) -> None:
    assert with_usual(said) == said


@pytest.mark.parametrize(
    "said",
    [
        {"rotor": "servo"},
        {"rotor": {"type": 5}},
        {"rotor": {"type": "steam"}},
        {"rotor": {"type": ["servo"]}},
        rotor("servo") | {"azimuth": 90},
        rotor("servo") | {"sim": []},
        rotor("servo") | {"sim": {"azimuth": "fast"}},
    ],
    ids=str,
)
def test_nonsense_is_passed_on_for_the_model_to_refuse(said: dict[str, Any]) -> None:
    filled = with_usual(said)
    assert all(filled[key] == value for key, value in said.items() if not isinstance(value, dict))
    with pytest.raises(ValueError, match="validation error"):
        Config.model_validate(said)
