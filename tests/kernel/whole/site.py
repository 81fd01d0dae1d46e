"""A whole station in this kernel: relay lines on a GPIO chip, pots and display on an I2C bus, the box as a process.

Knows how they are put together and how the box is asked. Decides nothing about what is tested.
"""

from __future__ import annotations

import json
import os
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable
from contextlib import ExitStack, suppress
from pathlib import Path
from typing import Self

from firmware_sim.rotors.geared import RelayedRotor
from rotator.assembly.simulated_axes import SIM_CALIBRATION_RAW
from rotator.assembly.simulation import SimulatedStation
from rotator.config.load import parse
from tests.kernel.bench.edges import EdgeRecorder
from tests.kernel.bench.gpio import GpioChip, persisting
from tests.kernel.bench.i2c import I2CAdapter
from tests.kernel.bench.plant import Plant
from tests.kernel.bench.waiting import until

CW, CCW, UP, DOWN, MASTER, HEARTBEAT = 22, 23, 24, 25, 16, 26
RELAYS = (CW, CCW, UP, DOWN)
PORT = 4000
START_S = 60.0
LIMIT_S = 1.0
"""However the program dies, its relays open within this time."""

LOW, HIGH = SIM_CALIBRATION_RAW
BOX = """
[rotor]
hardware = "pi"
[azimuth]
min_deg = 0
max_deg = 450
calibration = [[{low}, 0], [{high}, 450]]
direction_checked = true
[elevation]
min_deg = 0
max_deg = 180
calibration = [[{low}, 0], [{high}, 180]]
direction_checked = true
[relays]
master = 16
heartbeat = 26
[adc]
bus = {bus}
[lcd]
kind = "pcf8574"
bus = {bus}
[state]
path = "{state}"
[[link]]
protocol = "gs232b"
tcp = "127.0.0.1:{port}"
"""
USB_LINK = '[[link]]\nname = "pc"\nprotocol = "gs232b"\nserial = "/dev/ttyGS0"\n'
ROTOR = '[relays]\nmaster = 16\n[lcd]\nkind = "pcf8574"\n[sim]\nbus_takes_time = false\n'


def lives(process: int) -> bool:
    with suppress(OSError):
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] not in "ZX"
    return False


class Nursery:
    """Starts boxes without loading the program anew each time."""

    def __init__(self) -> None:
        command = [sys.executable, "-m", "tests.kernel.whole.nursery"]
        self._process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self._line()

    def start(self, module: str, log: Path, environment: dict[str, str], *arguments: str) -> int:
        """Returns the process id."""
        assert self._process.stdin is not None
        self._process.stdin.write(json.dumps([module, str(log), environment, *arguments]) + "\n")
        self._process.stdin.flush()
        return int(self._line())

    def close(self) -> None:
        self._process.communicate()

    def _line(self) -> str:
        assert self._process.stdout is not None
        return self._process.stdout.readline()


class Site:
    """Everything plugged in and no box running yet. A Raspberry Pi's kernel: lines stay driven when let go."""

    def __init__(
        self,
        nursery: Nursery,
        folder: Path,
        extra: str = "",
        *,
        box: str = BOX,
        rotor: str = ROTOR,
        contacts: tuple[int, ...] = (),
        start_deg: tuple[float, float] = (100.0, 20.0),
    ) -> None:
        """`box` and `rotor`: the configurations of the box and of the simulated rotor; `contacts`: what it pulls."""
        self._nursery = nursery
        self._box, self._rotor, self._contacts, self._start_deg = box, rotor, contacts, start_deg
        self.folder = folder
        self.log = folder / "box.log"
        self.log.touch()
        self.state = folder / "state.json"
        self.config = folder / "rotator.toml"
        self._extra = extra
        self.pid = 0
        self.sentinel = 0

    def __enter__(self) -> Self:
        with ExitStack() as stack:
            stack.enter_context(persisting(True))
            self.chip = stack.enter_context(GpioChip())
            self.world = SimulatedStation(parse(self._rotor, "rotor"), time.monotonic, None, self._start_deg).build()
            assert isinstance(self.world, RelayedRotor)
            self.adapter = stack.enter_context(I2CAdapter(self.world.bus))
            stack.enter_context(Plant(self.chip, self.world, (*RELAYS, MASTER), self._contacts))
            self.edges = stack.enter_context(EdgeRecorder(self.chip))
            stack.callback(self.kill)
            self._stack = stack.pop_all()
        self.write_config()
        return self

    def __exit__(self, *error: object) -> None:
        self._stack.close()

    def write_config(self) -> None:
        box = self._box.format(low=LOW, high=HIGH, bus=self.adapter.number, state=self.state, port=PORT)
        self.config.write_text(box + self._extra)

    # --- the box

    def start(self, module: str = "rotator.cli.main", environment: dict[str, str] | None = None) -> None:
        """Start the box and wait until it takes orders."""
        command = ("run", "--plain", "--config", str(self.config))
        started = self._nursery.start(module, self.log, environment or {}, *command)
        self.await_start(lambda: started)

    def await_start(self, program: Callable[[], int], patience_s: float = START_S) -> None:
        """Wait until the box takes orders; its process id may be known only then."""
        until(self._answers, f"an answer from the box; it said:\n{self.log.read_text()}", patience_s)
        self.pid = program()
        (child,) = Path(f"/proc/{self.pid}/task/{self.pid}/children").read_text().split()
        self.sentinel = int(child)

    def alive(self) -> bool:
        return lives(self.pid)

    def signal(self, number: int) -> None:
        os.kill(self.pid, number)

    def kill(self) -> None:
        if self.pid:
            with suppress(ProcessLookupError):
                self.signal(signal.SIGKILL)
            self.dead()
            # The next station's chip will have the same name: this sentinel must not lay hands on it.
            until(lambda: not lives(self.sentinel), "the end of the sentinel")

    def dead(self) -> None:
        """Wait for its end."""
        until(lambda: not self.alive(), f"the end of the box; it said:\n{self.log.read_text()}")

    def said(self, text: str) -> bool:
        return text in self.log.read_text()

    # --- a person at the network

    def order(self, text: str) -> None:
        with self._connected() as line:
            line.sendall(text.encode() + b"\r")
            line.shutdown(socket.SHUT_WR)
            line.recv(1)  # it has heard all when it hangs up

    def ask(self, text: str) -> str:
        with self._connected() as line, line.makefile() as answers:
            line.sendall(text.encode() + b"\r")
            return answers.readline().strip()

    def _connected(self) -> socket.socket:
        line = socket.create_connection(("127.0.0.1", PORT), timeout=START_S)
        line.settimeout(START_S)
        return line

    def _answers(self) -> bool:
        try:
            return self.ask("C2").startswith("AZ=")
        except OSError:
            return False

    # --- the relays

    def on(self) -> set[int]:
        return {pin for pin in RELAYS if self.chip.level(pin)}

    def off_since_s(self) -> float:
        """Wait until no motor relay is on; the moment when the last one opened, on the clock of time.monotonic()."""
        until(lambda: not self.on(), "every relay off")
        return max(edge.at_s for edge in self.edges.edges() if edge.offset in RELAYS and not edge.level)
