"""A box under fire: `rotator run` as a user starts it, with every protocol on a port of its own.

Knows how to start it, to ask it where it is, and to end it. Sends nothing hostile.
"""

from __future__ import annotations

import asyncio
import signal
import socket
import subprocess
import sys
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

from benchmarks.fuzz_words import DATAGRAMS, SPOKEN

PATIENCE_S = 20.0
ROTOR = """
[sim.{axis}]
speed_dps = {speed}
lag_s = 0.02
pot_noise_deg = 0
backlash_deg = 0
start_deg = {start}
[{axis}]
speed_dps = {speed}
coast_s = 0.04
"""


@dataclass
class Box:
    """A box under fire."""

    read_only: bool
    folder: Path
    ports: dict[str, int] = field(default_factory=dict)
    udp_ports: dict[str, int] = field(default_factory=dict)
    process: subprocess.Popen[bytes] | None = None
    sizes_kib: list[int] = field(default_factory=list)
    sent: int = 0
    clients: int = 0
    answered: int = 0

    @property
    def log(self) -> Path:
        return self.folder / "log.txt"

    @property
    def pty(self) -> Path:
        return self.folder / "gs232"

    async def start(self) -> None:
        text = ROTOR.format(axis="azimuth", speed=60, start=235) + ROTOR.format(axis="elevation", speed=60, start=25)
        text += f'[state]\npath = "{self.folder}/state.json"\n'
        right = f"read_only = {str(self.read_only).lower()}\n"
        for protocol in (*SPOKEN, "gs232-f1efw"):
            self.ports[protocol] = free_port()
            text += f'[[link]]\nprotocol = "{protocol}"\ntcp = "127.0.0.1:{self.ports[protocol]}"\n{right}'
        for protocol in DATAGRAMS:
            if not (self.read_only and protocol == "macdoppler"):
                self.udp_ports[protocol] = free_port(socket.SOCK_DGRAM)
                text += f'[[link]]\nprotocol = "{protocol}"\nudp = "127.0.0.1:{self.udp_ports[protocol]}"\n{right}'
        text += f'[[link]]\nname = "pty"\nprotocol = "gs232b"\npty = "{self.pty}"\n{right}'
        config = self.folder / "rotator.toml"
        config.write_text(text)
        with self.log.open("wb") as log:
            self.process = subprocess.Popen(
                [sys.executable, "-m", "rotator", "run", "--plain", "--config", str(config)], stdout=log, stderr=log
            )
        async with asyncio.timeout(PATIENCE_S):
            while not self.pty.exists() or not await self.position():
                await asyncio.sleep(0.2)

    async def position(self) -> tuple[float, float] | None:
        answer = await self.ask("rotctld", b"\np\n", b".")
        with suppress(ValueError, AttributeError):
            azimuth, elevation = (answer or b"").split()
            return float(azimuth), float(elevation)
        return None

    async def ask(self, protocol: str, question: bytes, has: bytes) -> bytes | None:
        """The answer on a fresh connection; None: there is none, or not a right one."""
        try:
            async with asyncio.timeout(PATIENCE_S):
                reader, writer = await asyncio.open_connection("127.0.0.1", self.ports[protocol])
                try:
                    writer.write(question)
                    answer = b""
                    while has not in answer:
                        data = await reader.read(4096)
                        if not data:
                            return None
                        answer += data
                    return answer
                finally:
                    writer.transport.abort()
        except (OSError, TimeoutError):
            return None

    def resident_kib(self) -> int:
        assert self.process is not None
        status = Path(f"/proc/{self.process.pid}/status").read_text()
        return next(int(line.split()[1]) for line in status.splitlines() if line.startswith("VmRSS:"))

    def stop(self) -> int:
        assert self.process is not None
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGTERM)
        return self.process.wait(PATIENCE_S)


def free_port(kind: socket.SocketKind = socket.SOCK_STREAM) -> int:
    with socket.socket(type=kind) as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])
