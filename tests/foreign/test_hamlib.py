"""Debian's Hamlib drives the box, as any program that uses Hamlib does: set, read, stop, move."""

from __future__ import annotations

import subprocess
import time
from collections.abc import Callable
from pathlib import Path

import pytest

Start = Callable[..., "RunningBox"]  # noqa: F821 - a fixture's type
TOLERANCE_DEG = 4.5
"""What the box promises, and half a degree for whole-degree replies."""
PATIENCE_S = 60.0
"""How long to go on asking whether the antenna has arrived: each question is a rotctl of its own."""


@pytest.fixture
def rotctl(need_program: Callable[[str, str], str]) -> Callable[..., str]:
    program = need_program("rotctl", "libhamlib-utils")

    def run(model: int, where: Path | str, *words: str) -> str:
        done = subprocess.run(
            [program, "-m", str(model), "-r", str(where), *words],
            capture_output=True,
            text=True,
            timeout=30,
            check=False,
        )
        assert done.returncode == 0, f"rotctl {words}: {done.stdout}{done.stderr}"
        return done.stdout

    return run


def position(output: str) -> tuple[float, float]:
    azimuth, elevation = output.split()
    return float(azimuth), float(elevation)


def arrive(rotctl: Callable[..., str], model: int, where: Path | str, goal: tuple[float, float]) -> None:
    """Ask again and again, as a tracking program does, until the antenna is where it was sent."""
    seen = (float("nan"), float("nan"))
    give_up_s = time.monotonic() + PATIENCE_S
    while time.monotonic() < give_up_s:
        seen = position(rotctl(model, where, "p"))
        if all(abs(at - to) <= TOLERANCE_DEG for at, to in zip(seen, goal, strict=True)):
            return
    pytest.fail(f"the antenna stands at {seen}, not at {goal}")


@pytest.mark.parametrize(("model", "dialect"), [(601, "gs232a"), (602, "gs232a"), (603, "gs232b")])
@pytest.mark.parametrize("over", ["pty", "tcp"])
def test_set_read_and_stop(start_box: Start, rotctl: Callable[..., str], model: int, dialect: str, over: str) -> None:
    box = start_box(dialect)
    where = box.pty if over == "pty" else f"127.0.0.1:{box.gs232_port}"
    assert position(rotctl(model, where, "p")) == (0, 0)
    rotctl(model, where, "P", "75", "25")
    arrive(rotctl, model, where, (75, 25))
    rotctl(model, where, "P", "440", "25")
    rotctl(model, where, "S")
    stopped = position(rotctl(model, where, "p"))
    assert stopped[0] < 430
    assert position(rotctl(model, where, "p")) == pytest.approx(stopped, abs=2)
    assert box.stop() == 0


@pytest.mark.parametrize(("model", "dialect"), [(601, "gs232a"), (603, "gs232b")])
def test_move(start_box: Start, rotctl: Callable[..., str], model: int, dialect: str) -> None:
    """M 16: clockwise, M 2: up; both until stopped, here by the end of the range."""
    box = start_box(dialect)
    rotctl(model, box.pty, "M", "16", "-1")
    rotctl(model, box.pty, "M", "2", "100")
    arrive(rotctl, model, box.pty, (450, 180))
    rotctl(model, box.pty, "M", "8", "-1")
    rotctl(model, box.pty, "M", "4", "-1")
    rotctl(model, box.pty, "S")
    azimuth_deg, elevation_deg = position(rotctl(model, box.pty, "p"))
    assert 0 <= azimuth_deg <= 450
    assert 0 <= elevation_deg <= 180


def test_model_2_reads_the_limits_and_parks(start_box: Start, rotctl: Callable[..., str]) -> None:
    box = start_box()
    where = f"127.0.0.1:{box.rotctld_port}"
    # Refused by the client itself unless dump_state told it 450 degrees.
    rotctl(2, where, "P", "400", "20")
    arrive(rotctl, 2, where, (400, 20))
    rotctl(2, where, "S")
    rotctl(2, where, "K")
    arrive(rotctl, 2, where, (0, 0))
    assert "gs232-rotator" in rotctl(2, where, "_")


def test_a_stop_on_one_link_silences_the_stream_on_another(start_box: Start, rotctl: Callable[..., str]) -> None:
    box = start_box()
    tcp = f"127.0.0.1:{box.rotctld_port}"
    rotctl(603, box.pty, "P", "90", "20")
    arrive(rotctl, 603, box.pty, (90, 20))
    rotctl(2, tcp, "S")
    stopped = position(rotctl(603, box.pty, "p"))
    rotctl(603, box.pty, "P", "200", "20")
    assert position(rotctl(603, box.pty, "p")) == pytest.approx(stopped, abs=1)
    rotctl(2, tcp, "P", "120", "20")
    arrive(rotctl, 2, tcp, (120, 20))
