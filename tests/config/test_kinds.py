"""Each kind of rotor answers for itself: its lines and their off levels, how its angles are known, its reach."""

from __future__ import annotations

from typing import get_args

import pytest

from hw.ports import AngleSource, Axis
from rotator.assembly.kinds import builder
from rotator.assembly.station import off_lines as lines_that_stop
from rotator.config.kinds import KINDS, KindName
from rotator.config.load import ConfigError, parse
from rotator.config.model import Config
from rotator.setup.pins import off_levels

RELAYS = ("azimuth_cw", "azimuth_ccw", "elevation_up", "elevation_down")


def of(kind: str, more: str = "") -> Config:
    return parse(f'[rotor]\ntype = "{kind}"\n{more}', "box")


def test_every_kind_is_in_both_tables() -> None:
    assert set(get_args(KindName)) == set(KINDS)
    assert len({builder(name) for name in get_args(KindName)}) == len(KINDS)


@pytest.mark.parametrize("name", KINDS)
def test_the_configuration_makes_the_kind_that_it_names(name: KindName) -> None:
    assert type(of(name).kind) is KINDS[name]


@pytest.mark.parametrize(
    ("cam", "most_deg"),
    [
        ("play_deg = 1.2", "1"),
        ("closed_deg = 4\nplay_deg = 1", "1"),
        ("spacing_deg = 6\nclosed_deg = 3\nplay_deg = 10", "3"),
    ],
)
def test_a_gear_with_more_play_than_a_closure_is_wide_cannot_be_homed_and_is_refused(cam: str, most_deg: str) -> None:
    with pytest.raises(ConfigError, match=rf"elevation: play_deg \(.*\) must be below {most_deg},"):
        of("relay-pulse", f"[pulses.elevation]\n{cam}\n")


@pytest.mark.parametrize(
    ("kind", "more", "off", "stops"),
    [
        ("relay-pot", "", {22: "dl", 23: "dl", 24: "dl", 25: "dl"}, RELAYS),
        ("relay-pulse", '[relays]\nactive = "low"\n', {22: "dh", 23: "dh", 24: "dh", 25: "dh"}, RELAYS),
        (
            "relay-pot",
            '[relays]\nactive = "low"\nmaster = 16\nheartbeat = 26\n',
            {22: "dh", 23: "dh", 24: "dh", 25: "dh", 16: "dh", 26: "dl"},
            (*RELAYS, "master", "heartbeat"),
        ),
        ("digipot", "[digipot]\nenable = 16\n", {16: "dl"}, ("box_enable",)),
        ("servo", "[servo]\nenable = 16\n", {16: "dh"}, ()),  # without its pulses the antenna would drop
        ("servo", "", {}, ()),
        ("moteus", "", {}, ()),
    ],
)
def test_lines_that_are_off_at_the_start_and_those_that_stop_the_motors(
    kind: str, more: str, off: dict[int, str], stops: tuple[str, ...]
) -> None:
    config = of(kind, more)
    assert off_levels(config) == off
    lines = lines_that_stop(config, lambda: "/dev/gpiochip0")
    assert tuple(lines.offsets if lines else ()) == stops
    if lines is not None:
        assert lines.active_low is ('active = "low"' in more)


@pytest.mark.parametrize(
    ("kind", "source", "in_degrees", "pot"),
    [
        ("relay-pot", AngleSource.MEASURED, False, True),
        ("relay-pulse", AngleSource.COUNTED, True, False),
        ("moteus", AngleSource.MEASURED, True, False),
        ("servo", AngleSource.MODELLED, True, False),
        ("digipot", AngleSource.MODELLED, True, False),
    ],
)
def test_how_an_angle_is_known_without_another_sensor(
    kind: str, source: AngleSource, in_degrees: bool, pot: bool
) -> None:
    for axis in Axis:
        angle = of(kind).angle(axis)
        assert (angle.source, angle.in_degrees, angle.pot) == (source, in_degrees, pot)


@pytest.mark.parametrize("kind", KINDS)
def test_another_sensor_comes_before_the_kinds_own(kind: str) -> None:
    config = of(kind, '[azimuth.sensor]\nkind = "as5600"\n[elevation.sensor]\nkind = "mpu6050"\n')
    azimuth, elevation = (config.angle(axis) for axis in Axis)
    assert (azimuth.source, azimuth.in_degrees, azimuth.pot) == (AngleSource.MEASURED, False, False)
    assert (elevation.source, elevation.in_degrees, elevation.by) == (AngleSource.MEASURED, True, "told by gravity")


@pytest.mark.parametrize(
    ("kind", "more", "reach_deg"),
    [
        ("relay-pot", "", (None, None)),
        ("relay-pulse", "[pulses.azimuth]\nhome_deg = -3.0\n", (-3.0, None)),
        ("relay-pulse", '[azimuth.sensor]\nkind = "as5600"\n', (None, None)),
        ("moteus", "", (None, None)),
        ("servo", "", (0.0, 180.0)),
        ("digipot", "", (0.0, 360.0)),
    ],
)
def test_the_reach_of_its_own_table(kind: str, more: str, reach_deg: tuple[float | None, float | None]) -> None:
    assert of(kind, more).reach_deg(Axis.AZIMUTH) == reach_deg
