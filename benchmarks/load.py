"""What the box takes of a core and of the memory while nothing happens, beside a process that does next to nothing.

With the simulated chips: the whole of `rotator run`. Without them: its control thread and its sensors' thread, with
sensors that answer at once. `benchmarks.latency` prints the figures.
"""

from __future__ import annotations

import os
import random
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Mapping
from itertools import cycle
from pathlib import Path

from benchmarks.stops import free_port
from hw.ports import AngleSensor, AngleSource, Axis, Direction
from rotator.assembly.settings import build_controller
from rotator.config.load import parse
from rotator.control.axis.readings import NORMAL, Condition
from rotator.control.commands import Command, Errand
from rotator.rotors.common import PlainRotor
from rotator.rotors.port import AddAlarm
from rotator.runtime.loop import ControlLoop

LOAD_S = 20.0


def load() -> tuple[float, float]:
    """The share of a core that `rotator run` takes at rest, and its resident size in MiB."""
    with tempfile.TemporaryDirectory() as folder:
        config = Path(folder) / "rotator.toml"
        page = f'[page]\nlisten = "127.0.0.1:{free_port()}"\n'
        config.write_text(f'{page}[[link]]\nprotocol = "gs232b"\npty = "{folder}/gs232"\n')
        box = subprocess.Popen(
            [sys.executable, "-m", "rotator", "run", "--plain", "--config", str(config)], stdout=subprocess.DEVNULL
        )
        time.sleep(3.0)
        before = cpu_s(box.pid)
        time.sleep(LOAD_S)
        used_s = cpu_s(box.pid) - before
        held_mib = resident_mib(box.pid)
        box.terminate()
        box.wait()
    return used_s / LOAD_S, held_mib


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
