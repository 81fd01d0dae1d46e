"""The compass reader: the real driver on a simulated chip, in simulated time and with its own thread."""

from __future__ import annotations

import threading
import time
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import pytest

from firmware_sim.clock import SimClock
from firmware_sim.rotors.rotor import SimRotor
from firmware_sim.rotors.servo import ServoAxisSpec, SimServoRotor
from hw.ports import HardwareError
from rotator.assembly.buses import Board
from rotator.assembly.calibration import open_compass
from rotator.calibrating.compass import CompassReader
from rotator.config.load import parse
from rotator.store.state import State

CONFIG = parse('[compass]\nkind = "bno055"\naddress = 0x29\n', "test")


def fitted(clock: Any, sleep: Any, corrections: State | None = None) -> tuple[CompassReader, SimRotor]:
    """A boom at 40°, raised by 20°, with a compass on it."""
    world = SimServoRotor(ServoAxisSpec(0, 40.0), ServoAxisSpec(1, 20.0), clock)
    world.wire_bno055((3, 0x29), lambda azimuth_deg: azimuth_deg)
    board = Board(world, ExitStack(), clock, sleep)
    return CompassReader(open_compass(CONFIG, board), clock, corrections), world


def test_it_reads_the_heading_and_the_calibration() -> None:
    clock = SimClock()
    reader, _ = fitted(clock, clock.sleep)
    reader.read()
    clock.sleep(20.0)
    reader.read()
    seen = reader.latest
    assert seen is not None
    assert seen.problem == ""
    assert seen.heading_deg == pytest.approx(40.0, abs=2.0)
    assert seen.tilt_deg == pytest.approx(20.0, abs=0.1)
    assert seen.calibration.complete
    assert str(seen.calibration) == "system 3, gyroscope 3, accelerometer 3, magnetometer 3 of 3"


def test_a_missing_compass_is_a_problem_until_it_answers_again() -> None:
    clock = SimClock()
    reader, world = fitted(clock, clock.sleep)
    world.inject("compass-gone")
    reader.read()
    assert reader.latest is not None
    assert "0x29" in reader.latest.problem
    world.clear("compass-gone")
    reader.read()
    assert reader.latest.problem == ""


def test_corrections_that_cannot_be_read_are_not_saved(tmp_path: Path) -> None:
    clock = SimClock()
    reader, world = fitted(clock, clock.sleep, State(tmp_path / "state.json"))
    reader.read()
    world.inject("compass-gone")
    reader.save_wanted.set()
    reader.read()
    assert not reader.save_wanted.is_set()
    assert "Not kept: " in reader.messages.pop()
    assert not list(tmp_path.iterdir())


def test_where_the_corrections_cannot_be_written_a_person_is_told_so(tmp_path: Path) -> None:
    clock = SimClock()
    path = tmp_path / "no folder" / "state.json"
    path.parent.write_text("")  # a file where its folder should be: not even root writes there
    reader, _ = fitted(clock, clock.sleep, State(path))
    clock.sleep(1.0)
    reader.save_wanted.set()
    while reader.save_wanted.is_set():
        reader.read()
        clock.sleep(1.0)
    assert reader.messages.pop().startswith(f"   {path}: what the compass learnt cannot be kept: ")


def test_its_thread_reads_until_it_is_stopped() -> None:
    read_once = threading.Event()
    reader, _ = fitted(time.monotonic, lambda seconds: read_once.set())
    reader.start()
    assert read_once.wait(10.0)
    reader.stop()


def test_a_file_without_a_compass() -> None:
    clock = SimClock()
    with pytest.raises(HardwareError, match=r"\[compass\] kind = \"bno055\" \(rotator help sensors\)"):
        open_compass(
            parse("", "test"),
            Board(SimServoRotor(ServoAxisSpec(0), ServoAxisSpec(1), clock), ExitStack(), clock, clock.sleep),
        )
