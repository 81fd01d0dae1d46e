"""A hundred programs at once: run `python -m benchmarks.clients`.

The box runs as in `rotator run`, in real time, on a simulated I2C bus that takes a real bus's time. In a process of its
own a hundred rotctld clients ask for the position ten times a second, one asks and never reads, and one turns the
antenna and stops it. Beside the answers' times stand those of a reference run on the same machine: the same clients
against an asyncio server that sends a fixed answer back. Relay edges carry the time at which the simulated line
changed.
"""

from __future__ import annotations

import asyncio
import os
import subprocess
import sys
import tempfile
import time

from benchmarks.load import resident_mib
from benchmarks.stops import free_port, opened
from rotator.box.app import App
from rotator.config.load import parse

CLIENTS = 100
LASTS_S = 20.0
ROTOR = """
[state]
path = "{folder}/state.json"
[relays]
dead_time_s = 0.05
[sim.azimuth]
start_deg = 225
[[link]]
protocol = "rotctld"
tcp = "127.0.0.1:{port}"
"""

CROWD = """
import asyncio, random, sys, time
port, clients, lasts_s, turns = int(sys.argv[1]), int(sys.argv[2]), float(sys.argv[3]), sys.argv[4] == "turns"
until_s = time.monotonic() + lasts_s
async def ask(reader, writer, question, lines):
    start = time.monotonic()
    writer.write(question)
    for _ in range(lines):
        assert await reader.readuntil(b"\\n")
    return start, time.monotonic() - start
async def polls(number):
    reader, writer = await asyncio.open_connection("127.0.0.1", port)
    due_s = time.monotonic() + random.random() * 0.1
    while time.monotonic() < until_s:
        await asyncio.sleep(max(0.0, due_s - time.monotonic()))
        due_s += 0.1
        print("p", (await ask(reader, writer, b"p\\n", 2))[1])
async def deaf():
    _, writer = await asyncio.open_connection("127.0.0.1", port, limit=1024)
    writer.transport.pause_reading()
    while time.monotonic() < until_s and not writer.transport.is_closing():
        writer.write(b"1\\n" * 50)
        await asyncio.sleep(0.01)
async def hand():
    reader, writer = await asyncio.open_connection("127.0.0.1", port)
    count = 0
    while time.monotonic() < until_s - 2:
        count += 1
        await ask(reader, writer, b"M 16 -1\\n" if count % 2 else b"M 8 -1\\n", 1)
        await asyncio.sleep(0.4 + random.random() * 0.1)
        print("S", (await ask(reader, writer, b"S\\n", 1))[0])
        await asyncio.sleep(0.6)
async def main():
    tasks = [polls(number) for number in range(clients)]
    await asyncio.gather(*tasks, *([deaf(), hand()] if turns else []))
asyncio.run(main())
"""


def main() -> None:
    reference_ms = asyncio.run(_reference())
    answers_ms, stops_ms, late_ms, period_ms, before_mib, after_mib = asyncio.run(_box())
    print(f"{'':50}{'median':>8}{'p99':>9}{'worst':>9}")
    for name, values in (
        ("fixed answer from an asyncio server (reference)", reference_ms),
        (f"p to its whole answer, {CLIENTS} clients at 10 Hz", answers_ms),
        ("last byte of S to relay off, meanwhile", stops_ms),
        (f"control cycle late, of a period of {period_ms:g} ms", late_ms),
    ):
        print(f"{name:50}{_share(values, 0.5):8.2f} {_share(values, 0.99):8.2f} {max(values):8.2f} ms")
    ratio = _share(answers_ms, 0.5) / _share(reference_ms, 0.5)
    print(f"answers take {ratio:.1f} times the reference's median; {len(answers_ms)} answers, {len(stops_ms)} stops")
    print(f"resident: {before_mib:.1f} MiB after a quarter of the time, {after_mib:.1f} MiB at the end")


def _share(values: list[float], share: float) -> float:
    return sorted(values)[int(share * (len(values) - 1))]


async def _reference() -> list[float]:
    async def answer(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        while await reader.readline():
            writer.write(b"235.00\n25.00\n")

    port = free_port()
    server = await asyncio.start_server(answer, "127.0.0.1", port)
    lines = await asyncio.to_thread(_crowd, port, "answers")
    server.close()
    return _milliseconds(lines)


async def _box() -> tuple[list[float], list[float], list[float], float, float, float]:
    with tempfile.TemporaryDirectory() as folder:
        port = free_port()
        app = App(parse(ROTOR.format(folder=folder, port=port), "benchmark"))
        assert app.station.world is not None
        stop = asyncio.Event()
        box = asyncio.create_task(app.run(stop))
        while not app.links or app.links[0].wire.state == "closed":
            await asyncio.sleep(0.1)
        crowd = asyncio.create_task(asyncio.to_thread(_crowd, port, "turns"))
        period_s = 1 / app.config.control.rate_hz
        late_ms: dict[float, float] = {}
        begun_s, before_mib = time.monotonic(), 0.0
        while not crowd.done():
            status = app.loop.status
            late_ms[status.at_s] = 1000 * status.cycle_late_s
            if not before_mib and time.monotonic() - begun_s > LASTS_S / 4:
                before_mib = resident_mib(os.getpid())
            await asyncio.sleep(period_s / 4)
        lines, after_mib = await crowd, resident_mib(os.getpid())
        stop.set()
        await box
        pins = (app.config.relays.azimuth_cw, app.config.relays.azimuth_ccw)
        edges = [(edge.at_s, edge.offset, edge.level) for edge in app.station.world.gpio.edges if edge.offset in pins]
        stops_ms = opened([float(line.split()[1]) for line in lines if line.startswith("S ")], edges).after_ms
        return _milliseconds(lines), stops_ms, list(late_ms.values()), 1000 * period_s, before_mib, after_mib


def _milliseconds(lines: list[str]) -> list[float]:
    return [1000 * float(line.split()[1]) for line in lines if line.startswith("p ")]


def _crowd(port: int, kind: str) -> list[str]:
    done = subprocess.run(
        [sys.executable, "-c", CROWD, str(port), str(CLIENTS), str(LASTS_S), kind],
        stdout=subprocess.PIPE,
        text=True,
        check=True,
    )
    return done.stdout.splitlines()


if __name__ == "__main__":
    main()
