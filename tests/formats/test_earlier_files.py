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
from rotator.config.save import save_tables
from rotator.exchange.faults import FaultKind
from rotator.exchange.motor import Motor, Tries, Trust
from rotator.exchange.status import Latch
from rotator.store.counts import CountsFile, Place, Standing
from rotator.store.latch import DAMAGED, LATCH, KeptLatch
from rotator.store.learnt import COMPASS, KNOBS
from rotator.store.priorities import Priorities
from rotator.store.relays import RELAYS, KeptRelays
from rotator.store.state import EARLIER, State
from rotator.store.tries import KeptTries
from tests.tables import every_row

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


@every_row("path", CONFIGURATIONS)
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
    save_tables(mine, {"azimuth": {"calibration": ((0.05, 0.0), (0.95, 450.0))}})
    assert load(mine).azimuth.calibration == [(0.05, 0), (0.95, 450)]
    assert "# the chimney" in mine.read_text(encoding="utf-8")
    assert (tmp_path / "station.toml.bak").read_bytes() == (FIRST / "station.toml").read_bytes()


def test_a_count_is_believed(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    path = Path(shutil.copy(FIRST / "u100-counts.json", tmp_path))
    file = CountsFile(path, config_of("u100", tmp_path).kind.cams((AZ, EL)))
    assert file.load() == {AZ: Place(Standing.KNOWN, 123.456), EL: Place(Standing.LOST)}
    assert not caplog.records


# --- version 0.1.0 had a file for each thing that the box remembers; the state file had the motors alone


TRIED = """{"format": "rotator tries 1", "axes": {"azimuth": {"settings": {}, "faults": 2, "kind": "END_STOP",
"stood_deg": [445.9, null], "stops_deg": [445.9, null], "pressed": true, "driven": false}}}"""
PRIORITIES = '{"format": "rotator priorities 1", "changed": {"ISS": {"priority": 3.0, "written": 1.0}}}'


def eight_files(folder: Path) -> Path:
    """The folder of a box of then. Returns the path of its state file."""
    shutil.copy(FIRST / "g5500-state.json", folder / "state.json")
    shutil.copy(FIRST / "u100-counts.json", folder / "counts.json")
    for name in ("latch", "relays", "knobs", "compass"):
        shutil.copy(FIRST / f"{name}.json", folder)
    (folder / "tries.json").write_text(TRIED)
    (folder / "priorities.json").write_text(PRIORITIES)
    return folder / "state.json"


def assert_all_is_known(state: State, folder: Path) -> None:
    learnt = build_learnt(config_of("g5500", folder), state).load()
    assert learnt[AZ] == (Motor(5.81, 0.92), Motor(6.1, 1.0))
    assert learnt[EL] == (Motor(2.6, 0.3), Motor(2.8, 0.25))
    assert KeptRelays(state).load() == {AZ: (Trust.OPEN, Trust.WELDED), EL: (Trust.OPEN, Trust.OPEN)}
    assert KeptLatch(state).load() == Latch("console#3 before the restart", storm=True)
    assert KeptTries(state).load()[AZ] == Tries(2, FaultKind.END_STOP, (445.9, None), (445.9, None), pressed=True)
    assert state.load(KNOBS) == {AZ: 0.9731, EL: 0.5}
    assert state.load(COMPASS) == bytes(range(22))
    assert Priorities(state).of("ISS", 1.0) == 3.0


def test_the_files_of_then_are_read_once_and_are_one_file_after_that(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    path = eight_files(tmp_path)
    before = {each.name for each in tmp_path.iterdir()}
    state = State(path)
    assert_all_is_known(state, tmp_path)
    assert {each.name for each in tmp_path.iterdir()} - {"rotator.toml"} == before, "who only reads changes nothing"
    assert state.save()
    assert {each.name for each in tmp_path.iterdir()} - {"rotator.toml"} == {"state.json", "counts.json"}
    assert_all_is_known(State(path), tmp_path)
    assert not caplog.records


@pytest.mark.parametrize("name", EARLIER)
def test_a_damaged_file_of_then_is_its_own_damage(tmp_path: Path, name: str) -> None:
    path = eight_files(tmp_path)
    (tmp_path / f"{name}.json").write_bytes(b"\0" * 40)
    state = State(path)
    assert state.sections[name] == {}
    assert sum(content == {} for content in state.sections.values()) == 1
    assert state.save()
    kept = KeptLatch(State(path)).load()
    assert kept == (DAMAGED if name == "latch" else Latch("console#3 before the restart", storm=True))


def test_what_a_refusing_card_had_left_in_memory_then_is_newer(tmp_path: Path) -> None:
    path, memory = eight_files(tmp_path), tmp_path / "memory"
    memory.mkdir()
    (memory / "latch.json").write_text('{"format": "rotator latch 1", "by": "", "storm": false}')
    state = State(path, memory)
    assert state.load(LATCH) is None
    assert state.save()
    assert State(path).load(LATCH) is None
    assert not list(memory.iterdir())


def test_a_step_back_and_forth_between_versions_knows_the_latest_stop(tmp_path: Path) -> None:
    path = eight_files(tmp_path)
    state = State(path)
    state.keep(LATCH, None)
    shutil.copy(FIRST / "latch.json", tmp_path)  # version 0.1.0 has run again, and was stopped
    again = State(path)
    assert again.load(LATCH) == Latch("console#3", storm=True)
    assert again.load(RELAYS)[AZ] == (Trust.OPEN, Trust.WELDED)
    assert again.save()
    assert State(path).load(LATCH) == Latch("console#3", storm=True)
    assert not (tmp_path / "latch.json").exists()


def test_a_file_of_then_that_cannot_be_removed_would_count_again_and_is_said(tmp_path: Path) -> None:
    path = eight_files(tmp_path)
    state = State(path)
    (tmp_path / "latch.json").unlink()
    (tmp_path / "latch.json").mkdir()
    assert not state.save()
    assert "latch.json" in state.trouble or "directory" in state.trouble
    (tmp_path / "latch.json").rmdir()
    assert state.save()
    assert state.trouble == ""
