"""How fast the box answers and lets go: run `python -m benchmarks.latency`.

The box runs as in `rotator run`, in real time, on a simulated I2C bus that takes a real bus's time, with the display
being written all along. A client process of its own sends bytes over the pseudo-terminal; relay edges carry the time at
which the simulated line changed. Beside each figure stands its ratio to a reference run on the same machine: an echo
over a pseudo-terminal for the latencies, a bare 20 Hz thread for the load.
"""

from __future__ import annotations

import asyncio
import os
import select
import statistics
import subprocess
import sys
import tempfile
import threading
import tty
from pathlib import Path

from benchmarks.load import LOAD_S, bare_mib, load, load_without_chips, reference_load
from benchmarks.stops import Stops, free_port, opened
from rotator.box.app import App
from rotator.config.load import parse

ROUNDS = 200

CONFIG = """
[[link]]
protocol = "gs232b"
pty = "{pty}"
[page]
listen = "127.0.0.1:{port}"
[lcd]
kind = "pcf8574"
[relays]
dead_time_s = 0.05
[sim.azimuth]
start_deg = 225
"""

CLIENT = """
import os, select, sys, time, random
fd = os.open(sys.argv[1], os.O_RDWR | os.O_NOCTTY)
def ask(command, answer):
    start = time.monotonic()
    os.write(fd, command)
    reply = b""
    while answer and not reply.endswith(b"\\n"):
        if not select.select([fd], [], [], 1.0)[0]:
            sys.exit("no answer")
        reply += os.read(fd, 256)
    return start, time.monotonic() - start
chance = random.Random(1)
for count in range(int(sys.argv[2])):
    if sys.argv[3] == "stop":
        ask(b"R\\r" if count % 2 else b"L\\r", False)
        time.sleep(0.6 + chance.random() * 0.1)
        print("S", ask(b"S\\r", False)[0])
        time.sleep(0.02)
    print("C2", ask(b"C2\\r", True)[1], flush=True)
    time.sleep(chance.random() * 0.02)
"""


def main() -> None:
    echo_ms = [1000 * seconds for seconds in _echo()]
    stops, answers_ms = asyncio.run(_box())
    print(f"{'':34}{'median':>9}{'p99':>9}{'worst':>9}   ratio of medians")
    reference = statistics.median(echo_ms)
    for name, values in (
        ("echo over a pty (reference)", echo_ms),
        ("C2 to its whole answer", answers_ms),
        ("last byte of S to relay off", stops.after_ms),
    ):
        ranked = sorted(values)
        median = statistics.median(ranked)
        p99 = ranked[int(0.99 * (len(ranked) - 1))]
        print(f"{name:34}{median:8.2f} {p99:8.2f} {ranked[-1]:8.2f} ms {median / reference:8.1f}")
    print(f"stops without effect: {stops.unmet} ({stops.idle} more had no relay to open)")
    idle_s = reference_load()
    share, resident_mib = load()
    print(f"20 Hz loop: {100 * share:.2f} % of a core, {share * LOAD_S / idle_s:.1f} times a thread that only sleeps")
    print(f"20 Hz loop without the simulated chips: {100 * load_without_chips():.2f} % of a core")
    print(f"resident: {resident_mib:.1f} MiB, {resident_mib / bare_mib():.1f} times a bare interpreter")


def _echo() -> list[float]:
    """The reference: the same client against a loop that sends a line back at once."""
    master, slave = os.openpty()
    tty.setraw(slave)
    client = _client(os.ttyname(slave), "answer")
    while client.poll() is None:
        if select.select([master], [], [], 0.1)[0] and os.read(master, 256):
            os.write(master, b"AZ=000  EL=000\r\n")
    return [float(line.split()[1]) for line in _output(client)]


async def _box() -> tuple[Stops, list[float]]:
    """From each S to the line's edge, and milliseconds from C2 to its answer."""
    with tempfile.TemporaryDirectory() as folder:
        pty = Path(folder) / "gs232"
        app = App(parse(CONFIG.format(pty=pty, port=free_port()), "benchmark"))
        assert app.station.world is not None
        gpio = app.station.world.gpio
        stop = asyncio.Event()
        box = asyncio.create_task(app.run(stop))
        await asyncio.sleep(0.5)
        # A display that changes with every look is written all the time, the most the bus ever carries.
        busy = threading.Event()
        writer = threading.Thread(target=_keep_writing, args=(app, busy))
        writer.start()
        client = _client(str(pty), "stop")
        lines = await asyncio.to_thread(_output, client)
        busy.set()
        await asyncio.to_thread(writer.join)
        stop.set()
        await box
        pins = (app.config.relays.azimuth_cw, app.config.relays.azimuth_ccw)
        edges = [(edge.at_s, edge.offset, edge.level) for edge in gpio.edges if edge.offset in pins]
    sent_s = [float(line.split()[1]) for line in lines if line.startswith("S ")]
    answers_ms = [1000 * float(line.split()[1]) for line in lines if line.startswith("C2 ")]
    stops = opened(sent_s, edges)
    if not stops.after_ms:
        raise SystemExit(f"{len(sent_s)} stops, and none opened a relay; {app.loop.status.faults}")
    return stops, answers_ms


def _keep_writing(app: App, done: threading.Event) -> None:
    display = app.station.display
    assert display is not None
    count = 0
    while not done.is_set():
        count += 1
        display.show((f"row {count}", f"row {count}"))


def _client(pty: str, kind: str) -> subprocess.Popen[str]:
    return subprocess.Popen([sys.executable, "-c", CLIENT, pty, str(ROUNDS), kind], stdout=subprocess.PIPE, text=True)


def _output(client: subprocess.Popen[str]) -> list[str]:
    out, _ = client.communicate(timeout=600)
    if client.returncode:
        raise SystemExit("the client got no answer")
    return out.splitlines()


if __name__ == "__main__":
    main()
