"""Tables other than links: what each may say, and what is told of keys that contradict each other."""

from __future__ import annotations

from typing import Any

import pytest

from hw.ports import Axis
from hw.sensors.switches import LIMITS
from rotator.assembly.settings import build_mount
from rotator.config.chips import ADDRESSES, I2CChip
from rotator.config.forbidden import seen_again
from rotator.config.load import parse
from rotator.config.panel import LAMPS, LimitsTable, PanelTable
from rotator.control.sky.mount import Range
from rotator.panel.panel import LAMPS as PANEL_LAMPS
from tests.config.texts import faults, link

BELOW = "[azimuth]\nmin_deg = -180\nmax_deg = 180\n[elevation]\nmin_deg = -5\nmax_deg = 90\n"
SOUTH = "[azimuth]\nmin_deg = 90\nmax_deg = 270\n[elevation]\nmin_deg = 10\n"
BEHIND = '[rotor]\ntype = "controller"\n[controller]\n'
DIGIPOT = '[rotor]\ntype = "digipot"\n[mount]\npark_azimuth_deg = 90\n'
ELEMENTS = "https://example.org/elements.php?GROUP=amateur&FORMAT=json"
FOLLOW = "[[sky.follow]]\n"
ISS = f'{FOLLOW}name = "ISS"\n'


def sector(azimuth: str = "[100, 130]", elevation: str = "[0, 35]", name: str = "the chimney") -> str:
    return f'[[mount.forbidden]]\nname = "{name}"\nazimuth_deg = {azimuth}\nelevation_deg = {elevation}\n'


@pytest.mark.parametrize(
    ("text", "said"),
    [
        # where the antenna stands
        ("[station]\nlatitude_deg = 52.5", "latitude_deg and longitude_deg go together"),
        ("[station]\nlongitude_deg = 13.4", "latitude_deg and longitude_deg go together"),
        ('[station]\nlatitude_deg = 52.5\nlongitude_deg = 13.4\nlocator = "JO62qm"', "or locator, not both"),
        ('[station]\nlocator = "JO62"', 'must be a locator of 6, 8, 10 or 12 characters, such as "JO62qm"'),
        ('[station]\nlocator = "ZZ62qm"', "must be a locator"),
        ("[station]\nlatitude_deg = 91\nlongitude_deg = 0", "latitude_deg = 91"),
        # the sky
        ('[sky]\nfetch = "example.org/elements"', "must be an address such as"),
        ('[sky]\nfetch = "ftp://example.org/elements"', "must be an address such as"),
        ('[sky]\nfetch = "https://"', "must be an address such as"),
        ('[sky]\nfetch = "https://me:secret@example.org/elements"', "must be an address such as"),
        ('[sky]\nfetch = "http://example.org/two words"', "must be an address such as"),
        ('[sky]\nfetch = "http://example.org:99999/elements"', "must be an address such as"),
        ('[sky]\nfetch = "http://example.org/\\u00e9l\\u00e9ments"', "must be an address such as"),
        (f'[sky]\nfetch = ["{ELEMENTS}", "{ELEMENTS}"]', "stands there twice: take one out"),
        ('[sky]\nserve = "8233"', 'must be "host:port"'),
        ('[sky]\nallow = ["192.168.1.0/24"]', "allow is for serve, which says where others fetch"),
        ('[sky]\nserve = "0.0.0.0:8233"\nallow = ["home"]', "must be an address or a network"),
        (f"{FOLLOW}priority = 2\n", "the first [[sky.follow]]: name: must be given"),
        (f"{FOLLOW}name = 25544\n", "the first [[sky.follow]]: name = 25544: must be text in quotes"),
        (f"{ISS}prio = 2\n", "no such key; did you mean priority?"),
        (f"{ISS}priority = 0\n", "the first [[sky.follow]]: priority = 0: must be greater than 0"),
        ('[sky.follow]\nname = "ISS"\n', "must be a list in brackets; write [[sky.follow]]"),
        ('[sky]\nfollow = ["ISS"]\n', 'has a table of its own: write [[sky.follow]] and below it name = "ISS"'),
        ('[sky]\nfollow = "ISS"\n', 'has a table of its own: write [[sky.follow]] and below it name = "ISS"'),
        (f'{ISS}{FOLLOW}name = "iss"\n', 'follow[1] names "iss", as follow[0] does: take one out'),
        # the park position, and sectors
        ("[mount]\npark_azimuth_deg = 451\n", "park_azimuth_deg = 451 is outside azimuth's range, 0 to 450"),
        ("[mount]\npark_elevation_deg = -1\n", "park_elevation_deg = -1 is outside elevation's range, 0 to 180"),
        (SOUTH + "[mount]\npark_azimuth_deg = 0\n", "park_azimuth_deg = 0 is outside azimuth's range, 90 to 270"),
        ("[mount]\nhorizon = [[0, -91]]\n", "mount.horizon: elevations must be from -90 to 90"),
        (sector("[130, 100]"), "azimuth_deg = [130, 100] must rise"),
        (sector(elevation="[35, 35]"), "elevation_deg = [35, 35] must rise"),
        (sector("[500, 510]"), "azimuth_deg lies outside the rotor's range of 0 to 450"),
        (sector("[2, 448.5]", "[1, 179]"), "covers the whole range"),
        (sector("[1, 30]"), '"the chimney" holds the park position: the antenna could not stand there'),
        (sector() + sector("[200, 210]"), 'two of mount.forbidden are named "the chimney"'),
        (sector("100"), "azimuth_deg = 100: must be a pair of numbers in brackets"),
        (DIGIPOT + sector("[1, 30]"), "holds digipot's start_deg"),
        ("".join(sector(f"[{10 * i + 100}, {10 * i + 101}]", name=f"{i}") for i in range(17)), "forbidden"),
        # chips
        ("[adc]\naddress = 48\n", "adc.address = 48 is 0x30, and no ADS1115 has that: write 0x48"),
        ("[adc]\naddress = 0x77\n", "0x77, and no ADS1115 has that: write one of 0x48 to 0x4b"),
        # a gear with more play than a closure is wide cannot be homed
        ('[rotor]\ntype = "relay-pulse"\n[pulses.elevation]\nplay_deg = 1.2\n', "play_deg (1.2) must be below 1,"),
        (
            '[rotor]\ntype = "relay-pulse"\n[pulses.elevation]\nspacing_deg = 6\nclosed_deg = 3\nplay_deg = 10\n',
            "play_deg (10) must be below 3,",
        ),
        # a controller
        (BEHIND + 'protocol = "gs232"\n', "controller.protocol"),
        (BEHIND + 'protocol = "dcu1"\n', "dcu1 turns an azimuth only: give the elevation its own table"),
        (BEHIND + 'serial = "/dev/ttyUSB0"\ntcp = "127.0.0.1:4533"\n', "serial and tcp are both given"),
        (BEHIND + 'tcp = "4533"\n', 'must be "host:port"'),
        (BEHIND + "counts_from_deg = 0\n", "min_deg 0 to max_deg 450 may be 360 at most"),
        (BEHIND + "[azimuth]\nmin_deg = -180\nmax_deg = 180\n", "gs232b has no angle below 0; where it counts one"),
        (BEHIND + '[controller.elevation]\nserial = ""\n', "controller.elevation.serial"),
        # the panel
        ("[panel]\nmode_msb = 20\n", "panel: mode_msb and mode_lsb are the two contacts of one switch"),
        ("[panel]\nazimuth_knob = 0\n", "without the mode switch (mode_msb, mode_lsb) azimuth_knob would do nothing"),
        ("[panel]\nreference = 3\n", "neither a knob nor jog is fitted"),
        ("[panel]\njog = 3\nreference = 3\n", "input 3 is used by jog and reference"),
        ("[panel]\nazimuth_meter = 4\nlamp_auto = 4\n", "output 4 is used by azimuth_meter and lamp_auto"),
        ("[panel]\njog = 4\n", "panel.jog = 4: must be less than or equal to 3"),
    ],
)
def test_one_mistake(text: str, said: str) -> None:
    (fault,) = faults(text)
    assert said in fault


@pytest.mark.parametrize(
    "text",
    [
        '[station]\nlocator = "jo62QM"',
        '[station]\nlocator = "JO62qm34ab56"',
        "[station]\nlatitude_deg = -90\nlongitude_deg = 180",
        f'[sky]\nfetch = ["{ELEMENTS}", "http://[fd00::5]:8233/elements"]',
        f'[sky]\nfetch = "{ELEMENTS}"',
        ISS,
        sector("[100, 130.5]"),
        BELOW + "[mount]\nhorizon = [[0, -1], [180, 3]]",
        '[adc]\nkind = "mcp3208"\naddress = 48\n',
    ],
)
def test_what_is_good(text: str) -> None:
    assert faults(text) == []


@pytest.mark.parametrize(
    ("text", "park_deg"),
    [
        (BELOW + "[mount]\npark_azimuth_deg = -90\npark_elevation_deg = -5", (-90, -5)),
        ("[azimuth]\nmax_deg = 540\n[mount]\npark_azimuth_deg = 500\n", (500, 0)),
        (SOUTH, (90, 10)),
        ("[azimuth]\nmin_deg = 180\nmax_deg = 540\n", (360, 0)),
    ],
)
def test_the_park_position_is_any_place_of_the_range(text: str, park_deg: tuple[float, float]) -> None:
    assert parse(text, "rotator.toml").park_deg == park_deg


def test_a_sector_is_on_the_rotors_own_scale() -> None:
    shifted = "[azimuth]\noffset_deg = 10\n[elevation]\noffset_deg = -1\n"
    (chimney,) = build_mount(parse(shifted + sector(), "x")).sectors
    assert (chimney.name, chimney.azimuth, chimney.elevation) == ("the chimney", Range(110, 140), Range(-1, 34))


NO_FLIP = "[elevation]\nmax_deg = 90\n"
TURNED = (
    "the chimney stands on the other turn of the azimuth too",
    "azimuth_deg = [380, 410], elevation_deg = [5, 35]",
)
OVER = ("over the top the antenna meets the chimney too", "azimuth_deg = [280, 310], elevation_deg = [145, 180]")


@pytest.mark.parametrize(
    ("text", "again"),
    [
        (NO_FLIP + sector("[20, 50]", "[5, 35]"), [TURNED]),
        (NO_FLIP + sector("[20, 50]", "[5, 35]") + sector("[370, 420]", "[5, 35]", "again"), []),
        (NO_FLIP + sector("[100, 130]"), []),  # 460 is beyond the range
        (sector("[100, 130]"), [OVER]),
    ],
)
def test_what_stands_there_on_another_turn_or_over_the_top_is_named(text: str, again: list[tuple[str, str]]) -> None:
    config = parse(text, "x")
    assert seen_again(config.mount.forbidden, {axis: config.axis(axis) for axis in Axis}) == again


@pytest.mark.parametrize("part", ADDRESSES)
def test_every_address_of_a_part_is_taken_and_digits_without_0x_are_told(part: str) -> None:
    for address in ADDRESSES[part]:
        assert I2CChip(1, address, "key", part).fault() is None
        digits = f"{address:x}"
        if digits.isdecimal() and int(digits) not in ADDRESSES[part]:
            assert str(I2CChip(1, int(digits), "key", part).fault()).endswith(f": write 0x{digits}")


def test_parts_with_more_addresses_than_the_usual_ones() -> None:
    assert I2CChip(1, 0x60, "key", "PCA9685").fault() is None
    assert I2CChip(1, 0x31, "key", "AS5600").fault() is None


# --- keys that name a file: a folder alone is a mistake in the file, and no failure while the box starts

PATHS = {
    "state.path": "[state]\npath = {}\n",
    "monitor.path": "[monitor]\npath = {}\n",
    "sim.world": "[sim]\nworld = {}\n",
    "pty": link("gs232b") + "pty = {}\n",
    "file": link("wsjtx") + "file = {}\n",
}


@pytest.mark.parametrize("key", PATHS)
def test_a_path_names_a_file(key: str) -> None:
    for folder in ("/", ".", "..", "run/", "run/.", "../..", " "):
        (said,) = faults(PATHS[key].format(f'"{folder}"'))
        assert f'{key}: "{folder}" is a folder: name the file in it' in said
    (said,) = faults(PATHS[key].format('"a\\u0000b"'))
    assert "cannot be seen" in said
    for path in ("state.json", "run/gs 232", "/tmp/ü/☃", "~x", "...", ".hidden"):
        assert faults(PATHS[key].format(f'"{path}"')) == []


# --- the panel


@pytest.mark.parametrize("part", [{}, {"stop": 16}, {"jog": 2}, {"lamp_stop": 0}, {"azimuth_meter": 15}])
def test_every_part_of_a_panel_may_be_alone(part: dict[str, Any]) -> None:
    assert PanelTable(**part).fitted == bool(part)


def test_parts_by_the_names_that_panel_and_driver_give_them() -> None:
    panel = PanelTable(
        mode_msb=20, mode_lsb=21, stop=16, azimuth_knob=0, jog=2, azimuth_meter=0, lamp_stop=5, lamp_azimuth_pulse=6
    )
    assert panel.switches == {"mode_msb": 20, "mode_lsb": 21, "stop": 16}
    assert panel.inputs == {"azimuth_knob": 0, "jog": 2}
    assert panel.meters == {"azimuth": 0}
    assert panel.lamps == {"stop": 5, "azimuth_pulse": 6}
    assert {key.removeprefix("lamp_") for key in LAMPS} == set(PANEL_LAMPS)
    assert set(LimitsTable.model_fields) == set(LIMITS)
    assert LimitsTable(azimuth_low=5, elevation_high=6).switches == {"azimuth_low": 5, "elevation_high": 6}
