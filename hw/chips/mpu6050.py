"""The MPU6050 on the boom: elevation from the direction of gravity.

Knows the chip's registers (InvenSense RM-MPU-6000A) and how the board is mounted. The chip cannot separate gravity from
an acceleration, so a reading far from 1 g is not used. Does not use the gyroscopes, and does not know the rotor.
"""

from __future__ import annotations

import math
import struct
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass

from hw.ports import AngleSource, HardwareError, I2CBus

ADDRESS = 0x68
"""With AD0 low; 0x69 with AD0 high."""

CONFIG = 0x1A
ACCEL_CONFIG = 0x1C
ACCEL_OUT = 0x3B
POWER = 0x6B
WHO_AM_I = 0x75

IDENTITY = 0x68
AWAKE = 0x00
LOW_PASS_10_HZ = 5
"""Delays a reading by 13.8 ms, and filters out the motor's vibration, which would look like an acceleration."""
RANGE_2_G = 0x00
STEPS_PER_G = 16384
SETTLING_S = 0.05

SHAKEN_G = 0.15
"""A reading further from 1 g than this is shaken by the motor or the wind, and not used."""
AVERAGED_OVER_S = 0.3
"""A result is the mean of the good readings of this many seconds. While the board shakes, these are older readings."""
LEAST_IN_PLANE_G = 0.5
"""With less gravity than this in the plane in which the boom turns, the board lies on its side."""

_AXES = {"x": 0, "y": 1, "z": 2}


@dataclass(frozen=True, slots=True)
class Mounting:
    """The arrow on the board that points along the boom, and the arrow that points up while the boom is level.

    An arrow is an axis with its sign: `+x`, `-z`, ...

    Raises ValueError for an unknown arrow, or two arrows of one axis.
    """

    forward: str = "+x"
    up: str = "+z"

    def __post_init__(self) -> None:
        for name, arrow in (("forward", self.forward), ("up", self.up)):
            if len(arrow) != 2 or arrow[0] not in "+-" or arrow[1] not in _AXES:
                raise ValueError(f"{name} is {arrow!r}; write +x, -x, +y, -y, +z or -z")
        if self.forward[1] == self.up[1]:
            raise ValueError(
                f"forward {self.forward} and up {self.up} are the same axis; look at the arrows on the board"
            )

    def plane_g(self, board_g: tuple[float, float, float]) -> tuple[float, float]:
        """Gravity along the boom and across it, in the plane in which the boom turns."""
        return _along(self.forward, board_g), _along(self.up, board_g)


def _along(arrow: str, board_g: tuple[float, float, float]) -> float:
    part = board_g[_AXES[arrow[1]]]
    return part if arrow[0] == "+" else -part


class Mpu6050:
    """One chip as a `hw.ports.AngleSensor`. `clock` gives seconds; `sleep` waits while the chip wakes up.
    `averaged`: the largest number of readings in an average.
    """

    source = AngleSource.MEASURED

    def __init__(
        self,
        bus: I2CBus,
        clock: Callable[[], float],
        sleep: Callable[[float], None],
        *,
        address: int = ADDRESS,
        mounting: Mounting | None = None,
        averaged: int = 4,
    ) -> None:
        self._bus = bus
        self._clock = clock
        self._sleep = sleep
        self._address = address
        self._mounting = mounting or Mounting()
        self._taken: deque[tuple[float, float, float]] = deque(maxlen=averaged)
        """For each reading: its moment in seconds, then gravity along the boom and across it in g."""
        self._awake = False

    def read(self) -> float:
        """Elevation in degrees, -90 to 270, so that a boom which goes over the top reaches 180 without a jump.

        Raises HardwareError when the chip does not answer, is another chip, or has been shaken for too long.
        """
        try:
            board_g = self._gravity_g()
        except HardwareError:
            self._awake = False
            raise
        now_s = self._clock()
        while self._taken and now_s - self._taken[0][0] > AVERAGED_OVER_S:
            self._taken.popleft()
        force_g = math.hypot(*board_g)
        if abs(force_g - 1.0) <= SHAKEN_G:
            self._taken.append((now_s, *self._in_plane(board_g)))
        else:
            self._awake = False  # perhaps its supply dipped: the chip then sleeps and reads 0 g
            if not self._taken:
                raise self._error(
                    f"it feels {force_g:.2f} g where gravity is 1 g; wait until the antenna stands still, "
                    "and fix the board to the boom where it shakes least"
                )
        forward, up = (math.fsum(taken[part] for taken in self._taken) for part in (1, 2))
        return (math.degrees(math.atan2(forward, up)) + 90.0) % 360.0 - 90.0

    def _in_plane(self, board_g: tuple[float, float, float]) -> tuple[float, float]:
        plane_g = self._mounting.plane_g(board_g)
        if math.hypot(*plane_g) < LEAST_IN_PLANE_G:
            raise self._error("the board lies on its side; check which arrows point forward and up")
        return plane_g

    def _gravity_g(self) -> tuple[float, float, float]:
        if not self._awake:
            self._wake()
        x, y, z = struct.unpack(">hhh", self._bus.write_read(self._address, bytes([ACCEL_OUT]), 6))
        return x / STEPS_PER_G, y / STEPS_PER_G, z / STEPS_PER_G

    def _wake(self) -> None:
        identity, power = (self._bus.write_read(self._address, bytes([at]), 1)[0] for at in (WHO_AM_I, POWER))
        if identity != IDENTITY:
            raise self._error(
                f"the chip's identity is 0x{identity:02x}, an MPU6050 has 0x68; another chip is at this address"
            )
        for register, value in ((POWER, AWAKE), (CONFIG, LOW_PASS_10_HZ), (ACCEL_CONFIG, RANGE_2_G)):
            self._bus.write(self._address, bytes([register, value]))
        if power != AWAKE:
            self._sleep(SETTLING_S)
        self._awake = True

    def _error(self, text: str) -> HardwareError:
        return HardwareError(f"MPU6050 at 0x{self._address:02x}: {text}")
