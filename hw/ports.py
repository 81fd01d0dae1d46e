"""The interfaces between the program and the hardware: drives, sensors, a display, and the buses below them.

Knows what a caller may ask, in which unit, and how a failure is reported. Knows no device. Each interface is a
`typing.Protocol`: a driver fits it by its methods alone, and imports from here only the values it uses.

Time in seconds (`_s`) is on the clock that the driver was built with: time.monotonic() on a Pi, a simulated clock in
tests. Angles in degrees (`_deg`) are on the rotor's own scale, 0 to 450 for example.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from enum import Enum, IntEnum
from typing import NamedTuple, Protocol, runtime_checkable

# --- values that all drivers share


class Axis(Enum):
    AZIMUTH = "azimuth"
    ELEVATION = "elevation"

    __hash__ = object.__hash__
    """By identity: Enum's own hash takes longer than the rest of a dict look-up, of which a cycle makes a hundred."""


class Direction(IntEnum):
    """A direction of turning along the axis's own scale: PLUS is clockwise or up, MINUS counter-clockwise or down."""

    MINUS = -1
    OFF = 0
    PLUS = 1


class AngleSource(Enum):
    """How the angle of an axis is known."""

    MEASURED = "measured"
    COUNTED = "counted"
    MODELLED = "modelled"


class HardwareError(Exception):
    """A device is missing, does not answer, or its answer makes no sense.

    The text is for the user: which device, what is wrong, what to check.
    """


# --- motors


class PositionedDrive(Protocol):
    """Two motors that go to an angle by themselves: moteus controllers, servos, control boxes."""

    def aim(self, axis: Axis, angle_deg: float, rate_dps: float, until_s: float) -> None:
        """Be at `angle_deg` now and move on at `rate_dps`. At `until_s` at the latest the axis decelerates and holds.

        Each command expires, after 0.5 s at most. Raises HardwareError, and moves nothing then.
        """

    def hold(self, axis: Axis) -> None:
        """Decelerate, and hold where the axis comes to rest. Raises HardwareError."""

    def release(self) -> None:
        """Take the torque away from both axes: an antenna out of balance then turns. Only on the operator's request."""

    def off(self) -> None:
        """The safe state: both axes decelerate and hold. From any thread."""

    def due_s(self) -> float | None:
        """When `enforce` is due; None: no axis moves."""

    def enforce(self, now_s: float) -> None:
        """Hold each axis whose command has expired. The guard calls this; it reads no sensor. Raises HardwareError."""


class LeaseWatch(Protocol):
    """A watch in another process. It opens the relays when the program no longer renews its leases."""

    def renew(self) -> None:
        """A relay is about to close, or stays closed. Raises HardwareError without a watch: then no relay may close."""

    def rest(self) -> None:
        """No relay is closed any more."""

    def unbraked(self, lines: Collection[str]) -> None:
        """These brakes are off, or about to be; all others hold. Raises HardwareError without a watch."""


# --- sensors


class AngleSensor(Protocol):
    """Measures, counts or models the angle of one axis. The calibration turns its reading into degrees."""

    source: AngleSource

    def read(self) -> float:
        """One reading in the sensor's own unit: degrees, or a share from 0 to 1 (of a pot's supply, of a turn).

        May take some milliseconds. Raises HardwareError when the device does not answer; the next call tries again.
        """


@runtime_checkable
class KnowsSince(Protocol):
    """An angle sensor whose next reading may be older than the call: it is the latest answer of another thread."""

    @property
    def since_s(self) -> float:
        """That reading is of no earlier moment."""


BoardAxes = tuple[float, float, float]
"""What a chip measures along its x, y and z."""


class Accelerometer(Protocol):
    """A chip that feels gravity."""

    name: str
    """The chip with its address, for messages."""

    def gravity_g(self) -> BoardAxes:
        """In g: at rest 1 g upwards. May take some milliseconds, 0.1 s at first. Raises HardwareError."""

    def restart(self) -> None:
        """Set the chip up anew before its next reading."""


class Magnetometer(Protocol):
    """A chip that feels the magnetic field."""

    name: str
    """The chip with its address, for messages."""

    def field_ut(self) -> BoardAxes:
        """In µT. May take some milliseconds, 0.1 s at first. Raises HardwareError; the next call tries again."""


@dataclass(frozen=True, slots=True)
class Ellipse:
    """On which the field lies over a whole turn of the mast: its middle and its half axes, ahead and to the left, in
    µT. Iron that turns with the board shifts it, and stretches it.
    """

    centre_ut: tuple[float, float]
    radius_ut: tuple[float, float]

    def unit(self, field_ut: tuple[float, float]) -> tuple[float, float]:
        """The field as a share of the ellipse: on the unit circle where nothing else disturbs it."""
        (ahead, left), (x, y), (a, b) = field_ut, self.centre_ut, self.radius_ut
        return (ahead - x) / a, (left - y) / b


@runtime_checkable
class FeelsField(Protocol):
    """An angle sensor that goes by the earth's magnetic field."""

    ellipse: Ellipse | None
    """What has been learnt of the iron around it; None: nothing yet, and the field is taken as it is."""
    field_ut: tuple[float, float] | None
    """The field of the latest reading, ahead and to the left; None: there was none."""


class AnalogInputs(Protocol):
    """The inputs of an analog-to-digital converter, by number from 0."""

    def volts(self, channel: int) -> float:
        """Volts at this input against ground, converted now. May take milliseconds.

        Raises HardwareError when the converter does not answer; the next call tries again.
        """


@dataclass(frozen=True, slots=True)
class ContactChange:
    """A contact closed or opened at `at_s`; `lost` changes before this one were not recorded."""

    at_s: float
    closed: bool
    lost: int = 0


class ContactInput(Protocol):
    """A contact whose changes the kernel records, without bounce, so that none is missed while the program is busy."""

    def closed(self) -> bool:
        """Whether the contact is closed now. Raises HardwareError."""

    def changes(self) -> list[ContactChange]:
        """The changes since the last call, in order of time. Never waits. Raises HardwareError."""


class SwitchInputs(Protocol):
    """A few contacts that are read together."""

    def read(self) -> dict[str, bool]:
        """Each contact by name, True: closed. Raises HardwareError."""


@dataclass(frozen=True, slots=True)
class Attitude:
    """Degrees: heading 0 up to 360 clockwise from magnetic north, roll and pitch about level."""

    heading_deg: float
    roll_deg: float
    pitch_deg: float


class CompassCalibration(NamedTuple):
    """How far a compass has found its own errors: each part from 0 (not at all) to 3 (fully)."""

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
        """The corrections that the compass has found. Store them: the compass loses them without power."""

    def restore(self, offsets: bytes) -> None:
        """Give back what `offsets` returned. Raises ValueError where the length is wrong."""


# --- display


class CharacterDisplay(Protocol):
    """A display of a few rows of characters."""

    def show(self, rows: Sequence[str]) -> None:
        """Show `rows`, each cut or padded to the display's width. Raises HardwareError when it does not answer."""

    def reset(self) -> None:
        """Set the display up from any state, because a spark can upset it. Raises HardwareError."""


# --- lines and buses, which drivers of chips use


class OutputLines(Protocol):
    """A few digital outputs that change together, by name."""

    def set(self, levels: dict[str, bool]) -> None:
        """Switch the named outputs in one instant; True is active. Raises HardwareError."""

    def close(self) -> None:
        """Release the lines. The caller has switched them off before. May be called twice."""


class I2CBus(Protocol):
    """An I2C adapter. Addresses have seven bits."""

    def write(self, address: int, data: bytes) -> None:
        """One write transfer. Raises HardwareError when the device does not answer."""

    def write_read(self, address: int, data: bytes, count: int) -> bytes:
        """Write `data`, then read `count` bytes after a repeated start. Raises HardwareError."""

    def read_each(self, address: int, registers: Sequence[int], count: int) -> list[bytes]:
        """Read `count` bytes from each register in that order, all in one transfer. Raises HardwareError."""
