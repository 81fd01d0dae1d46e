"""How fast the box answers and lets go: run `python -m benchmarks.latency`.

The box runs as in `rotator run`, in real time, on a simulated I2C bus that takes a real bus's time, with the display
being written all along. A client process of its own sends bytes over the pseudo-terminal; relay edges carry the time at
which the simulated line changed. Beside each figure stands its ratio to a reference run on the same machine: an echo
over a pseudo-terminal for the latencies, a bare 20 Hz thread for the load.
"""

from __future__ import annotations

import asyncio
import os
import random
import select
import statistics
import subprocess
import sys
import tempfile
import threading
import time
import tty
from collections.abc import Mapping
from pathlib import Path

from hw.ports import AngleSensor, AngleSource, Axis, Direction
from rotator.app import App
from rotator.assembly.settings import build_controller
from rotator.config.load import parse
from rotator.control.axis.sensing import Condition
from rotator.control.commands import Command, Errand
from rotator.rotors.common import PlainRotor
from rotator.rotors.port import AddAlarm
from rotator.runtime.loop import ControlLoop

ROUNDS = 200
LOAD_S = 20.0

CONFIG = """
[[link]]
protocol = "gs232b"
pty = "{pty}"
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
        time.sleep(0.4 + chance.random() * 0.1)
        print("S", ask(b"S\\r", False)[0])
        time.sleep(0.02)
    print("C2", ask(b"C2\\r", True)[1], flush=True)
    time.sleep(chance.random() * 0.02)
"""


def main() -> None:
    echo_ms = [1000 * seconds for seconds in _echo()]
    stops_ms, answers_ms = asyncio.run(_box())
    print(f"{'':34}{'median':>9}{'p99':>9}{'worst':>9}   ratio of medians")
    reference = statistics.median(echo_ms)
    for name, values in (
        ("echo over a pty (reference)", echo_ms),
        ("C2 to its whole answer", answers_ms),
        ("last byte of S to relay off", stops_ms),
    ):
        ranked = sorted(values)
        median = statistics.median(ranked)
        p99 = ranked[int(0.99 * (len(ranked) - 1))]
        print(f"{name:34}{median:8.2f} {p99:8.2f} {ranked[-1]:8.2f} ms {median / reference:8.1f}")
    idle_s = _reference_load()
    share, resident_mib = _load()
    print(f"20 Hz loop: {100 * share:.2f} % of a core, {share * LOAD_S / idle_s:.1f} times a thread that only sleeps")
    print(f"20 Hz loop without the simulated chips: {100 * _load_without_chips():.2f} % of a core")
    print(f"resident: {resident_mib:.1f} MiB, {resident_mib / _bare_mib():.1f} times a bare interpreter")


def _echo() -> list[float]:
    """The reference: the same client against a loop that sends a line back at once."""
    master, slave = os.openpty()
    tty.setraw(slave)
    client = _client(os.ttyname(slave), "answer")
    while client.poll() is None:
        if select.select([master], [], [], 0.1)[0] and os.read(master, 256):
            os.write(master, b"AZ=000  EL=000\r\n")
    return [float(line.split()[1]) for line in _output(client)]


async def _box() -> tuple[list[float], list[float]]:
    """Milliseconds from S to the line's edge, and from C2 to its answer."""
    with tempfile.TemporaryDirectory() as folder:
        pty = Path(folder) / "gs232"
        app = App(parse(CONFIG.format(pty=pty), "benchmark"))
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
        offs = [edge.at_s for edge in gpio.edges if edge.offset in pins and not edge.level]
    sent = [float(line.split()[1]) for line in lines if line.startswith("S ")]
    answers = [1000 * float(line.split()[1]) for line in lines if line.startswith("C2 ")]
    if len(offs) < len(sent):
        raise SystemExit(f"{len(sent)} stops but {len(offs)} relay edges; {app.loop.status.faults}")
    stops = [1000 * (min(off for off in offs if off >= moment) - moment) for moment in sent]
    return stops, answers


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


def _load() -> tuple[float, float]:
    """The share of a core that `rotator run` takes at rest, and its resident size in MiB."""
    with tempfile.TemporaryDirectory() as folder:
        config = Path(folder) / "rotator.toml"
        config.write_text(f'[[link]]\nprotocol = "gs232b"\npty = "{folder}/gs232"\n')
        box = subprocess.Popen(
            [sys.executable, "-m", "rotator", "run", "--plain", "--config", str(config)], stdout=subprocess.DEVNULL
        )
        time.sleep(3.0)
        before = _cpu_s(box.pid)
        time.sleep(LOAD_S)
        used_s = _cpu_s(box.pid) - before
        resident_mib = _resident_mib(box.pid)
        box.terminate()
        box.wait()
    return used_s / LOAD_S, resident_mib


class _Rotor(PlainRotor):
    """Two sensors that answer at once, and motors that stand: what the loop costs beside its hardware."""

    def __init__(self) -> None:
        self.sensors: Mapping[Axis, AngleSensor] = {axis: _Sensor() for axis in Axis}

    def condition(self, _axis: Axis) -> Condition:
        return Condition()

    def obey(self, _axis: Axis, _command: Command) -> Direction:
        return Direction.OFF

    def run(self, errand: Errand) -> None: ...

    def off(self) -> None: ...

    def start(self) -> None: ...

    def begin(self, add_alarm: AddAlarm) -> None: ...

    def close(self) -> None: ...


class _Sensor:
    source: AngleSource = AngleSource.MEASURED

    def __init__(self) -> None:
        self._chance = random.Random(1)

    def read(self) -> float:
        return 0.5 + self._chance.gauss(0.0, 0.0002)


def _load_without_chips() -> float:
    """The share of a core that the control thread and the sensors' thread take at rest, by this process's CPU time."""
    config = parse("", "benchmark")
    loop = ControlLoop(build_controller(config), _Rotor(), time.monotonic, 1 / config.control.rate_hz)
    thread = threading.Thread(target=loop.run, name="control")
    thread.start()
    time.sleep(1.0)
    before_s = time.process_time()
    time.sleep(LOAD_S)
    used_s = time.process_time() - before_s
    loop.stop()
    thread.join()
    return used_s / LOAD_S


def _reference_load() -> float:
    """CPU seconds of a bare thread that wakes 20 times a second, over the same time."""
    code = "import time\nwhile True: time.sleep(0.05)"
    bare = subprocess.Popen([sys.executable, "-c", code])
    time.sleep(1.0)
    before = _cpu_s(bare.pid)
    time.sleep(LOAD_S)
    used_s = _cpu_s(bare.pid) - before
    bare.kill()
    bare.wait()
    return max(used_s, 1 / os.sysconf("SC_CLK_TCK"))


def _bare_mib() -> float:
    bare = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(60)"])
    time.sleep(0.5)
    size = _resident_mib(bare.pid)
    bare.kill()
    bare.wait()
    return size


def _cpu_s(pid: int) -> float:
    fields = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def _resident_mib(pid: int) -> float:
    for line in Path(f"/proc/{pid}/status").read_text().splitlines():
        if line.startswith("VmRSS:"):
            return int(line.split()[1]) / 1024
    raise SystemExit("no VmRSS")


if __name__ == "__main__":
    main()
