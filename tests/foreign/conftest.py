"""The box as a user starts it: a process of its own, with a configuration file, on a fast simulated rotor."""

from __future__ import annotations

import contextlib
import select
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

from tests.boxes import FAST_ROTOR, free_port, greets

START_S = 20.0


@dataclass(frozen=True, slots=True)
class RunningBox:
    process: subprocess.Popen[str]
    pty: Path
    gs232_port: int
    rotctld_port: int

    def stop(self, signum: int = signal.SIGINT) -> int:
        """Its exit code."""
        self.process.send_signal(signum)
        return self.process.wait(timeout=START_S)


@pytest.fixture
def start_box(tmp_path: Path) -> Iterator[Callable[..., RunningBox]]:
    boxes: list[subprocess.Popen[str]] = []

    def start(dialect: str = "gs232b", extra: str = FAST_ROTOR, links: str = "") -> RunningBox:
        pty, gs232_port, rotctld_port = tmp_path / "gs232", free_port(), free_port()
        config = tmp_path / "rotator.toml"
        config.write_text(
            f'{extra}\n[state]\npath = "{tmp_path / "state.json"}"\n[[link]]\nprotocol = "{dialect}"\npty = "{pty}"\n'
            f'[[link]]\nname = "tcp"\nprotocol = "{dialect}"\ntcp = "127.0.0.1:{gs232_port}"\n'
            f'[[link]]\nprotocol = "rotctld"\ntcp = "127.0.0.1:{rotctld_port}"\n{links}'
        )
        process = subprocess.Popen(
            [sys.executable, "-m", "rotator", "run", "--plain", "--config", str(config)],
            stdout=subprocess.PIPE,
            text=True,
        )
        boxes.append(process)
        assert process.stdout is not None
        ready, _, _ = select.select([process.stdout], [], [], START_S)
        assert ready, "the box says nothing"
        assert greets(process.stdout)
        return RunningBox(process, pty, gs232_port, rotctld_port)

    yield start
    for process in boxes:
        with contextlib.suppress(ProcessLookupError):
            process.kill()
        process.wait()
        if process.stdout is not None:
            process.stdout.close()
