"""Boxes to be shown on a terminal: at rest, on their way, faulty, stopped, asleep; and how one looks at the picture."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from io import StringIO
from typing import Any

from rich.console import Console, RenderableType

from hw.ports import AngleSource, Axis, Direction
from rotator.exchange.faults import Fault, FaultKind, Missing
from rotator.exchange.orders import Mode
from rotator.exchange.status import AxisStatus, Status
from rotator.links.wire import Wire
from rotator.views import terminal
from rotator.views.terminal import Surroundings

GLASS = ("SAT A:235 E:025 ", "SIM A:231 E:024 ")
AZIMUTH = AxisStatus(
    0, 450, angle_deg=231.26, raw=0.5125, target_deg=235.0, drive=Direction.PLUS, moving=True, starts=12
)
ELEVATION = AxisStatus(0, 180, angle_deg=24.04, raw=0.17, starts=3)
STATUS = Status(
    at_s=10.0,
    azimuth=AZIMUTH,
    elevation=ELEVATION,
    wanted_azimuth_deg=235,
    wanted_elevation_deg=25,
    simulated=True,
    controlled_by="gs232b#1",
)
STILL = Fault(FaultKind.STANDS_STILL, Axis.ELEVATION, "its motor runs up, but the angle stays at 24.0° (0.00°/s)")
OPEN = Fault(FaultKind.POT_OPEN, Axis.AZIMUTH, "reads 0.000", "0.02 to 0.98")
WELDED = Fault(FaultKind.RELAY_WELDED, Axis.AZIMUTH, "it turns", act_now="CUT MOTOR POWER!", cut=True)


def gone(axis: AxisStatus, fault: Fault) -> AxisStatus:
    """Its pot is out: the last angle is kept, the latest reading is not one."""
    return replace(axis, seen=False, raw=0.0, target_deg=None, drive=Direction.OFF, moving=False, fault=fault)


ASLEEP = replace(
    STATUS,
    azimuth=replace(AZIMUTH, target_deg=None, drive=Direction.OFF, moving=False),
    wanted_azimuth_deg=None,
    wanted_elevation_deg=None,
    controlled_by="",
)
BOTH_OUT = replace(STATUS, azimuth=gone(AZIMUTH, OPEN), elevation=gone(ELEVATION, replace(OPEN, axis=Axis.ELEVATION)))
BARE = replace(AZIMUTH, angle_deg=None, target_deg=None, drive=Direction.OFF, missing=tuple(Missing)[:3])
STATES = {
    "no order": ASLEEP,
    "tracking": STATUS,
    "stopped": replace(ASLEEP, latched="keyboard"),
    "one fault": replace(STATUS, elevation=replace(ELEVATION, fault=STILL)),
    "both faulted": BOTH_OUT,
    "both faulted and stopped": replace(BOTH_OUT, latched="the panel"),
    "relay welded": replace(STATUS, azimuth=replace(AZIMUTH, fault=WELDED)),
    "uncalibrated": replace(ASLEEP, azimuth=BARE, elevation=replace(ELEVATION, missing=(Missing.LIMITS,))),
    "storm park": replace(STATUS, latched="keyboard", storm=True),
    "homing": replace(ASLEEP, azimuth=replace(ASLEEP.azimuth, homing=True, source=AngleSource.COUNTED)),
    "panel": replace(STATUS, mode=Mode.MANUAL, mode_switch=True),
    "long names": replace(
        STATUS,
        controlled_by="a-very-long-name-of-a-link-in-the-file#1234",
        notices=("orders from rotctld#17 are ignored: another program moves the antenna now " * 3,),
    ),
}
SIZES = [(40, 12), (80, 24), (132, 43), (200, 60), (80, 60), (60, 18), (250, 14)]


BUSY = [
    Wire("gs232b", "gs232b", "run/gs232", "open as /dev/pts/3", b"C2\r" * 21, b"AZ=231  EL=024\r\n" * 4),
    Wire("rotctld-in-the-shack", "rotctld", "a-very-long-host-name.of-somebody.example.org:4533", "128 clients"),
]
LOG = [f"12:00:{second:02d} W gs232b: refused {'long ' * 20}" for second in range(40)]


def on_screen(what: RenderableType, columns: int, rows: int) -> list[str]:
    """The lines that a terminal of this size shows."""
    screen = Console(file=StringIO(), width=columns, height=rows, force_terminal=True, legacy_windows=False)
    lines = screen.render_lines(what, pad=False)
    return ["".join(segment.text for segment in line) for line in lines]


def show(
    status: Status = STATUS,
    wires: Sequence[Wire] = (),
    log: Sequence[str] = (),
    size: tuple[int, int] = (88, 40),
    **around: Any,
) -> str:
    what = terminal.picture("0.1.0", status, GLASS, wires, log, around=Surroundings(**around))
    return "\n".join(on_screen(what, *size))


def row(picture: str, name: str, nth: int = 0) -> str:
    return [line for line in picture.splitlines() if line.startswith(f"│ {name}")][nth]
