"""What a box costs: run `python -m benchmarks.load [--calls]`. `--calls`: only those, function by function.

Calls of its functions for a cycle and for an order; then the time from its start to its first answer, its share of a
core at rest and its memory, each beside a process that does next to nothing. With the simulated chips: the whole of
`rotator run`. Without them: its control thread and its sensors' thread, with sensors that answer at once.
"""

from __future__ import annotations

import os
import random
import select
import subprocess
import sys
import tempfile
import threading
import time
import tty
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from itertools import cycle
from pathlib import Path

from benchmarks.calls import CYCLES, Calls, counted, files
from hw.ports import AngleSensor, AngleSource, Axis, Direction
from rotator.assembly.settings import build_controller
from rotator.config.load import parse
from rotator.control.axis.readings import NORMAL, Condition
from rotator.control.commands import Command, Errand
from rotator.rotors.common import PlainRotor
from rotator.rotors.port import AddAlarm
from rotator.runtime.loop import ControlLoop
from tests.boxes import free_port

LOAD_S = 20.0
START_S = 30.0
STARTS = 5
"""So often each is started; the fastest counts, for another process may have had the core."""


@contextmanager
def running_box() -> Iterator[tuple[int, float]]:
    """A process of `rotator run`: its id, and the seconds from its start to its first answer on the link."""
    with tempfile.TemporaryDirectory() as folder:
        config, pty = Path(folder) / "rotator.toml", Path(folder) / "gs232"
        page = f'[page]\nlisten = "127.0.0.1:{free_port()}"\n'
        config.write_text(f'{page}[[link]]\nprotocol = "gs232b"\npty = "{pty}"\n')
        started_s = time.monotonic()
        box = subprocess.Popen(
            [sys.executable, "-m", "rotator", "run", "--plain", "--config", str(config)], stdout=subprocess.DEVNULL
        )
        try:
            yield box.pid, _first_answer_s(pty) - started_s
        finally:
            box.terminate()
            box.wait()


def load() -> tuple[float, float]:
    """The share of a core that `rotator run` takes at rest, and its resident size in MiB."""
    with running_box() as (pid, _):
        time.sleep(3.0)
        before = cpu_s(pid)
        time.sleep(LOAD_S)
        return (cpu_s(pid) - before) / LOAD_S, resident_mib(pid)


def start_s() -> float:
    with running_box() as (_, answer_s):
        return answer_s


def _first_answer_s(pty: Path) -> float:
    """When the box has answered `C2` for the first time."""
    give_up_s = time.monotonic() + START_S
    while not pty.exists():
        if time.monotonic() > give_up_s:
            raise SystemExit("the box does not start")
        time.sleep(0.002)
    port = os.open(pty, os.O_RDWR | os.O_NOCTTY)
    try:
        tty.setraw(port)
        os.write(port, b"C2\r")
        if not select.select([port], [], [], START_S)[0]:
            raise SystemExit("the box does not answer")
        return time.monotonic()
    finally:
        os.close(port)


def bare_start_s() -> float:
    """From the start of an interpreter that loads asyncio to its end."""
    started_s = time.monotonic()
    subprocess.run([sys.executable, "-c", "import asyncio"], check=True)
    return time.monotonic() - started_s


class _Rotor(PlainRotor):
    """Two sensors that answer at once, and motors that stand: what the loop costs beside its hardware."""

    def __init__(self) -> None:
        self.sensors: Mapping[Axis, AngleSensor] = {axis: _Sensor() for axis in Axis}

    def condition(self, _axis: Axis) -> Condition:
        return NORMAL

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
        chance = random.Random(1)
        # Drawn beforehand: chance takes time of its own.
        self._readings = cycle([0.5 + chance.gauss(0.0, 0.0002) for _ in range(1000)])

    def read(self) -> float:
        return next(self._readings)


def load_without_chips() -> float:
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


def reference_load() -> float:
    """CPU seconds of a bare thread that wakes 20 times a second, over the same time."""
    code = "import time\nwhile True: time.sleep(0.05)"
    bare = subprocess.Popen([sys.executable, "-c", code])
    time.sleep(1.0)
    before = cpu_s(bare.pid)
    time.sleep(LOAD_S)
    used_s = cpu_s(bare.pid) - before
    bare.kill()
    bare.wait()
    return max(used_s, 1 / os.sysconf("SC_CLK_TCK"))


def bare_mib() -> float:
    bare = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(60)"])
    time.sleep(0.5)
    size = resident_mib(bare.pid)
    bare.kill()
    bare.wait()
    return size


def cpu_s(pid: int) -> float:
    fields = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def resident_mib(pid: int) -> float:
    for line in Path(f"/proc/{pid}/status").read_text().splitlines():
        if line.startswith("VmRSS:"):
            return int(line.split()[1]) / 1024
    raise SystemExit("no VmRSS")


def main() -> None:
    cycle, order, relay = counted()
    if "--calls" in sys.argv:
        for name, calls in (("cycles", cycle), ("order", order), ("relay", relay)):
            print(name, *(f"{count:6} {file} {function}" for (file, function), count in calls.most_common()), sep="\n")
        return
    print(f"a steady cycle: {cycle.total() / CYCLES:.0f} calls in {files(cycle)} files")
    whole = Calls(order) + relay
    print(f"from an order to its relay's line: {whole.total()} calls in {files(whole)} files")
    print(f"of these until it waits for the control thread: {order.total()} in {files(order)}")
    first_s, bare_s = (min(start() for _ in range(STARTS)) for start in (start_s, bare_start_s))
    print(f"start to first answer: {first_s:.2f} s, {first_s / bare_s:.1f} times an interpreter that loads asyncio")
    idle_s = reference_load()
    share, mib = load()
    print(f"20 Hz loop: {100 * share:.2f} % of a core, {share * LOAD_S / idle_s:.1f} times a thread that only sleeps")
    print(f"20 Hz loop without the simulated chips: {100 * load_without_chips():.2f} % of a core")
    print(f"resident: {mib:.1f} MiB, {mib / bare_mib():.1f} times a bare interpreter")


if __name__ == "__main__":
    main()
