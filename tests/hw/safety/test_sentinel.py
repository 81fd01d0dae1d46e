"""The program's side of the sentinel, with a real process behind it that finds a gpiod of this test's in its path.

Its life beside the box, on real lines, is tried on a real kernel (tests/kernel).
"""

from __future__ import annotations

import asyncio
import os
import signal
import subprocess
import sys
import threading
from pathlib import Path

import pytest

from hw.ports import HardwareError
from hw.safety.lines_off import RelayLines
from hw.safety.sentinel import OOM_SCORE, Sentinel
from rotator.runtime.engine import ANSWER_EVERY_S, MOST_MISSED, sentinel_fails

MINUTES_OF_RENEWALS = 5 * 60 * 20
"""Renewals in five minutes of motion, at 20 Hz."""
LINES = RelayLines("/dev/gpiochip0", {"azimuth_cw": 22}, active_low=False)
GPIOD = """
import os
from contextlib import nullcontext
from enum import Enum
from types import SimpleNamespace

line = SimpleNamespace(
    Value=Enum("Value", "ACTIVE INACTIVE"), Direction=Enum("Direction", "INPUT OUTPUT"), Bias=None, Edge=None
)
LineSettings = dict

def Chip(path):
    return nullcontext()

def request_lines(path, **_):
    open(os.environ["SWITCHED_OFF"], "w").close()
    return SimpleNamespace(release=lambda: None)
"""


@pytest.fixture
def switched_off(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The file that is there when the sentinel has taken the lines with their off level."""
    (tmp_path / "gpiod.py").write_text(GPIOD)
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join((str(tmp_path), os.environ.get("PYTHONPATH", ""))))
    monkeypatch.setenv("SWITCHED_OFF", str(tmp_path / "off"))
    return tmp_path / "off"


def left_behind() -> tuple[list[str], str]:
    """The open files of this process, and its children."""
    children = Path(f"/proc/self/task/{threading.get_native_id()}/children")
    return os.listdir("/proc/self/fd"), children.read_text()


@pytest.mark.usefixtures("switched_off")
def test_ended_it_leaves_no_process_and_no_file_behind() -> None:
    before = left_behind()
    sentinel = Sentinel(LINES)
    assert os.getsid(sentinel.pid) == sentinel.pid, "Ctrl-C in the terminal is for the program alone"
    sentinel.dismiss()
    sentinel.close()
    assert left_behind() == before


@pytest.mark.parametrize("sent", [signal.SIGTERM, signal.SIGINT, signal.SIGHUP, signal.SIGQUIT])
def test_a_signal_to_the_whole_service_does_not_end_it_before_its_work_is_done(
    switched_off: Path, sent: signal.Signals
) -> None:
    sentinel = Sentinel(LINES)
    sentinel.renew()
    os.kill(sentinel.pid, sent)
    sentinel.renew()
    assert not switched_off.exists()
    sentinel.close()
    assert switched_off.exists()


@pytest.mark.usefixtures("switched_off")
def test_when_memory_runs_out_the_program_goes_first() -> None:
    sentinel = Sentinel(LINES)
    sentinel.dismiss()
    sentinel.close()
    assert int(Path("/proc/self/oom_score_adj").read_text()) >= OOM_SCORE


def test_closed_without_a_dismissal_it_switches_the_lines_off(switched_off: Path) -> None:
    sentinel = Sentinel(LINES)
    sentinel.renew()
    sentinel.close()
    assert switched_off.exists()


def motors_run_for_minutes(sentinel: Sentinel) -> None:
    for _ in range(MINUTES_OF_RENEWALS):
        sentinel.renew()


def test_a_sentinel_that_no_longer_reads_lets_no_relay_close(switched_off: Path) -> None:
    sentinel = Sentinel(LINES)
    os.kill(sentinel.pid, signal.SIGSTOP)
    try:
        with pytest.raises(HardwareError, match=f"process {sentinel.pid}. is gone or stuck"):
            motors_run_for_minutes(sentinel)
    finally:
        os.kill(sentinel.pid, signal.SIGCONT)
        sentinel.close()
    assert switched_off.exists(), "it goes on, and finds the end of the pipe"


@pytest.mark.quiet
def test_a_sentinel_that_is_stopped_is_noticed_within_seconds(switched_off: Path) -> None:
    """Also while no relay is on. The box then ends, as when its sentinel has died."""
    sentinel = Sentinel(LINES)

    async def the_box_runs(*, stopped: bool) -> None:
        async with asyncio.timeout(ANSWER_EVERY_S * (MOST_MISSED + 4)):
            watched = asyncio.create_task(sentinel_fails(sentinel))
            while watched in (await asyncio.wait([watched], timeout=ANSWER_EVERY_S))[1] and not stopped:
                pass
            await watched

    with pytest.raises(TimeoutError):
        asyncio.run(the_box_runs(stopped=False))
    os.kill(sentinel.pid, signal.SIGSTOP)
    try:
        with pytest.raises(HardwareError, match=f"process {sentinel.pid}. does not answer"):
            asyncio.run(the_box_runs(stopped=True))
    finally:
        os.kill(sentinel.pid, signal.SIGCONT)
        sentinel.close()
    assert switched_off.exists()


def test_a_sentinel_that_is_killed_is_noticed_at_once(switched_off: Path) -> None:
    sentinel = Sentinel(LINES)
    os.kill(sentinel.pid, signal.SIGKILL)
    with pytest.raises(HardwareError, match=f"process {sentinel.pid}. has ended"):
        asyncio.run(sentinel_fails(sentinel))
    sentinel.close()
    assert not switched_off.exists()


def locked_kib(pid: int | str) -> int:
    status = Path(f"/proc/{pid}/status").read_text()
    return int(next(line.split()[1] for line in status.splitlines() if line.startswith("VmLck:")))


LOCK_ALL = "import ctypes; raise SystemExit(ctypes.CDLL(None).mlockall(3) != 0)"


@pytest.mark.usefixtures("switched_off")
def test_it_is_locked_in_memory_where_it_may_be() -> None:
    """A program that swaps must not take its sentinel with it."""
    if subprocess.run([sys.executable, "-c", LOCK_ALL], check=False).returncode:
        pytest.skip("this user may not lock memory")
    sentinel = Sentinel(LINES)
    locked = locked_kib(sentinel.pid)
    sentinel.dismiss()
    sentinel.close()
    assert locked > 0


NO_CHIP = (
    GPIOD
    + """
def Chip(path):
    raise FileNotFoundError(2, "No such file or directory", path)
"""
)


@pytest.mark.parametrize("gpiod", ["", NO_CHIP], ids=["no gpiod", "no chip"])
def test_where_it_does_not_start_nothing_is_left(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, gpiod: str) -> None:
    (tmp_path / "gpiod.py").write_text(gpiod)
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join((str(tmp_path), os.environ.get("PYTHONPATH", ""))))
    before = left_behind()
    with pytest.raises(HardwareError, match="does not start"):
        Sentinel(LINES)
    assert left_behind() == before


def test_what_it_cannot_do_is_a_sentence() -> None:
    done = subprocess.run(
        [sys.executable, "-P", "-m", "hw.safety.sentinel_process", "nonsense"],
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stderr) == (1, "sentinel: not a description of relay lines: 'nonsense'\n")
