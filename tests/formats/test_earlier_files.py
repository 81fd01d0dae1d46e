"""Files of every format that was ever handed out, read by the program of today: no person has to calibrate twice.

The folder 1 holds files as version 0.1.0 wrote them. They never change; a new format gets a folder of its own beside.
"""

from __future__ import annotations

import logging
import shutil
from pathlib import Path

import pytest

from hw.ports import Axis
from rotator.assembly.kept_files import build_learnt
from rotator.config.load import load
from rotator.config.model import Config
from rotator.config.save import save_table
from rotator.exchange.motor import Motor, Trust
from rotator.exchange.status import Latch
from rotator.store.compass import CompassFile
from rotator.store.counts import CountsFile, Place, Standing
from rotator.store.knobs import KnobsFile
from rotator.store.latch import LatchFile
from rotator.store.relays import RelaysFile

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
FIRST = Path(__file__).parent / "1"
CONFIGURATIONS = sorted(FIRST.glob("*.toml"))


@pytest.fixture(autouse=True)
def _without_a_warning(caplog: pytest.LogCaptureFixture) -> None:
    caplog.set_level(logging.INFO)


def config_of(name: str, folder: Path) -> Config:
    """A configuration of then, with its state in `folder`."""
    text = (FIRST / f"{name}.toml").read_text(encoding="utf-8")
    (folder / "rotator.toml").write_text(text.replace("/var/lib/rotator", str(folder)), encoding="utf-8")
    return load(folder / "rotator.toml")


@pytest.mark.parametrize("path", CONFIGURATIONS, ids=lambda path: path.stem)
def test_a_configuration_of_then_is_taken(path: Path) -> None:
    assert load(path).link


def test_it_means_today_what_it_meant_then() -> None:
    config = load(FIRST / "station.toml")
    assert config.azimuth.calibration == [(0.0512, -1.5), (0.4, 200), (0.9491, 451.25)]
    assert (config.azimuth.min_deg, config.azimuth.max_deg, config.azimuth.tolerance_deg) == (0, 450, 3)
    assert config.azimuth.direction_checked
    assert config.elevation.direction_checked
    assert config.mount.flip == "off"
    assert (config.mount.park_azimuth_deg, config.mount.park_elevation_deg) == (180, 0)
    assert [(sector.name, sector.azimuth_deg) for sector in config.mount.forbidden] == [("the chimney", (80, 100))]
    serial, tcp = config.link
    assert (serial.protocol, serial.serial, serial.ack) == ("gs232b", "/dev/ttyGS0", "cr")
    assert (tcp.protocol, tcp.tcp, tcp.allow) == ("rotctld", "0.0.0.0:4533", ["192.0.2.0/24"])


def test_a_calibration_is_saved_into_it_and_the_rest_stays(tmp_path: Path) -> None:
    mine = Path(shutil.copy(FIRST / "station.toml", tmp_path))
    save_table(mine, "azimuth", calibration=((0.05, 0.0), (0.95, 450.0)))
    assert load(mine).azimuth.calibration == [(0.05, 0), (0.95, 450)]
    assert "# the chimney" in mine.read_text(encoding="utf-8")
    assert (tmp_path / "station.toml.bak").read_bytes() == (FIRST / "station.toml").read_bytes()


def test_what_the_motors_taught_is_believed(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    """Figures count only with the settings that they were learnt with: those are in the file too."""
    shutil.copy(FIRST / "g5500-state.json", tmp_path / "state.json")
    learnt = build_learnt(config_of("g5500", tmp_path)).load()
    assert learnt[AZ] == (Motor(5.81, 0.92), Motor(6.1, 1.0))
    assert learnt[EL] == (Motor(2.6, 0.3), Motor(2.8, 0.25))
    assert not caplog.records


def test_a_count_is_believed(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    path = Path(shutil.copy(FIRST / "u100-counts.json", tmp_path))
    file = CountsFile(path, config_of("u100", tmp_path).pulses.cams((AZ, EL)))
    assert file.load() == {AZ: Place(Standing.KNOWN, 123.456), EL: Place(Standing.LOST)}
    assert not caplog.records


def test_a_relay_in_doubt_stays_in_doubt(caplog: pytest.LogCaptureFixture) -> None:
    known = RelaysFile(FIRST / "relays.json").load()
    assert known == {AZ: (Trust.OPEN, Trust.WELDED), EL: (Trust.OPEN, Trust.OPEN)}
    assert not caplog.records


def test_a_storm_park_of_then_still_holds_the_antenna(caplog: pytest.LogCaptureFixture) -> None:
    assert LatchFile(FIRST / "latch.json").load() == Latch("console#3 before the restart", storm=True)
    assert not caplog.records


def test_knobs_and_compass_keep_what_they_learnt(caplog: pytest.LogCaptureFixture) -> None:
    assert KnobsFile(FIRST / "knobs.json").load() == {AZ: 0.9731, EL: 0.5}
    assert CompassFile(FIRST / "compass.json").load() == bytes(range(22))
    assert not caplog.records
