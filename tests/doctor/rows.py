"""A row: a station, what is done to its files, programs and simulated world, and what one check then finds.

What takes more than one look stands in tests of its own.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from rotator.config.load import parse
from tests.doctor.conftest import STATION, STATION_OF, Pi, hold, runs

CONFIG_TXT = "/boot/firmware/config.txt"
PERSIST = "/sys/module/pinctrl_bcm2835/parameters/persist_gpio_outputs"
MODEL = "/proc/device-tree/model"
SERVICE = "/etc/systemd/system/rotator.service"
UNIT = "[Service]\nUser=rotator\nSupplementaryGroups=gpio i2c spi dialout\n"
PASSWD = "pi:x:1000:1000::/home/pi:/bin/bash\nrotator:x:990:990::/var/lib/rotator:/bin/false\n"
NO_LCD = "[lcd]\nkind = 'none'\n"
PEAK = "/sys/class/thermal/thermal_zone0/temp"
STATE = "/sys/class/watchdog/watchdog0/state"
MOTEUS_PANEL = '[compass]\nkind = "bno055"\n'
MCP3208 = '[adc]\nkind = "mcp3208"\n'
SWITCHES = "[panel]\nmode_msb = 10\nmode_lsb = 9\nstop = 19\n[limits]\nazimuth_low = 18\n"
BACKPACK = '[lcd]\nkind = "pcf8574"\n'
PANEL = """
[panel]
mode_msb = 10
mode_lsb = 9
calibrate = 11
stop = 19
[limits]
azimuth_low = 18
azimuth_high = 8
"""
AS5600 = STATION.replace("[elevation]", '[azimuth.sensor]\nkind = "as5600"\n[elevation]')
LS7366R = '[bridge.azimuth]\ncounter = "ls7366r"\n'
AS5045 = AS5600.replace('"as5600"', '"as5045"')
NO_RUN = "not installed: rotator run is started by hand"


def of(kind: str) -> str:
    return STATION_OF.format(kind)


def link(way: str, name: str, more: str = "") -> str:
    protocol = {"serial": "gs232b", "pty": "gs232b", "tcp": "rotctld", "udp": "pstrotator"}[way]
    return f'[[link]]\nprotocol = "{protocol}"\n{way} = "{name}"\n{more}'


def service(enabled: str, active: str, sub: str, pid: str = "0") -> str:
    return f"echo UnitFileState={enabled}; echo ActiveState={active}; echo SubState={sub}; echo MainPID={pid}"


@dataclass(frozen=True)
class Row:
    """`found`: each finding's mark, a blank, and words of it; or of its advice, behind `→`."""

    check: str
    found: str
    base: str = STATION
    more: str = ""
    files: dict[str, str | None] = field(default_factory=dict)
    """None: it is not there."""
    programs: dict[str, str] = field(default_factory=dict)
    broken: str = ""
    """A fault of the simulated world."""
    held: tuple[str, int] = ("", 0)
    """Who holds which line."""
    is_running: bool = False
    now: dict[str, object] = field(default_factory=dict)
    """Other fields of the machine."""
    reads: str | None = None
    """What the file says instead of `more`, to which the chips are wired."""
    spoil: Callable[[Pi], object] = lambda _pi: None

    def look(self, pi: Pi) -> str:
        pi.station(self.more, base=self.base)
        for path, text in self.files.items():
            pi.machine.at(path).unlink(missing_ok=True) if text is None else pi.write(path, text)
        for name, script in self.programs.items():
            pi.program(name, script) if script else (pi.folder / "bin" / name).unlink()
        if self.broken:
            pi.world.inject(self.broken)
        if self.held[0]:
            hold(pi, *self.held)
        if self.is_running:
            runs(pi)
        if self.reads is not None:
            pi.config = parse(f"{self.base}\n{self.reads}", "test")
        self.spoil(pi)
        pi.change(**self.now)
        return "".join(f"\n{each.mark} {each.found} → {each.advice}" for each in pi.found(self.check))

    def judge(self, pi: Pi) -> None:
        told = self.look(pi)
        assert self.found in told, told


class Listener:
    """A chip that keeps what is written to it, and has nothing to say."""

    def __init__(self) -> None:
        self.written: list[bytes] = []

    def write(self, data: bytes) -> None:
        self.written.append(data)

    def read(self, count: int) -> bytes:
        return bytes(count)


def another_chip(address: int, chip: Listener | None = None) -> Callable[[Pi], None]:
    """In place of the one at this address."""

    def put(pi: Pi) -> None:
        pi.world.bus.detach(address)
        pi.world.bus.attach(address, chip or Listener())

    return put


def board(*registers: tuple[int, int]) -> Callable[[Pi], None]:
    """A program has written to the servo board."""

    def write(pi: Pi) -> None:
        for register in registers:
            pi.world.board.write(bytes(register))

    return write


def stat(policies: str) -> dict[str, str | None]:
    threads = {
        f"/proc/7/task/{number}/stat": f"{number} (rotator run) S {'0 ' * 37}{policy} 0 0"
        for number, policy in enumerate(policies)
    }
    return {SERVICE: UNIT, **threads}


GROUPS_OF_OTHERS = "dialout:x:20:pi\npi:x:1000:\ngpio:x:997:\ni2c:x:998:alice\n"
ALICE = PASSWD.replace("pi:x:1000:1000::/home/pi", "alice:x:1001:1001::/home/a")
RUNNING = service("enabled", "active", "running", "7")


def named(row: Row) -> str:
    return f"{row.check}: {row.found[:40]}".replace("\n", " ")
