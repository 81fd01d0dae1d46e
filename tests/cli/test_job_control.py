"""A shell's jobs: a box behind the prompt (`rotator run &`) runs, and Ctrl-Z leaves a box in front of it running."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

StartInTerminal = Callable[..., Any]
CTRL_Z = "\x1a"
SHELL = """
import fcntl, os, sys, termios
fcntl.ioctl(0, termios.TIOCSCTTY, 0)
job = os.fork()
if not job:
    os.setpgid(0, 0)
    os.execv(sys.argv[1], sys.argv[1:])
_, ended = os.waitpid(job, os.WUNTRACED)
if os.WIFSTOPPED(ended):
    print("Stopped", os.WSTOPSIG(ended), flush=True)
    os.kill(job, 9)
sys.exit(ended)
"""
"""What a shell does for `COMMAND &`, as far as the kernel sees it; then it waits."""


@pytest.mark.parametrize("words", [("run",), ("run", "--plain")], ids=" ".join)
def test_behind_the_prompt_a_box_runs_and_leaves_the_terminal_alone(
    start_in_terminal: StartInTerminal, config: Path, words: tuple[str, ...], rotator: Callable[..., Any]
) -> None:
    box = start_in_terminal(*words, "--config", config, launcher=SHELL)
    said = box.until("azimuth 0°")
    assert "SIMULATED" in said
    assert "keys:" not in said
    assert box.modes() == box.modes_before
    assert rotator("where", "--config", config).returncode == 0
    (job,) = Path(f"/proc/{box.process.pid}/task/{box.process.pid}/children").read_text().split()
    os.kill(int(job), signal.SIGTERM)
    assert box.ends() == 0
    assert box.modes() == box.modes_before


def test_ctrl_z_leaves_a_box_running(start_in_terminal: StartInTerminal, config: Path) -> None:
    box = start_in_terminal("run", "--config", config)
    box.frame()
    for _ in range(3):
        box.press(CTRL_Z)
        box.frame()
        box.frame()
    assert box.stop() == 0
    assert box.modes() == box.modes_before


def test_ctrl_z_leaves_a_calibration_running(start_in_terminal: StartInTerminal, config: Path) -> None:
    guide = start_in_terminal("calibrate", "azimuth", "--config", config)
    guide.until(r"Press r \(clockwise\)")
    guide.press(CTRL_Z + "zz")
    guide.until("means nothing here")
    guide.press("q")
    assert guide.ends() == 1
