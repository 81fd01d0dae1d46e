"""`rotator calibrate` without a terminal: lines in, lines out, the file at the end."""

from __future__ import annotations

import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from hw.ports import Axis
from rotator.calibrating.results import AxisCalibrated, as_toml
from rotator.config.load import load, parse
from rotator.config.places import console_path
from rotator.exchange.status import Latch
from rotator.store.latch import KeptLatch
from rotator.store.state import State
from tests.refusing import refuse

LIMIT_S = 60.0
STATION = """# A fast one.
[elevation]
min_deg = 0                   # level
max_deg = 90

[sim.elevation]
speed_dps = 60
lag_s = 0.02
pot_noise_deg = 0.02
start_deg = 40

[sim.azimuth]
speed_dps = 60
start_deg = 200
"""
WHOLE = ["u 0.2", "y", "d 0.2", "d", "", "-2", "u", "", "92", "f", "", "", "y"]

Start = Callable[..., subprocess.Popen[str]]


@pytest.fixture
def station(tmp_path: Path) -> Path:
    path = tmp_path / "station.toml"
    path.write_text(STATION)
    return path


@pytest.fixture
def start(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Start]:
    running: list[subprocess.Popen[str]] = []

    def command(*arguments: str) -> subprocess.Popen[str]:
        process = subprocess.Popen(
            [sys.executable, "-m", "rotator", "calibrate", *arguments],
            cwd=tmp_path_factory.mktemp("calibrated"),
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        running.append(process)
        return process

    yield command
    for process in running:
        process.kill()
        process.wait()
        for stream in (process.stdin, process.stdout):
            assert stream is not None
            stream.close()


def finish(process: subprocess.Popen[str], *lines: str) -> tuple[str, int]:
    text, _ = process.communicate("".join(f"{line}\n" for line in lines), timeout=LIMIT_S)
    return text, process.returncode


def read_until(process: subprocess.Popen[str], words: str) -> str:
    assert process.stdout is not None
    text, until_s = "", time.monotonic() + LIMIT_S
    while words not in text:
        assert time.monotonic() < until_s
        line = process.stdout.readline()
        assert line, f"ended before it said {words!r}: {text}"
        text += line
    return text


def test_a_script_sets_an_axis_up(start: Start, station: Path) -> None:
    text, code = finish(start("--config", str(station), "elevation"), *WHOLE)
    assert code == 0, text
    assert text.startswith("SIMULATED")
    assert "Traceback" not in text
    elevation = load(station).elevation
    assert elevation.calibration == [(pytest.approx(0.03, abs=1e-3), -2.0), (pytest.approx(0.97, abs=1e-3), 92.0)]
    assert (elevation.min_deg, elevation.max_deg, elevation.direction_checked) == (0.0, 90.0, True)
    assert "# level" in station.read_text()
    assert station.with_name("station.toml.bak").read_text() == STATION


def test_the_end_of_the_input_is_the_end(start: Start, station: Path) -> None:
    text, code = finish(start("--config", str(station), "elevation"), "u 0.2", "y")
    assert code == 1
    assert "nothing is saved" in text
    assert station.read_text() == STATION


@pytest.mark.parametrize("signum", [signal.SIGINT, signal.SIGTERM])
def test_ctrl_c_while_it_turns(start: Start, station: Path, signum: int) -> None:
    process = start("--config", str(station), "azimuth")
    assert process.stdin is not None
    read_until(process, "> Press r")
    process.stdin.write("r\n")
    process.stdin.flush()
    process.send_signal(signum)
    text, _ = process.communicate(timeout=LIMIT_S)
    assert process.returncode == 1
    assert "the motors stand, nothing of the azimuth is saved" in text
    assert "Traceback" not in text
    assert [path.name for path in station.parent.iterdir()] == ["station.toml"]


def test_without_a_file_the_lines_for_one_are_shown() -> None:
    done = AxisCalibrated(Axis.ELEVATION, ((0.0312, -2.0), (0.97, 92.0)), 0.0, 90.0)
    elevation = parse(as_toml(done), "shown").elevation
    assert elevation.calibration == [(0.0312, -2.0), (0.97, 92.0)]
    assert elevation.direction_checked


def test_one_axis_after_the_other_each_saved_for_itself(start: Start, tmp_path: Path) -> None:
    path = tmp_path / "servos.toml"
    path.write_text('[rotor]\ntype = "servo"   # two of them\n[servo.azimuth]\nstart_deg = 90\nslew_dps = 180\n')
    text, code = finish(start("--config", str(path)), "r 1", "r 0.5", "y", "l 0.5", "5", "175", "y", "q")
    assert code == 1, text
    assert "Setting up the elevation." in text
    azimuth = load(path).azimuth
    assert (azimuth.min_deg, azimuth.max_deg, azimuth.direction_checked) == (5.0, 175.0, True)
    assert azimuth.calibration is None
    assert "# two of them" in path.read_text()


def test_not_beside_a_box_that_runs(start: Start, tmp_path: Path) -> None:
    monitor = tmp_path / "monitor"
    path = tmp_path / "station.toml"
    path.write_text(f'[rotor]\ntype = "moteus"\nhardware = "pi"\n[monitor]\npath = "{monitor}"\n')
    with socket.socket(socket.AF_UNIX) as box:
        box.bind(str(console_path(monitor)))
        box.listen()
        text, code = finish(start("--config", str(path)))
    assert code == 1
    assert "the box is running" in text
    assert "Traceback" not in text


def test_not_beside_a_simulated_box_with_the_same_file(start: Start, tmp_path: Path) -> None:
    path = kept_station(tmp_path)
    with socket.socket(socket.AF_UNIX) as box:
        box.bind(str(console_path(tmp_path / "monitor")))
        box.listen()
        text, code = finish(start("--config", str(path)))
    assert code == 1
    assert "a box runs already" in " ".join(text.split())


def kept_station(folder: Path) -> Path:
    path = folder / "station.toml"
    path.write_text(f'[state]\npath = "{folder / "state.json"}"\n[monitor]\npath = "{folder / "monitor"}"\n' + STATION)
    return path


@pytest.mark.parametrize("storm", [False, True])
def test_nothing_turns_after_a_stop_of_the_box_that_is_not_released(start: Start, tmp_path: Path, storm: bool) -> None:
    path = kept_station(tmp_path)
    KeptLatch(State(tmp_path / "state.json")).save(Latch("panel", storm=storm))
    for tasks in ([], ["north"]):
        text, code = finish(start("--config", str(path), *tasks))
        assert code == 1
        words = " ".join(text.split())
        assert f"{'storm park' if storm else 'stopped'} by the panel before the restart: " in words
        assert "Start it in a terminal: there it asks whether the mast is free of people" in words


def test_a_stop_during_a_calibration_holds_for_the_next_program(start: Start, tmp_path: Path) -> None:
    path = kept_station(tmp_path)
    process = start("--config", str(path), "azimuth")
    read_until(process, "> Press r")
    subprocess.run([sys.executable, "-m", "rotator", "stop", "--config", str(path)], check=True, timeout=LIMIT_S)
    process.communicate(timeout=LIMIT_S)
    stopped = KeptLatch(State(tmp_path / "state.json")).load()
    assert stopped is not None
    assert stopped.by.startswith("console")
    text, code = finish(start("--config", str(path), "azimuth"))
    assert code == 1
    assert "Start it in a terminal" in " ".join(text.split())


@pytest.fixture
def memory(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The service's folder in memory, for a calibration too."""
    folder = tmp_path / "memory"
    monkeypatch.setenv("RUNTIME_DIRECTORY", str(folder))
    return folder


def test_a_stop_that_is_ended_where_the_card_refuses_stays_ended(
    start_in_terminal: Callable[..., Any], tmp_path: Path, memory: Path
) -> None:
    path = kept_station(tmp_path)
    KeptLatch(State(tmp_path / "state.json")).save(Latch("keyboard"))
    refuse(tmp_path / "state.json")
    calibration = start_in_terminal("calibrate", "--config", path)
    calibration.until("Is the mast free of people, and shall the stop end")
    calibration.press("y\r")
    calibration.until("Setting up the azimuth")
    assert KeptLatch(State(tmp_path / "state.json", memory)).load() is None
    calibration.stop()


@pytest.mark.parametrize(("answer", "left"), [("y", False), ("n", True)])
def test_at_a_terminal_a_person_says_that_the_mast_is_free(
    start_in_terminal: Callable[..., Any], tmp_path: Path, answer: str, left: bool
) -> None:
    path = kept_station(tmp_path)
    KeptLatch(State(tmp_path / "state.json")).save(Latch("keyboard"))
    calibration = start_in_terminal("calibrate", "--config", path)
    asked = calibration.until("Is the mast free of people, and shall the stop end")
    assert "stopped by the keyboard before the restart: nothing moves until resume" in " ".join(asked.split())
    calibration.press(f"{answer}\r")
    calibration.until("Setting up the azimuth" if not left else "the stop stays: nothing was done")
    assert (KeptLatch(State(tmp_path / "state.json")).load() is not None) is left
    if left:
        calibration.ends()
    else:
        calibration.stop()  # a key may come before the keys are read
