"""Each kind of rotor answers for itself: its lines and their off levels, how its angles are known, its reach."""

from __future__ import annotations

import re
from typing import Any, get_args

import pytest

from hw.ports import AngleSource, Axis
from rotator.assembly.kinds import builder
from rotator.assembly.station import off_lines as lines_that_stop
from rotator.config.kinds import KINDS, KindName, with_usual
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
        (
            "h-bridge",
            "[bridge]\nenable = 4\n",
            {22: "dl", 23: "dl", 24: "dl", 25: "dl", 4: "dl"},
            ("azimuth_plus", "azimuth_minus", "elevation_plus", "elevation_minus", "enable"),
        ),
        (
            "h-bridge",
            '[bridge]\nlines = "direction"\nenable = 4\n',
            {22: "dl", 24: "dl", 4: "dl"},
            ("azimuth_plus", "elevation_plus", "enable"),
        ),
        ("servo", "[servo]\nenable = 16\n", {16: "dh"}, ()),  # without its pulses the antenna would drop
        ("servo", "", {}, ()),
        ("moteus", "", {}, ()),
        ("controller", "", {}, ()),
        ("stepper", "", {}, ()),
        ("stepper", "[stepper]\nenable = 4\n", {4: "dh"}, ("enable",)),
        # Without gears that hold, the antenna would fall.
        ("stepper", "[stepper]\nenable = 4\nself_locking = false\n", {4: "dh"}, ()),
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
        assert lines.active_low is ('active = "low"' in more or kind == "stepper")


@pytest.mark.parametrize(
    ("kind", "source", "in_degrees", "pot"),
    [
        ("relay-pot", AngleSource.MEASURED, False, True),
        ("relay-pulse", AngleSource.COUNTED, True, False),
        ("relay-timed", AngleSource.MODELLED, True, False),
        ("moteus", AngleSource.MEASURED, True, False),
        ("servo", AngleSource.MODELLED, True, False),
        ("digipot", AngleSource.MODELLED, True, False),
        ("h-bridge", AngleSource.COUNTED, True, False),
        ("controller", AngleSource.MEASURED, True, False),
        ("stepper", AngleSource.COUNTED, True, False),
    ],
)
def test_how_an_angle_is_known_without_another_sensor(
    kind: str, source: AngleSource, in_degrees: bool, pot: bool
) -> None:
    for axis in Axis:
        angle = of(kind).angle(axis)
        assert (angle.source, angle.in_degrees, angle.pot) == (source, in_degrees, pot)


@pytest.mark.parametrize("kind", sorted(KINDS.keys() - {"h-bridge", "stepper"}))  # they follow their own count
def test_another_sensor_comes_before_the_kinds_own(kind: str) -> None:
    config = of(kind, '[azimuth.sensor]\nkind = "as5600"\n[elevation.sensor]\nkind = "mpu6050"\n')
    azimuth, elevation = (config.angle(axis) for axis in Axis)
    assert (azimuth.source, azimuth.in_degrees, azimuth.pot) == (AngleSource.MEASURED, False, False)
    assert (elevation.source, elevation.in_degrees, elevation.by) == (AngleSource.MEASURED, True, "told by gravity")


MAGNETIC = '[mount]\nnorth = "magnetic"\ndeclination_deg = 4\n'


@pytest.mark.parametrize("chip", ["qmc5883l", "hmc5883l", "lsm303-mag"])
def test_a_compass_for_the_azimuth(chip: str) -> None:
    text = f'[azimuth]\nmin_deg = 185\nmax_deg = 535\n[azimuth.sensor]\nkind = "{chip}"\n{MAGNETIC}'
    angle = of("relay-pot", text).angle(Axis.AZIMUTH)
    assert (angle.source, angle.in_degrees, angle.by) == (AngleSource.MEASURED, True, "told by a compass")


@pytest.mark.parametrize(
    ("kind", "more", "said"),
    [
        ("relay-pot", '[azimuth]\nmax_deg = 350\n[azimuth.sensor]\nkind = "qmc5883l"\n', 'north = "magnetic"'),
        ("relay-pot", f'[azimuth.sensor]\nkind = "qmc5883l"\n{MAGNETIC}', "azimuth.max_deg must be 350 at most"),
        (
            "servo",
            f'[azimuth]\nmax_deg = 180\n[azimuth.sensor]\nkind = "hmc5883l"\n{MAGNETIC}',
            "a compass is too coarse for rotor.type = servo",
        ),
        ("relay-pot", '[elevation.sensor]\nkind = "lsm303-mag"\n', "a compass tells no elevation"),
        ("relay-pot", '[azimuth.sensor]\nkind = "adxl345"\n', "gravity tells no azimuth"),
        ("relay-pot", '[elevation.sensor]\nkind = "adxl345"\naddress = 0x54\n', "no ADXL345 has that"),
        ("relay-pot", '[elevation.sensor]\nkind = "adxl345"\nradius_ut = [20, 0]\n', "both must be above 0"),
    ],
)
def test_what_a_compass_or_gravity_cannot_tell(kind: str, more: str, said: str) -> None:
    with pytest.raises(ConfigError, match=re.escape(said)):
        of(kind, more)


@pytest.mark.parametrize(
    ("kind", "more", "reach_deg"),
    [
        ("relay-pot", "", (None, None)),
        ("relay-pulse", "[pulses.azimuth]\nhome_deg = -3.0\n", (-3.0, None)),
        ("relay-pulse", '[azimuth.sensor]\nkind = "as5600"\n', (None, None)),
        ("relay-timed", "[timed.azimuth]\nend_deg = 370.0\n", (0.0, 370.0)),
        ("moteus", "", (None, None)),
        ("servo", "", (0.0, 180.0)),
        ("digipot", "", (0.0, 360.0)),
        ("h-bridge", "", (None, None)),
    ],
)
def test_the_reach_of_its_own_table(kind: str, more: str, reach_deg: tuple[float | None, float | None]) -> None:
    assert of(kind, more).reach_deg(Axis.AZIMUTH) == reach_deg


@pytest.mark.parametrize(
    ("more", "said"),
    [
        ('[azimuth.sensor]\nkind = "as5600"\n', "the motor behind an H-bridge follows its own encoder"),
        ('[bridge]\nlines = "direction"\n', 'lines = "direction" needs enable'),
        ("[bridge.elevation]\npwm = 12\n", "GPIO 18 and 12 are one channel of the PWM"),
        ("[bridge.elevation]\npwm = 17\n", "12, 13, 18"),
        ("[bridge.azimuth]\ncounts_per_deg = 1\n", "2 counts a degree is the least"),
        ("[bridge.azimuth]\ncounts_per_deg = -2000\n", "6000 counts a second; the box reads 4000"),
        (
            '[bridge]\nchannels = 1\n[bridge.azimuth]\ncounter = "ls7366r"\n',
            'azimuth.counter = "ls7366r" counts two channels: leave channels = 1 out',
        ),
        (
            '[bridge.azimuth]\ncounter = "ls7366r"\nselect = 7\n[bridge.elevation]\ncounter = "ls7366r"\n',
            "GPIO 7 is used by bridge.azimuth.select and bridge.elevation.select",
        ),
        ('[bridge.azimuth]\nhome = "switch"\n', "say where its switch is, limits.azimuth_low"),
        ('[bridge.azimuth]\nhome = "index"\n', "say its GPIO: index"),
        ("[bridge.azimuth]\nindex = 10\n", "leave index out"),
        ('[bridge.azimuth]\nhome = "index"\nindex = 10\nhome_deg = 5\n', "must be at the lower end of the range"),
        ("[bridge]\nchannels = 1\n[bridge.azimuth]\ncounts_per_deg = -20\n", "one channel has no direction"),
        ("[bridge.azimuth]\na = 22\n", "GPIO 22 is used by bridge.azimuth.plus and bridge.azimuth.a"),
    ],
)
def test_an_h_bridge_that_cannot_be_is_refused_in_a_sentence(more: str, said: str) -> None:
    with pytest.raises(ConfigError, match=said):
        of("h-bridge", more)


def test_a_counter_chip_takes_no_lines_for_the_channels_and_any_number_of_counts() -> None:
    config = of("h-bridge", '[bridge.azimuth]\ncounter = "ls7366r"\ncounts_per_deg = -9000\n')
    keys = {key for _, key in config.pins()}
    assert keys & {"bridge.azimuth.a", "bridge.azimuth.b"} == set()
    assert keys >= {"bridge.azimuth.select", "bridge.sck", "bridge.elevation.a", "bridge.elevation.b"}


# --- what is usual for a kind stands in for what the file leaves out, and for nothing else


def rotor(kind: str, hardware: str = "sim") -> dict[str, Any]:
    return {"rotor": {"type": kind, "hardware": hardware}}


@pytest.mark.parametrize(
    ("kind", "speeds_dps", "most_deg"),
    [
        ("relay-pot", (6.0, 2.7, 6.0, 2.7), (450.0, 180.0)),
        ("relay-pulse", (6.0, 6.0, 6.0, 6.0), (450.0, 180.0)),
        ("moteus", (30.0, 30.0, 30.0, 30.0), (450.0, 180.0)),
        ("servo", (60.0, 60.0, 60.0, 60.0), (180.0, 180.0)),
        ("digipot", (6.0, 6.0, 6.0, 6.0), (360.0, 90.0)),
        ("controller", (6.0, 2.7, 6.0, 2.7), (450.0, 180.0)),
        ("stepper", (10.0, 10.0, 10.0, 10.0), (360.0, 180.0)),
    ],
)
def test_a_file_that_names_the_kind_alone(
    kind: str, speeds_dps: tuple[float, ...], most_deg: tuple[float, float]
) -> None:
    config = parse(f'[rotor]\ntype = "{kind}"\n', "a file")
    tables = (config.azimuth, config.elevation, config.sim.azimuth, config.sim.elevation)
    assert tuple(table.speed_dps for table in tables) == speeds_dps
    assert (config.azimuth.max_deg, config.elevation.max_deg) == most_deg


def test_what_the_file_says_is_left_as_it_is() -> None:
    said = rotor("servo") | {"azimuth": {"speed_dps": 20.0}, "sim": {"elevation": {"speed_dps": 11.0}}}
    filled = with_usual(said)
    assert filled["azimuth"] == {"speed_dps": 20.0, "max_deg": 180.0}
    assert filled["sim"]["elevation"] == {"speed_dps": 11.0}
    assert filled["sim"]["azimuth"] == {"speed_dps": 60.0}


@pytest.mark.parametrize("kind", ["servo", "digipot"])
def test_on_real_hardware_no_limit_is_usual(kind: str) -> None:
    filled = with_usual(rotor(kind, "pi"))
    assert "max_deg" not in filled.get("azimuth", {})
    assert "max_deg" not in filled.get("elevation", {})
    assert filled["elevation"]["speed_dps"] in (6.0, 60.0), "but its speed is"


def test_so_that_a_servo_on_a_pi_has_to_be_given_its_limits() -> None:
    with pytest.raises(ConfigError, match=r"azimuth: min_deg 0 to max_deg 450 goes beyond servo\.azimuth\.pulses_us"):
        parse('[rotor]\ntype = "servo"\nhardware = "pi"\n', "a file")


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


def test_a_real_controller_is_somewhere() -> None:
    with pytest.raises(ConfigError, match="controller has neither serial nor tcp: say where the controller is"):
        parse('[rotor]\ntype = "controller"\nhardware = "pi"\n', "a file")


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ("[stepper.azimuth]\nselect = 7\n", "azimuth and elevation both have select 7"),
        ("[stepper.azimuth]\nselect = 5\n", "azimuth.select = 5 is no select of the Pi's own SPI"),
        ("[stepper.azimuth]\ngear = 0.0\n", "gear must not be 0"),
        ("[stepper.elevation]\ngear = 3.0\n", "elevation.gear = 3 does not hold the antenna without current"),
        ('[stepper.azimuth]\nhome = "stall"\nhome_deg = 5\n', "home_deg = 5 is above azimuth.min_deg = 0"),
        ('[azimuth.sensor]\nkind = "as5600"\n', "a stepper's angle is counted by its chip"),
    ],
)
def test_a_stepper_is_told_what_does_not_fit(wrong: str, said: str) -> None:
    with pytest.raises(ConfigError, match=re.escape(said)):
        of("stepper", wrong)
