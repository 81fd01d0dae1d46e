"""The program of today and a file that a later version wrote, after a step back: it says so, and leaves the file alone.

And a format that changes: each step brings a file on by one number.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
import tomlkit
from click.testing import CliRunner
from tomlkit import TOMLDocument

from hw.ports import Axis
from rotator.config import migrations
from rotator.config.load import ConfigError, load
from rotator.config.save import save_tables
from rotator.store.counts import LOST, CountsFile
from rotator.store.json_file import Form, JsonFile, decode

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
CAMS = {axis: {"spacing_deg": 5.0} for axis in Axis}


@pytest.fixture
def later(tmp_path: Path) -> Path:
    return tmp_path / "later.json"


def write_later(path: Path, name: str) -> bytes:
    path.write_text(f'{{"format": "rotator {name} 2", "what": ["only", "the", "later", "version", "knows"]}}')
    return path.read_bytes()


def assert_told(caplog: pytest.LogCaptureFixture, path: Path) -> None:
    told = [record.getMessage() for record in caplog.records]
    assert told[0].startswith(f"{path}: ")
    assert "a later version of the program wrote it" in told[0]
    assert "update the program, or move the file away. The file stays as it is" in told[0]


def test_a_count_is_lost_and_the_axis_can_be_homed(later: Path, caplog: pytest.LogCaptureFixture) -> None:
    before = write_later(later, "counts")
    file = CountsFile(later, CAMS)
    assert file.load() == {AZ: LOST, EL: LOST}
    assert file.start(AZ), "an axis without a known angle may move: else it could not be homed"
    file.home(AZ, 0.0)
    file.close()
    assert "a later version" in file.trouble
    assert later.read_bytes() == before
    assert_told(caplog, later)


# --- the configuration


LATER_STATION = """# Mine.
format = 2

[azimuth]
min = 0                       # a key that only the later version knows
"""


def test_a_later_configuration_is_refused_in_one_sentence(tmp_path: Path) -> None:
    from rotator.cli.main import cli

    path = tmp_path / "rotator.toml"
    path.write_text(LATER_STATION)
    with pytest.raises(ConfigError) as refused:
        load(path)
    assert [mistake.text for mistake in refused.value.mistakes] == [
        "format = 2: a later version of the program wrote this file, and this one reads formats up to 1: "
        "update the program, or take the file from before the update (.bak)"
    ]
    with pytest.raises(ConfigError, match="a later version"):
        save_tables(path, {"azimuth": {"direction_checked": True}})
    assert isinstance(CliRunner().invoke(cli, ["run", "--config", str(path)]).exception, ConfigError)
    assert path.read_text() == LATER_STATION
    assert [each.name for each in tmp_path.iterdir()] == ["rotator.toml"]


@pytest.mark.parametrize("wrong", ['"one"', "1.5", "true", "0", "-1", "[1]"])
def test_a_wrong_number_is_a_fault_of_its_own(tmp_path: Path, wrong: str) -> None:
    path = tmp_path / "rotator.toml"
    path.write_text(f"format = {wrong}\n")
    with pytest.raises(ConfigError, match="must be a whole number from 1 to 1; a file without it is of format 1"):
        load(path)


def test_the_number_of_today_may_stand_there(tmp_path: Path) -> None:
    path = tmp_path / "rotator.toml"
    path.write_text("format = 1\n\n[azimuth]\nmax_deg = 360\n")
    assert load(path).azimuth.max_deg == 360
    save_tables(path, {"azimuth": {"direction_checked": True}})
    assert path.read_text().startswith("format = 1\n")


# --- steps


def renames(document: TOMLDocument) -> None:
    table = document["azimuth"]
    assert isinstance(table, dict)
    table["lowest_deg"] = table.pop("min_deg")


def doubles(document: TOMLDocument) -> None:
    table = document["azimuth"]
    assert isinstance(table, dict)
    table["lowest_deg"] *= 2


OLD = """# My station.
[azimuth]                     # a G-5500
min_deg = 4                   # north
"""


def test_each_step_is_made_once_and_comments_stay() -> None:
    assert migrations.values(OLD, (renames, doubles)) == {"azimuth": {"lowest_deg": 8}}
    text = migrations.brought_up(OLD, (renames, doubles))
    assert text.startswith("format = 3\n")
    assert "# My station." in text
    assert "# a G-5500" in text
    assert migrations.brought_up(text, (renames, doubles)) == text
    second = migrations.brought_up(OLD, (renames,))
    assert tomlkit.parse(second)["format"] == 2
    assert migrations.values(second, (renames, doubles)) == {"azimuth": {"lowest_deg": 8}}


def in_tenths(content: dict[str, Any]) -> dict[str, Any]:
    return content | {"angle": content["angle"] * 10}


def under_axes(content: dict[str, Any]) -> dict[str, Any]:
    return {"axes": {"azimuth": content["angle"]}}


def test_a_state_file_is_brought_up_too_and_written_in_the_form_of_today(tmp_path: Path) -> None:
    form = Form("rotator test", (in_tenths, under_axes))
    assert form.today == "rotator test 3"
    for text in ('{"format": "rotator test 1", "angle": 5}', '{"format": "rotator test 2", "angle": 50}'):
        assert decode(form, text, lambda content: content["axes"]) == {"azimuth": 50}
    with pytest.raises(ValueError, match="the key angle is missing"):
        decode(form, '{"format": "rotator test 1"}', dict)
    path = tmp_path / "test.json"
    file = JsonFile(path, form, "a test")
    path.write_text('{"format": "rotator test 1", "angle": 5}')
    axes: dict[str, int] = file.load(lambda content: content["axes"], absent={}, damaged={}, consequence="ignored")
    assert file.save({"axes": axes})
    assert '"format": "rotator test 3"' in path.read_text()
