"""Each shipped configuration of a rotor without pots, simulated, in a process of its own, driven by Debian's rotctl."""

from __future__ import annotations

import contextlib
import re
import select
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

from rotator.config.load import shipped
from tests.boxes import free_port, greets

START_S = 20.0
PATIENCE_S = 60.0
NEAR_DEG = 4.5
"""The coarsest tolerance of them, and half a degree for whole-degree replies."""
GOALS = {"u100": (14.0, 0.0), "isel": (40.0, 30.0), "servos": (120.0, 70.0), "orbit360": (168.0, 0.0)}
STARTS = {"orbit360": 180.0, "isel": 10.0}
"""Where the simulated azimuth begins, where that is not 0: there the file takes it to stand; at 0 a motor whose encoder
knows one turn asks a person whether that is 0 or 360."""


@dataclass(frozen=True, slots=True)
class RunningRotor:
    process: subprocess.Popen[str]
    rotctld: str
    pty: Path


@pytest.fixture
def start(tmp_path: Path) -> Iterator[Callable[[str], RunningRotor]]:
    processes: list[subprocess.Popen[str]] = []

    def run(profile: str) -> RunningRotor:
        config, pty, place = tmp_path / "rotator.toml", tmp_path / "serial", f"127.0.0.1:{free_port()}"
        text = shipped(profile).replace('hardware = "pi"', 'hardware = "sim"')
        text = text.replace("127.0.0.1:4533", place).replace("/var/lib/rotator", str(tmp_path))
        text = re.sub(r'serial = "/dev/ttyGS0".*\nbaud = 9600\n', f'pty = "{pty}"\n', text)
        config.write_text(f"{text}\n[sim.azimuth]\nstart_deg = {STARTS.get(profile, 0.0)}\n", encoding="utf-8")
        command = [sys.executable, "-m", "rotator", "run", "--plain", "--config", str(config)]
        process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        processes.append(process)
        assert process.stdout is not None
        ready, _, _ = select.select([process.stdout], [], [], START_S)
        assert ready, "the box says nothing"
        assert greets(process.stdout)
        return RunningRotor(process, place, pty)

    yield run
    for process in processes:
        with contextlib.suppress(ProcessLookupError):
            process.kill()
        process.wait()
        if process.stdout is not None:
            process.stdout.close()


@pytest.fixture
def rotctl(need_program: Callable[[str, str], str]) -> Callable[..., str]:
    program = need_program("rotctl", "libhamlib-utils")

    def run(model: int, where: str, *words: str) -> str:
        command = [program, "-m", str(model), "-r", where, *words]
        done = subprocess.run(command, capture_output=True, text=True, timeout=30, check=False)
        assert done.returncode == 0, f"rotctl {words}: {done.stdout}{done.stderr}"
        return done.stdout

    return run


@dataclass(frozen=True, slots=True)
class Asker:
    """rotctl with its model and its line."""

    rotctl: Callable[..., str]
    model: int
    where: str

    def say(self, *words: str) -> None:
        self.rotctl(self.model, self.where, *words)

    def position(self) -> tuple[float, float]:
        azimuth, elevation = self.rotctl(self.model, self.where, "p").split()
        return float(azimuth), float(elevation)

    def until(self, met: Callable[[tuple[float, float]], bool]) -> tuple[float, float]:
        """Ask again and again, as a tracking program does."""
        give_up_s = time.monotonic() + PATIENCE_S
        while not met(seen := self.position()):
            assert time.monotonic() < give_up_s, f"it never came: the antenna stands at {seen}"
        return seen

    def arrive(self, goal: tuple[float, float]) -> None:
        """Order again and again, as a tracking program does: a box with a panel obeys once it believes its switch."""

        def near(seen: tuple[float, float]) -> bool:
            if all(abs(at - to) <= NEAR_DEG for at, to in zip(seen, goal, strict=True)):
                return True
            self.say("P", *map(str, goal))
            return False

        self.until(near)

    def rest(self) -> tuple[float, float]:
        """Until two answers in a row agree; of a rotor that turns they would not."""
        before = [(float("nan"), float("nan"))]

        def stands(seen: tuple[float, float]) -> bool:
            same = seen == pytest.approx(before[0], abs=0.3)
            before[0] = seen
            return same

        return self.until(stands)


@pytest.mark.parametrize("profile", GOALS)
def test_hamlib_points_reads_parks_and_stops_it(
    start: Callable[[str], RunningRotor], rotctl: Callable[..., str], profile: str
) -> None:
    rotor = start(profile)
    asker = Asker(rotctl, 2, rotor.rotctld)
    asker.say("P", *map(str, GOALS[profile]))
    asker.arrive(GOALS[profile])
    asker.say("K")
    asker.until(lambda seen: abs(seen[0] - GOALS[profile][0]) > 1.0)
    asker.say("S")
    stood = asker.rest()
    asker.say("P", *map(str, GOALS[profile]))
    asker.say("S")
    assert asker.rest()[0] == pytest.approx(stood[0], abs=25.0)
    end_it(rotor)


def test_as_a_gs_232_on_its_serial_line(start: Callable[[str], RunningRotor], rotctl: Callable[..., str]) -> None:
    rotor = start("isel")
    asker = Asker(rotctl, 603, str(rotor.pty))
    asker.say("P", "40", "30")
    asker.arrive((40.0, 30.0))
    asker.say("P", "300", "30")
    asker.say("S")
    assert asker.rest()[0] < 200.0
    end_it(rotor)


def end_it(rotor: RunningRotor) -> None:
    """Ctrl-C, as a person ends it."""
    rotor.process.send_signal(signal.SIGINT)
    assert rotor.process.wait(timeout=START_S) == 0
