"""`rotator arduino`: the box's forerunner on a serial port of its own, for a user to compare."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

Start = Callable[..., Any]


@pytest.fixture
def slow_enough(tmp_path: Path) -> Path:
    """The sketch looks ten times a second and has no idea of coasting: much faster, and it would hunt."""
    path = tmp_path / "station.toml"
    path.write_text("[sim.azimuth]\nspeed_dps = 30\n[sim.elevation]\nspeed_dps = 30\n")
    return path


def test_it_moves_to_where_it_is_sent_and_answers_nothing(start: Start, slow_enough: Path, tmp_path: Path) -> None:
    uno = start("arduino", "--config", slow_enough, "--pty", tmp_path / "run" / "uno")
    uno.until(r"F1EFW sketch on an emulated UNO: \S*/run/uno \(ready\)\n")
    uno.until("SAT A:000 E:000.*ANT A:000 E:000")
    line = os.open(tmp_path / "run" / "uno", os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
    try:
        os.write(line, b"C2\rW235 025\r")
        uno.until("SAT A:235 E:025.*ANT A:0[3-9]")
        uno.until("SAT A:235 E:025.*ANT A:2[23]. E:02")
        with pytest.raises(BlockingIOError):
            os.read(line, 1)
    finally:
        os.close(line)
    assert uno.stop() == 0
    assert uno.errors == ""


@pytest.mark.parametrize("signum", [signal.SIGINT, signal.SIGTERM], ids=lambda signum: signum.name)
def test_a_signal_ends_it(start: Start, tmp_path: Path, signum: int) -> None:
    uno = start("arduino", "--pty", tmp_path / "uno")
    uno.until("ANT A:000")
    assert uno.stop(signum) == 0
    assert not (tmp_path / "uno").is_symlink()


def test_a_port_that_is_somebody_s_file(rotator: Start, tmp_path: Path) -> None:
    (tmp_path / "uno").write_text("mine\n")
    done = rotator("arduino", "--pty", tmp_path / "uno")
    assert done.returncode == 1
    assert done.stderr.startswith(f"rotator: {tmp_path}/uno: there is a file already, where pty makes a port: move it")
