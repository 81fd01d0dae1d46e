"""Hostile bytes for as long as you like: run `python -m benchmarks.fuzz --minutes 10`.

Two boxes run as a user starts them, with every protocol that TCP or UDP carries and a pseudo-terminal. Clients come and
go, send good, damaged and random bytes in random pieces, read or do not, leave politely or not. On the first box every
link is read_only, so whatever is sent the antenna must not move by a tenth of a degree. On the second one orders count:
it must stay within its range, and stop when told. Both must answer a good question on every link all along, log no
mistake of ours, and not grow. What is found is printed with the seed.
"""

from __future__ import annotations

import argparse
import asyncio
import os
import random
import signal
import socket
import subprocess
import sys
import tempfile
import time
import tty
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

FRAME = "57 00 00 00 00 00 00 00 00 00 00 %s 20"
GS232: tuple[bytes, ...] = (
    b"C2\r",
    b"W235 025\r",
    b"M100\r",
    b"R\r",
    b"U\r",
    b"S\r",
    b"P45\r",
    b"Z\r",
    b"O\r",
    b"F2\r",
    b"H3\r",
)
GS232 += (b"W010 100 020 110 030\r", b"T\r", b"N\r", b"X4\r", b"M005 010 020 030\r")
EASYCOMM: tuple[bytes, ...] = (
    b"AZ EL \n",
    b"AZ235.5 EL25.0\n",
    b"SA SE \n",
    b"ML\n",
    b"VU0900\n",
    b"PARK\n",
    b"RESET\n",
    b"GS\nGE\nVE\n",
)
ROTCTLD: tuple[bytes, ...] = (
    b"p\n",
    b"P 235.00 25.00\n",
    b"+\\set_pos 14 7\n",
    b";p\n",
    b"S\n",
    b"M CW 50\n",
    b"K\n",
    b"R 1\n",
)
ROTCTLD += (
    b"\\dump_state\n",
    b"C max_az 540\n",
    b"V SPEED 2\n",
    b"L -70.5 42.3 6\n",
    b"w C2\n",
    b"1\n",
    b"B 1 2 3 4\n",
)
DCU1: tuple[bytes, ...] = (b"AI1;", b"AP1235;AM1;", b"AP1235.0\r;", b"BI1;", b";", b"AS1;")
STATUS = bytes.fromhex(FRAME % "1F")
SPID: tuple[bytes, ...] = (STATUS, bytes.fromhex(FRAME % "0F"), bytes.fromhex("57 31 31 39 30 02 30 37 37 30 02 2F 20"))
SPID += (
    bytes.fromhex("57 02 00 00 00 00 00 00 00 00 00 14 20"),
    bytes.fromhex("57 35 39 35 30 0A 33 38 35 30 0A 2F 20"),
)
STRANGERS = (
    b"GET / HTTP/1.1\r\nHost: x\r\n\r\n",
    b"\xff\xfd\x01\xff\xfb\x03",
    "W235 025\r".encode("utf-16"),
    b"\0" * 64,
)

SPOKEN: dict[str, tuple[tuple[bytes, ...], bytes, bytes]] = {
    "gs232a": (GS232, b"\r\rC2\r", b"+0"),
    "gs232b": (GS232, b"\r\rC2\r", b"AZ="),
    "easycomm1": (EASYCOMM, b"\nAZ EL \n", b"AZ"),
    "easycomm2": (EASYCOMM, b"\nAZ EL \n", b"AZ"),
    "easycomm3": (EASYCOMM, b"\nAZ EL \n", b"AZ"),
    "rotctld": (ROTCTLD, b"\np\n", b"."),
    "dcu1": (DCU1, b"\rAI1;", b";"),
    "rot1prog": (SPID, STATUS, b"W"),
    "rot2prog": (SPID, STATUS, b"W"),
    "md01": (SPID, STATUS, b"W"),
}
"""What each protocol says; a good question, and what is in its answer."""
DATAGRAMS: dict[str, tuple[bytes, ...]] = {
    "pstrotator": (
        b"<PST><AZIMUTH>235.0</AZIMUTH><ELEVATION>25.0</ELEVATION></PST>",
        b"<PST>AZ?</PST><PST>EL?</PST>",
        b"<PST><STOP>1</STOP></PST>",
        b"<PST><PARK>1</PARK></PST>",
    ),
    "n1mm": (
        b"<N1MMRotor><rotor>x</rotor><goazi>55.0</goazi><offset>0.0</offset></N1MMRotor>",
        b"<N1MMRotor><stop><rotor>x</rotor><freqband>21.0</freqband></stop></N1MMRotor>",
    ),
    "macdoppler": (b"00000001 mac [AzEl Rotor Report:Azimuth:39.00, Elevation:0.00, SatName:XW-2C]",),
}
"""What comes by UDP; the last of them has nothing but orders, and is no link to be read_only."""
ALL = tuple(piece for pieces, _, _ in SPOKEN.values() for piece in pieces) + STRANGERS
CLIENTS = 6
"""At a time on each box."""
PATIENCE_S = 20.0
STILL_DEG, BEYOND_DEG = 0.1, 3.0
TOP_AZIMUTH_DEG, TOP_ELEVATION_DEG = 450, 180

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
            self.ports[protocol] = _free_port()
            text += f'[[link]]\nprotocol = "{protocol}"\ntcp = "127.0.0.1:{self.ports[protocol]}"\n{right}'
        for protocol in DATAGRAMS:
            if not (self.read_only and protocol == "macdoppler"):
                self.udp_ports[protocol] = _free_port(socket.SOCK_DGRAM)
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


def _free_port(kind: socket.SocketKind = socket.SOCK_STREAM) -> int:
    with socket.socket(type=kind) as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


def nasty(chance: random.Random, pieces: tuple[bytes, ...]) -> bytes:
    """Good bytes, damaged ones, another protocol's, or none of anybody's."""
    match chance.randrange(10):
        case 0:
            return chance.randbytes(chance.randrange(1, 300))
        case 1:
            return chance.choice(ALL)
        case 2:
            return chance.choice(pieces) * chance.randrange(1, 200)
        case 3:
            return bytes([chance.randrange(256)]) * chance.randrange(1, 40_000)
        case 4 | 5:
            return b"".join(chance.choices(pieces, k=chance.randrange(1, 6)))
    data = bytearray(b"".join(chance.choices(pieces, k=chance.randrange(1, 4))))
    for _ in range(chance.randrange(1, 5)):
        at = chance.randrange(len(data) + 1)
        match chance.randrange(4):
            case 0:
                data[at : at + 1] = bytes([chance.randrange(256)])
            case 1:
                del data[at : at + chance.randrange(1, 4)]
            case 2:
                data[at:at] = chance.choice((b" ", b"9", b"-", b".", b",", b"\0", b"\r", b"\n", b"W", b";"))
            case 3:
                data[at:at] = data[: chance.randrange(len(data) + 1)]
    return bytes(data)


async def client(box: Box, chance: random.Random, until_s: float) -> None:
    """Comes, talks and goes, again and again."""
    while time.monotonic() < until_s:
        protocol = chance.choice(tuple(box.ports))
        pieces = SPOKEN[protocol][0] if protocol in SPOKEN else (b"W235 025\r", b"W100 -10\n", b"W1")
        with suppress(OSError, TimeoutError):
            async with asyncio.timeout(PATIENCE_S):
                reader, writer = await asyncio.open_connection("127.0.0.1", box.ports[protocol])
                box.clients += 1
                reads = chance.random() < 0.8
                try:
                    for _ in range(chance.randrange(1, 30)):
                        data = nasty(chance, pieces)
                        step = chance.choice((1, 3, 7, 64, 100_000)) if len(data) < 400 else 100_000
                        for start in range(0, len(data), step):
                            if not writer.transport.is_closing():
                                writer.write(data[start : start + step])
                            await asyncio.sleep(0)
                        box.sent += len(data)
                        if writer.transport.is_closing():
                            break
                        if reads:
                            with suppress(TimeoutError):
                                async with asyncio.timeout(0.02):
                                    await reader.read(65_536)
                        await asyncio.sleep(chance.random() * 0.02)
                finally:
                    writer.transport.abort() if chance.random() < 0.5 else writer.close()


async def terminal(box: Box, chance: random.Random, until_s: float) -> None:
    """The same through the pseudo-terminal, opened and closed."""
    while time.monotonic() < until_s:
        fd = os.open(box.pty, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
        try:
            tty.setraw(fd)
            for _ in range(chance.randrange(1, 30)):
                data = nasty(chance, GS232)[:2000]
                with suppress(BlockingIOError):
                    box.sent += os.write(fd, data)
                if chance.random() < 0.8:
                    with suppress(BlockingIOError):
                        os.read(fd, 65_536)
                await asyncio.sleep(chance.random() * 0.05)
        finally:
            os.close(fd)


async def datagrams(box: Box, chance: random.Random, until_s: float) -> None:
    """The same by UDP, from addresses that come and go."""
    while time.monotonic() < until_s:
        protocol = chance.choice(tuple(box.udp_ports))
        with socket.socket(type=socket.SOCK_DGRAM) as sender:
            sender.setblocking(False)
            sender.bind((f"127.0.0.{chance.randrange(1, 100)}", 0))
            for _ in range(chance.randrange(1, 30)):
                data = nasty(chance, DATAGRAMS[protocol])
                with suppress(OSError):
                    box.sent += sender.sendto(data, ("127.0.0.1", box.udp_ports[protocol]))
                await asyncio.sleep(chance.random() * 0.02)


async def watch(box: Box, until_s: float) -> list[str]:
    """What is wrong, as soon as something is."""
    name = "read-only box" if box.read_only else "box"
    while time.monotonic() < until_s:
        assert box.process is not None
        if box.process.poll() is not None:
            return [f"{name}: ended with exit code {box.process.returncode}"]
        for protocol, (_, question, has) in SPOKEN.items():
            if await box.ask(protocol, question, has) is None:
                return [f"{name}: no right answer to {question!r} on {protocol}"]
            box.answered += 1
        where = await box.position()
        if where is None:
            return [f"{name}: no position"]
        azimuth_deg, elevation_deg = where
        if box.read_only and max(abs(azimuth_deg - 235), abs(elevation_deg - 25)) > STILL_DEG:
            return [f"{name}: moved to {where}"]
        low, high_az, high_el = -BEYOND_DEG, TOP_AZIMUTH_DEG + BEYOND_DEG, TOP_ELEVATION_DEG + BEYOND_DEG
        if not (low <= azimuth_deg <= high_az and low <= elevation_deg <= high_el):
            return [f"{name}: out of its range, at {where}"]
        box.sizes_kib.append(box.resident_kib())
        await asyncio.sleep(0.5)
    return []


async def stops(box: Box) -> list[str]:
    """Nobody sends any more: a stop, and it stands."""
    await box.ask("rotctld", b"\nS\n", b"RPRT")
    async with asyncio.timeout(PATIENCE_S):
        while b"MOVING" in (await box.ask("rotctld", b"\ns\n", b"\n") or b"MOVING"):
            await asyncio.sleep(0.05)
    before = await box.position()
    await asyncio.sleep(1.0)
    after = await box.position()
    still = before and after and max(abs(a - b) for a, b in zip(before, after, strict=True)) <= STILL_DEG
    return [] if still else [f"turns after a stop: from {before} to {after}"]


async def fuzz(minutes: float, seed: int) -> list[str]:
    with tempfile.TemporaryDirectory() as folder:
        boxes = [Box(read_only, Path(folder) / str(read_only)) for read_only in (True, False)]
        try:
            for box in boxes:
                box.folder.mkdir()
                await box.start()
            until_s = time.monotonic() + 60 * minutes
            async with asyncio.TaskGroup() as group:
                watchers = [group.create_task(watch(box, until_s)) for box in boxes]
                for number, box in enumerate(boxes):
                    for each in range(CLIENTS):
                        group.create_task(client(box, random.Random(f"{seed} {number} {each}"), until_s))
                    group.create_task(terminal(box, random.Random(f"{seed} {number}"), until_s))
                    group.create_task(datagrams(box, random.Random(f"{seed} {number} udp"), until_s))
            found = [each for watcher in watchers for each in watcher.result()]
            for box in boxes:
                found += await stops(box)
        finally:
            for box in boxes:
                if box.process is not None and (code := box.stop()):
                    found = [f"exit code {code}"]
        for box in boxes:
            found += _told(box)
        return found


def _told(box: Box) -> list[str]:
    """Print what was done to a box; returns what its log should not have."""
    log = box.log.read_text(errors="replace").splitlines()
    early, end = box.sizes_kib[len(box.sizes_kib) // 10], box.sizes_kib[-1]
    print(
        f"{'read-only' if box.read_only else 'obeying':>9}: {box.clients} connections, {box.sent / 1e6:.1f} MB, "
        f"{box.answered} good questions answered, {len(log)} log lines, resident {early} kB early, {end} kB at the end"
    )
    late = [line for line in log if " E FAULT" in line and "late:" in line]
    if late:
        print(f"{'':>9}  it stopped {len(late)} axes because it got no turn on a machine this busy, as it should")
    bad = [line for line in log if "protocol failed" in line or "Traceback" in line or " E " in line]
    bad = [line for line in bad if line not in late]
    return [f"log: {line}" for line in dict.fromkeys(bad)] + (
        [f"grew from {early} to {end} kB"] if end > 2 * early else []
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else "")
    parser.add_argument("--minutes", type=float, default=10.0)
    parser.add_argument("--seed", type=int, default=random.SystemRandom().randrange(1 << 31))
    given = parser.parse_args()
    print(f"seed {given.seed}")
    found = asyncio.run(fuzz(given.minutes, given.seed))
    print("\n".join(found) or "nothing found")
    sys.exit(bool(found))


if __name__ == "__main__":
    main()
