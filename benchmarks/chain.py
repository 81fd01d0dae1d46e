"""Two boxes in a chain: how soon a STOP on the first opens the relays of the second. Run `python -m benchmarks.chain`.

The second box turns a simulated G-5500 and speaks a protocol; the first has it as its controller, over TCP, or over a
serial line whose bytes take their time at 9600 baud. Both are processes as a user starts them. STOP is `S` on the first
box's rotctld link. Prints a Markdown table in milliseconds.
"""

from __future__ import annotations

import argparse
import asyncio
import os
import socket
import subprocess
import sys
import tempfile
import threading
import time
import tty
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

import tomlkit

from benchmarks.running.box import Box
from benchmarks.running.words import Words
from tests.boxes import free_port

PROTOCOLS = ("rotctld", "gs232a", "gs232b", "easycomm2", "easycomm3", "rot2prog", "md01", "rot1prog", "dcu1")
AZIMUTH_ONLY = ("rot1prog", "dcu1")
BYTE_S = 10 / 9600
FAR, MOVES_S, RESTS_S, READY_S = "P 300 90", 1.5, 2.5, 60.0


def slowly(source: int, target: int) -> None:
    """Carry bytes as a line of 9600 baud does, until a box ends."""
    with suppress(OSError):
        while data := os.read(source, 64):
            for octet in data:
                due_s = time.monotonic() + BYTE_S
                while time.monotonic() < due_s:
                    time.sleep(max(0.0, due_s - time.monotonic()))
                os.write(target, bytes([octet]))


def cable(far: Path) -> str:
    """A serial line from here to the second box's pseudo-terminal. Returns the name of this end."""
    near, line = os.openpty()
    tty.setraw(line)
    other = os.open(far, os.O_RDWR | os.O_NOCTTY)
    tty.setraw(other)
    for ends in ((near, other), (other, near)):
        threading.Thread(target=slowly, args=ends, daemon=True).start()
    return os.ttyname(line)


@contextmanager
def first_box(folder: Path, protocol: str, place: dict[str, str]) -> Iterator[int]:
    """The box in front. Yields the port of its rotctld link."""
    folder.mkdir()
    port = free_port()
    axis = {"min_deg": 0, "direction_checked": True}
    tables = {
        "rotor": {"type": "controller", "hardware": "pi"},
        "controller": {"protocol": protocol, "baud": 9600, **place},
        "azimuth": {**axis, "max_deg": 360},
        "elevation": {"fitted": False} if protocol in AZIMUTH_ONLY else {**axis, "max_deg": 180},
        "lcd": {"kind": "none"},
        "state": {"path": f"{folder}/state.json"},
        "page": {"listen": f"127.0.0.1:{free_port()}"},
        "link": [{"protocol": "rotctld", "tcp": f"127.0.0.1:{port}"}],
    }
    config = folder / "rotator.toml"
    config.write_text(tomlkit.dumps(tables))
    with (folder / "said.txt").open("wb") as said:
        command = [sys.executable, "-m", "rotator", "run", "--plain", "--config", str(config)]
        process = subprocess.Popen(command, stdout=said, stderr=said)
    try:
        yield port
    finally:
        process.terminate()
        process.wait()


def told(port: int, order: str) -> float:
    """Say it to the box in front. Returns when it left."""
    give_up_s = time.monotonic() + READY_S
    while True:
        try:
            with socket.create_connection(("127.0.0.1", port)) as link:
                link.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
                left_s = time.monotonic()
                link.sendall(order.encode() + b"\n")
                link.recv(100)
                return left_s
        except ConnectionRefusedError:
            if time.monotonic() > give_up_s:
                raise
            time.sleep(0.2)


async def measured(box: Box, port: int, times: int) -> list[float]:
    """The milliseconds from each stop to the last relay that opened."""
    found = []
    for _ in range(times):
        await asyncio.to_thread(told, port, FAR)
        await asyncio.sleep(MOVES_S)
        await box.asked("seen")
        stopped_s = await asyncio.to_thread(told, port, "S")
        await asyncio.sleep(RESTS_S)
        opened_s = [at_s for at_s, _, level in (await box.asked("seen"))["edges"] if not level and at_s > stopped_s]
        found.append(1000 * (max(opened_s) - stopped_s) if opened_s else float("nan"))
    return found


async def chain(protocol: str, way: str, times: int) -> list[float]:
    with tempfile.TemporaryDirectory(prefix="chain-") as name:
        folder = Path(name)
        second = folder / "second"
        second.mkdir()
        spoken = Words(protocol, lambda _azimuth_deg, _elevation_deg: b"", "tcp" if way == "tcp" else "pty")
        box = Box(second, {"rotor": {"hardware": "sim"}, "lcd": {"kind": "none"}}, [spoken])
        try:
            await box.answers()
            place = (
                {"tcp": f"127.0.0.1:{box.ports[protocol]}"} if way == "tcp" else {"serial": cable(box.place(protocol))}
            )
            with first_box(folder / "first", protocol, place) as port:
                return await measured(box, port, times)
        finally:
            box.process.terminate()
            box.process.wait()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("protocols", nargs="*", default=PROTOCOLS)
    parser.add_argument("--times", type=int, default=6)
    chosen = parser.parse_args()
    print("protocol | TCP: median, most | 9600 baud: median, most\n--|--|--")
    for protocol in chosen.protocols:
        cells = []
        for way in ("tcp", "serial"):
            found = sorted(asyncio.run(chain(protocol, way, chosen.times)))
            cells.append(f"{found[len(found) // 2]:.1f}, {found[-1]:.1f} ms")
        print(f"{protocol} | {' | '.join(cells)}", flush=True)


if __name__ == "__main__":
    main()
