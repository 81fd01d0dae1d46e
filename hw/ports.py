"""The interfaces between the program and whatever turns and measures an antenna.

Knows what a caller may ask of a drive, a sensor and a display, and what failure looks like. Knows no device. Everything
here is a `typing.Protocol`: a driver conforms by its shape and imports nothing but the names below.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum, IntEnum
from typing import NamedTuple, Protocol


class Axis(Enum):
    AZIMUTH = "azimuth"
    ELEVATION = "elevation"


class Direction(IntEnum):
    """Which way along the axis's own scale: PLUS is clockwise, or up."""

    MINUS = -1
    OFF = 0
    PLUS = 1


class HardwareError(Exception):
    """A device is missing, does not answer or answers nonsense. The text says what and where, for a person."""


class AngleSensor(Protocol):
    """Tells where an axis is, in the sensor's own unit; calibration turns that into degrees."""

    source: str
    """How the angle is known: `measured`, `counted` or `modelled`."""

    def read(self) -> float:
        """The raw reading: for a pot the share of its supply, 0 to 1. May take milliseconds.

        Raises HardwareError when the device does not answer; the next call tries again.
        """


class SwitchedDrive(Protocol):
    """Motors that are only on or off, two directions an axis."""

    def drive(self, axis: Axis, direction: Direction, until_s: float) -> Direction:
        """Run `axis` that way until the moment `until_s` at the latest; OFF stops it now. Returns what is on now.

        Below this call, where no caller can go round it: opposite directions are never on together, a reversal waits
        out its dead time (OFF comes back meanwhile: ask again), and no command lives longer than the longest lease.
        Raises HardwareError when the lines cannot be set.
        """

    def off(self) -> None:
        """Everything off, now, from any thread."""

    def cut(self) -> bool:
        """Everything off and the motors' supply with it, until `restore`. False: nothing here can switch the supply.

        Raises HardwareError when the lines cannot be set.
        """

    def restore(self) -> None:
        """The supply may come back, with the next motor that is to run."""


class LeaseWatch(Protocol):
    """Somebody outside the program who opens the relays when the leases are no longer renewed."""

    def renew(self) -> None:
        """A relay is to be on, or to stay on. Raises HardwareError where nobody watches: then none may be."""

    def rest(self) -> None:
        """No relay is on any more."""


class CharacterDisplay(Protocol):
    """A display of a few rows of characters."""

    def show(self, rows: Sequence[str]) -> None:
        """Make the display read `rows` (cut or padded to its width). Raises HardwareError when it does not answer."""

    def reset(self) -> None:
        """Bring the display up from any state; sparks upset the cheap ones."""


class OutputLines(Protocol):
    """A few digital outputs that change together, by name."""

    def set(self, levels: dict[str, bool]) -> None:
        """Switch the named outputs (True: active) in one instant. Raises HardwareError."""

    def close(self) -> None:
        """Let go of the lines; what is to be off has been switched off before."""


class I2CBus(Protocol):
    """An I2C adapter as drivers use it."""

    def write(self, address: int, data: bytes) -> None:
        """One write transfer. Raises HardwareError when the device does not answer."""

    def write_read(self, address: int, data: bytes, count: int) -> bytes:
        """Write, then read `count` bytes after a repeated start. Raises HardwareError."""

    def read_each(self, address: int, registers: Sequence[int], count: int) -> list[bytes]:
        """Read `count` bytes from each register, in that order, in one transfer. Raises HardwareError."""


class PositionedDrive(Protocol):
    """Motors that go to an angle by themselves. Angles are degrees on the rotor's own scale."""

    def aim(self, axis: Axis, angle_deg: float, rate_dps: float, until_s: float) -> None:
        """Be at `angle_deg` now, moving on at `rate_dps`; the moment `until_s`, at the latest, the axis decelerates and
        holds unless told again. No command lives longer than the longest lease. Raises HardwareError.
        """

    def hold(self, axis: Axis) -> None:
        """Decelerate, and hold where it comes to rest. Raises HardwareError."""

    def release(self) -> None:
        """Let go, without torque: an antenna that is not balanced turns. Only a person asks for that."""

    def off(self) -> None:
        """The safe state, from any thread: every axis decelerates and holds."""

    def due_s(self) -> float | None:
        """The moment `enforce` has something to do; None: nothing moves."""

    def enforce(self, now_s: float) -> None:
        """Hold every axis whose command has expired. The guard's only task; it touches no sensor."""


@dataclass(frozen=True, slots=True)
class ContactChange:
    """A contact closed or opened, at that moment of time.monotonic(); so many changes before it went unseen."""

    at_s: float
    closed: bool
    lost: int = 0


class ContactInput(Protocol):
    """A contact whose changes are noted, bounce left out, by somebody who never sleeps: the kernel."""

    def closed(self) -> bool:
        """What it is now. Raises HardwareError."""

    def changes(self) -> list[ContactChange]:
        """What has happened since this was asked the last time, in order of time. Never waits. Raises HardwareError."""


class SwitchInputs(Protocol):
    """A few contacts that are read together, by name."""

    def read(self) -> dict[str, bool]:
        """True: closed. Raises HardwareError."""


@dataclass(frozen=True, slots=True)
class Attitude:
    """Degrees: heading 0 up to 360 clockwise from magnetic north, roll and pitch about level."""

    heading_deg: float
    roll_deg: float
    pitch_deg: float


class CompassCalibration(NamedTuple):
    """How well a compass has found its own errors, each part 0 (not at all) to 3."""

    system: int = 0
    gyroscope: int = 0
    accelerometer: int = 0
    magnetometer: int = 0

    @property
    def complete(self) -> bool:
        return min(self) == 3

    def __str__(self) -> str:
        return (
            f"system {self.system}, gyroscope {self.gyroscope}, accelerometer {self.accelerometer}, "
            f"magnetometer {self.magnetometer} of 3"
        )


class Compass(Protocol):
    """A compass with a level sensor, on the boom. Every call may take a second and raises HardwareError."""

    def attitude(self) -> Attitude:
        """All three angles of one moment."""

    def calibration(self) -> CompassCalibration: ...

    def offsets(self) -> bytes:
        """The corrections that the compass has found, to be kept while it has no power."""

    def restore(self, offsets: bytes) -> None:
        """Give back what `offsets` returned. Raises ValueError where the length is wrong."""
