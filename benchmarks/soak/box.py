"""The soaked box: `rotator run` in a terminal, with every protocol, a panel, a display, and the world's own file.

Knows how to start it, what it holds (memory, files, threads), what is true in its world, and how to end it.
"""

from __future__ import annotations

import asyncio
import json
import os
import signal
import subprocess
import sys
import tty
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

from benchmarks.fuzz_box import PATIENCE_S, free_port
from benchmarks.soak.words import LATITUDE_DEG, LONGITUDE_DEG, WORDS, Words
from firmware_sim import world_file
from firmware_sim.world_file import WorldState
from rotator.protocols.pstrotator import ANSWERS_ABOVE

CONFIG = f"""
[station]
latitude_deg = {LATITUDE_DEG}
longitude_deg = {LONGITUDE_DEG}
[sim.azimuth]
start_deg = 200
[lcd]
kind = "pcf8574"
[panel]
azimuth_knob = 0
elevation_knob = 1
jog = 2
reference = 3
mode_msb = 10
mode_lsb = 9
calibrate = 11
stop = 19
azimuth_meter = 0
elevation_meter = 1
lamp_auto = 4
lamp_data = 6
lamp_motor = 7
lamp_stop = 8
"""


@dataclass(frozen=True, slots=True)
class Held:
    """What the process holds while nobody gives an order."""

    at_s: float
    """Since the start of the soak."""
    private_kib: int
    """Memory that is the process's own: private pages, by the kernel's account."""
    blocks: int
    """Blocks of Python's own memory, after a garbage collection."""
    tasks: int
    files: int
    """Open file descriptors."""
    threads: tuple[str, ...]

    @property
    def own_threads(self) -> tuple[str, ...]:
        """Without asyncio's worker threads, of which there are as many as were needed at a time; six at most."""
        return tuple(name for name in self.threads if not name.startswith("asyncio_"))


@dataclass
class Box:
    folder: Path
    ports: dict[str, int] = field(default_factory=dict)
    """By protocol; TCP and UDP."""
    process: subprocess.Popen[bytes] | None = None
    serial: int = -1
    """Our end of the line whose other end is the box's serial port."""
    terminal: int = -1
    """Our end of the terminal in which the box runs."""

    def place(self, protocol: str) -> Path:
        """The path of a pseudo-terminal or of a file."""
        return self.folder / protocol

    @property
    def log(self) -> Path:
        return self.folder / "log.txt"

    @property
    def monitor(self) -> Path:
        return self.folder / "monitor"

    @property
    def console(self) -> Path:
        return self.folder / "console"

    def world(self) -> WorldState:
        state = world_file.read(self.folder / "world.json")
        assert state is not None, "the box has no world"
        return state

    def start(self) -> None:
        self.serial, line = os.openpty()
        tty.setraw(line)
        for words in WORDS:
            self.ports[words.protocol] = free_port()
        text = f'[state]\npath = "{self.folder}/state.json"\n[sim]\nworld = "{self.folder}/world.json"\n' + CONFIG
        text += "".join(self._link(words, os.ttyname(line)) for words in WORDS)
        config = self.folder / "rotator.toml"
        config.write_text(text)
        self.terminal, screen = os.openpty()
        command = [sys.executable, "-m", "benchmarks.soak.inside", str(self.folder / "probe"), str(self.log)]
        self.process = subprocess.Popen(
            [*command, "run", "--config", str(config)],
            stdin=screen,
            stdout=screen,
            stderr=screen,
            start_new_session=True,
        )
        os.close(screen)
        os.set_blocking(self.terminal, False)
        os.set_blocking(self.serial, False)

    def _link(self, words: Words, line: str) -> str:
        port = self.ports[words.protocol]
        match words.place:
            case "serial":
                where = line
            case "pty" | "file":
                where = str(self.place(words.protocol))
            case _:
                where = f"127.0.0.1:{port}"
        keys = words.keys
        if words.protocol == "n1mm":
            keys += f'status_to = "127.0.0.1:{port + ANSWERS_ABOVE}"\n'
        return f'[[link]]\nprotocol = "{words.protocol}"\n{words.place} = "{where}"\n{keys}'

    async def holds(self, at_s: float) -> Held:
        """Raises OSError, TimeoutError: the box does not answer."""
        assert self.process is not None
        async with asyncio.timeout(PATIENCE_S):
            reader, writer = await asyncio.open_unix_connection(str(self.folder / "probe"))
            try:
                said = json.loads(await reader.readline())
            finally:
                writer.close()
        place = Path(f"/proc/{self.process.pid}")
        rollup = [line.split() for line in (place / "smaps_rollup").read_text().splitlines()]
        private_kib = sum(int(words[1]) for words in rollup if words[0].startswith("Private_"))
        files = len(os.listdir(place / "fd"))
        return Held(at_s, private_kib, said["blocks"], said["tasks"], files, tuple(said["threads"]))

    async def says(self, *lines: str) -> str:
        """The console's answers to these lines. Raises OSError, TimeoutError."""
        answers = ""
        async with asyncio.timeout(PATIENCE_S):
            reader, writer = await asyncio.open_unix_connection(str(self.console))
            try:
                for line in lines:
                    writer.write(f"{line}\n".encode())
                    while not (answer := (await reader.readline()).decode()).startswith(("ok", "error")) and answer:
                        answers += answer
                    answers += answer
            finally:
                writer.close()
        return answers

    async def stop(self) -> int:
        """As the system ends it. Returns its exit code."""
        assert self.process is not None
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGTERM)
        code = await asyncio.to_thread(self.process.wait, PATIENCE_S)
        for fd in (self.serial, self.terminal):
            with suppress(OSError):
                os.close(fd)
        return code
