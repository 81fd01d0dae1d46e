"""A machine as its builder has it, in real time: the shipped configuration, `rotator run` as a process, kept files.

Knows processes, ports and files, and reads the truth from the simulated world's own file. Knows no kind of rotor: what
a machine does in a day is in its test. Nothing here asks the box where the antenna is.
"""

from __future__ import annotations

import json
import os
import select
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import serial
import tomlkit

from firmware_sim import world_file
from firmware_sim.world_file import WorldState
from rotator.config.load import shipped
from tests.boxes import free_port

START_S = 60.0
"""A busy machine takes long to load the program."""
PATIENCE_S = 150.0
"""Longer than a turn at 6°/s, with a reversal and a busy machine."""
LOOK_S = 0.02
STILL_DEG = 0.02
"""An antenna that turned less than this between two looks, half a second apart, stands."""


def merge(into: Any, tables: Mapping[str, Any]) -> None:
    """Put the keys of nested tables into a document; other keys stay."""
    for key, value in tables.items():
        if isinstance(value, Mapping) and key in into:
            merge(into[key], value)
        else:
            into[key] = value


@dataclass
class Shack:
    """One machine: its folder, its configuration, and the program while it runs.

    `profile` is the name of a shipped configuration; `keys` are more keys of the file, as nested tables. Each link on
    a serial port gets a pseudo-terminal, each on TCP a free port.
    """

    folder: Path
    profile: str
    keys: Mapping[str, Any] = field(default_factory=dict)
    ptys: list[Path] = field(default_factory=list, init=False)
    ports: dict[str, int] = field(default_factory=dict, init=False)
    """The TCP port of each protocol."""
    greeting: bytes = b"SIMULATED"
    """What the box prints when it runs."""
    process: subprocess.Popen[bytes] | None = field(default=None, init=False)
    runs: int = field(default=0, init=False)

    def __post_init__(self) -> None:
        document = tomlkit.parse(shipped(self.profile))
        merge(document, {"rotor": {"hardware": "sim"}, "state": {"path": str(self.folder / "state.json")}})
        merge(document, {"sim": {"world": str(self.world_path)}, "monitor": {"path": str(self.folder / "monitor")}})
        merge(document, self.keys)
        links: Any = document["link"]
        for number, link in enumerate(links):
            if "serial" in link:
                del link["serial"]
                link.pop("baud", None)
                link["pty"] = str(self.folder / f"serial{number}")
                self.ptys.append(Path(link["pty"]))
            elif "pty" in link:
                # A relative path would be the same file for two machines at a time.
                link["pty"] = str(self.folder / Path(link["pty"]).name)
            elif "tcp" in link:
                self.ports[link["protocol"]] = free_port()
                link["tcp"] = f"127.0.0.1:{self.ports[link['protocol']]}"
        self.config_path.write_text(tomlkit.dumps(document), encoding="utf-8")

    @property
    def config_path(self) -> Path:
        return self.folder / "rotator.toml"

    @property
    def world_path(self) -> Path:
        return self.folder / "world.json"

    @property
    def log_path(self) -> Path:
        """What the present run printed and logged."""
        return self.folder / f"run{self.runs}.log"

    # --- the mast

    def turned_by_hand(self, azimuth_deg: float, elevation_deg: float) -> None:
        """While the program is off: put the antenna there, on the rotor's own scale."""
        assert self.process is None, "the program runs"
        seen = world_file.read(self.world_path)
        before = seen or WorldState(0.0, (0.0, 0.0), (0.0, 0.0), (0.0, 0.0), (0, 0), None, 0.0)
        place = (azimuth_deg, elevation_deg)
        world_file.write(self.world_path, replace(before, antenna_deg=place, shafts_deg=place, rests_deg=place))

    def power_cut(self) -> None:
        """While the program is off: everything loses its supply, the motors' controllers too."""
        assert self.process is None, "the program runs"
        world_file.write(self.world_path, replace(self.world(), parts={}))

    def world(self) -> WorldState:
        """The simulated world now, or as the last run left it."""
        state = world_file.read(self.world_path)
        assert state is not None, "there is no world yet"
        return state

    def until(self, met: Callable[[WorldState], bool], what: str, patience_s: float = PATIENCE_S) -> WorldState:
        """Look at the world until `met` holds. Fails with `what` when patience ends or the program does."""
        give_up_s = time.monotonic() + patience_s
        while not met(state := self.world()):
            assert self.process is None or self.process.poll() is None, f"the program ended: {self.log()}"
            assert time.monotonic() < give_up_s, f"not within {patience_s:g} s: {what}; {state}\n{self.log()}"
            time.sleep(LOOK_S)
        return state

    def stands(self, patience_s: float = PATIENCE_S) -> tuple[float, float]:
        """Wait until the antenna stands still for half a second of its own time. Returns where, in degrees."""
        before = self.world()

        def still(state: WorldState) -> bool:
            nonlocal before
            if state.at_s - before.at_s < 0.5:
                return False
            turned = max(abs(now - then) for now, then in zip(state.shafts_deg, before.shafts_deg, strict=True))
            before = state
            return turned < STILL_DEG and state.drives == (0, 0)

        return self.until(still, "the antenna stands", patience_s).antenna_deg

    def arrives(self, azimuth_deg: float, elevation_deg: float, within_deg: float) -> tuple[float, float]:
        """Wait until the antenna stands near that place. Returns where it stands, in degrees."""

        def near(state: WorldState) -> bool:
            return all(
                abs(at - to) <= within_deg
                for at, to in zip(state.antenna_deg, (azimuth_deg, elevation_deg), strict=True)
            )

        self.until(near, f"the antenna comes within {within_deg:g}° of {azimuth_deg:g}/{elevation_deg:g}")
        stood = self.stands()
        assert near(self.world()), f"it stands at {stood}, not near {azimuth_deg:g}/{elevation_deg:g}\n{self.log()}"
        return stood

    # --- the program

    def start(self, *arguments: str) -> None:
        """Start `rotator run` and wait until it says that it runs. Its terminal and its log go to a file."""
        assert self.process is None, "the program runs already"
        self.runs += 1
        command = [sys.executable, "-m", "rotator", "run", "--plain", "--config", str(self.config_path), *arguments]
        with self.log_path.open("wb") as log:
            self.process = subprocess.Popen(command, stdout=log, stderr=subprocess.STDOUT, start_new_session=True)
        give_up_s = time.monotonic() + START_S
        while self.greeting not in self.log_path.read_bytes():
            assert self.process.poll() is None, f"the program ended at once: {self.log()}"
            assert time.monotonic() < give_up_s, f"the box says nothing: {self.log()}"
            time.sleep(LOOK_S)

    def stop(self, signum: int = signal.SIGTERM) -> None:
        """End the program as the system or a person does. Judges its end: exit code 0, no traceback, nothing driven."""
        assert self.process is not None, "the program does not run"
        self.process.send_signal(signum)
        code = self.process.wait(timeout=START_S)
        self.process = None
        assert code == 0, f"exit code {code}\n{self.log()}"
        assert "Traceback" not in self.log(), self.log()
        assert self.world().drives == (0, 0), "a relay is on"
        assert self.world().shorted_s == 0.0, "both directions of a motor had current"
        assert self.world().brake_harm == (0.0, 0), "a brake and its motor worked against each other"

    def cut(self) -> None:
        """The program dies between two instructions, and everything that it started with it."""
        assert self.process is not None, "the program does not run"
        with suppress(ProcessLookupError):  # it has ended by itself: its exit code says why
            os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait()
        self.process = None

    def log(self) -> str:
        return self.log_path.read_text(encoding="utf-8", errors="replace") if self.runs else ""

    def faults(self) -> list[str]:
        """The lines of the present run that tell a fault."""
        return [line for line in self.log().splitlines() if "FAULT" in line or "ERROR" in line]

    def rotator(self, *words: str, check: bool = True) -> str:
        """Run another `rotator` command on this box, as a person in a second terminal. Returns what it prints."""
        command = [sys.executable, "-m", "rotator", words[0], "--config", str(self.config_path), *words[1:]]
        done = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE_S, check=False)
        assert not check or done.returncode == 0, f"{words}: {done.stdout}{done.stderr}\n{self.log()}"
        return done.stdout + done.stderr

    def close(self) -> None:
        if self.process is not None:
            self.cut()


class Terminal:
    """A program or a person on a serial port of the box: bytes out, bytes in."""

    def __init__(self, path: Path) -> None:
        self._port = serial.Serial(str(path), 9600, timeout=0)

    def send(self, text: str) -> None:
        self._port.write(text.encode("ascii"))

    def answer(self, end: str = "\n", patience_s: float = 10.0) -> str:
        """What the box sends, up to and with `end`; what has come so far when patience ends."""
        give_up_s, seen = time.monotonic() + patience_s, b""
        while not seen.endswith(end.encode("ascii")) and time.monotonic() < give_up_s:
            ready, _, _ = select.select([self._port.fileno()], [], [], 0.1)
            seen += self._port.read(1) if ready else b""
        return seen.decode("ascii", "replace")

    def close(self) -> None:
        self._port.close()


def fly(send: Callable[[float, float], None], points: Sequence[tuple[float, float]], every_s: float) -> None:
    """Send the points of a pass, one each `every_s` seconds of real time, as a tracking program does."""
    begun_s = time.monotonic()
    for number, (azimuth_deg, elevation_deg) in enumerate(points):
        time.sleep(max(0.0, begun_s + number * every_s - time.monotonic()))
        send(azimuth_deg, elevation_deg)


def standing(machine: Shack) -> list[str]:
    """What the file of the counts says of each axis."""
    path = Path(machine.folder, "counts.json")
    axes = json.loads(path.read_text())["axes"] if path.exists() else {}
    return [axes.get(axis, {}).get("standing", "never") for axis in ("azimuth", "elevation")]


def until_kept(machine: Shack) -> None:
    """Wait until the file has both angles: a rest is written as soon as the coast is over."""
    give_up_s = time.monotonic() + PATIENCE_S
    while standing(machine) != ["known", "known"]:
        assert time.monotonic() < give_up_s, standing(machine)
        time.sleep(0.1)
