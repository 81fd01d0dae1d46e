"""The BNO055: heading and tilt of the boom from the earth's magnetic field and gravity, computed inside the chip.

Knows the chip's registers (Bosch BST-BNO055-DS000), its modes and their times, and how to find the right answer when
the Raspberry Pi's I2C controller garbles some answers. Does not know true north, nor the rotor. A compass near motors
and steel is good as a reference, averaged while the antenna stands; it is no sensor to steer by.
"""

from __future__ import annotations

import struct
from collections.abc import Callable
from typing import TypeVar

from hw.ports import Attitude, CompassCalibration, HardwareError, I2CBus

T = TypeVar("T")

ADDRESS = 0x28
"""With ADR low; 0x29 with ADR high."""

IDENTITY, PAGE, EULER, CALIBRATION, STATUS, UNITS, MODE, AXIS_MAP = 0x00, 0x07, 0x1A, 0x35, 0x39, 0x3B, 0x3D, 0x41
OFFSETS, OFFSETS_COUNT = 0x55, 22

CHIP_IDENTITY = 0xA0
CONFIG_MODE, NDOF = 0x00, 0x0C
DEGREES_WINDOWS = 0x00
"""The driver sets this: documents differ on the chip's default, and the sign of the pitch depends on it."""
STEPS_PER_DEG = 16
SYSTEM_ERROR, FUSION_RUNS = 1, 5

MOUNTINGS = {
    "P0": (0x21, 0x04), "P1": (0x24, 0x00), "P2": (0x24, 0x06), "P3": (0x21, 0x02),
    "P4": (0x24, 0x03), "P5": (0x21, 0x01), "P6": (0x21, 0x07), "P7": (0x24, 0x05),
}  # fmt: skip
"""The eight ways to mount the chip, by their names in the datasheet (section 3.4): axis map and signs."""

BOOT_S, BOOT_STEP_S = 0.9, 0.05
INTO_CONFIG_S = 0.025
INTO_FUSION_S = 0.11
"""7 ms for the change of mode, then the time until the first angles are ready."""

AGREEING = 4
"""So many equal answers in a row count as right. With one byte in 100 garbled, a result is wrong once in 10⁸."""
READS = 80
"""How often a register is read before the driver gives up."""
ALIKE_DEG = 2.0
"""Angles this close are equal answers. A wrong bit 7 is 8° or more; no antenna turns 2° between two answers."""
TRIES = 3


class Bno055:
    """One chip. Each call raises HardwareError when the chip does not answer, or its answers differ. The next call
    tries again. A missing chip takes a second to report, because it might still be starting.

    Raises ValueError for an unknown `mounting`.
    """

    def __init__(
        self,
        bus: I2CBus,
        clock: Callable[[], float],
        sleep: Callable[[float], None],
        *,
        address: int = ADDRESS,
        mounting: str = "P1",
    ) -> None:
        if mounting not in MOUNTINGS:
            raise ValueError(f"no mounting is called {mounting!r}; the datasheet knows {', '.join(MOUNTINGS)}")
        self._bus = bus
        self._clock = clock
        self._sleep = sleep
        self._address = address
        self._settings = ((UNITS, DEGREES_WINDOWS), *enumerate(MOUNTINGS[mounting], AXIS_MAP))
        self._restored: bytes | None = None

    def attitude(self) -> Attitude:
        """All three angles, of one moment."""
        self._run()
        agreeing, before = 0, None
        for _ in range(READS):
            now = self._angles()
            agreeing = agreeing + 1 if before and now and _alike(before, now) else int(now is not None)
            before = now
            if now and agreeing == AGREEING:
                return now
        raise self._unsteady()

    def heading_deg(self) -> float:
        return self.attitude().heading_deg

    def pitch_deg(self) -> float:
        return self.attitude().pitch_deg

    def calibration(self) -> CompassCalibration:
        self._run()
        stat = self._same(CALIBRATION, 1)[0]
        return CompassCalibration(stat >> 6, stat >> 4 & 3, stat >> 2 & 3, stat & 3)

    def offsets(self) -> bytes:
        """The chip's own calibration, 22 bytes. Store it when every part of `calibration` is 3."""
        self._run()
        self._enter(CONFIG_MODE)
        # Two bytes at a time: where bytes are garbled, 22 in a row rarely arrive intact.
        learnt = b"".join(self._same(OFFSETS + at, 2) for at in range(0, OFFSETS_COUNT, 2))
        self._enter(NDOF)
        return learnt

    def restore(self, offsets: bytes) -> None:
        """Give the chip a stored calibration, which it loses at power-off. The driver repeats this after each restart.

        Raises ValueError for anything but 22 bytes.
        """
        if len(offsets) != OFFSETS_COUNT:
            raise ValueError(f"the offsets of a BNO055 are {OFFSETS_COUNT} bytes, not {len(offsets)}")
        self._restored = bytes(offsets)
        self._start()

    # --- modes

    def _run(self) -> None:
        """Make sure that the chip computes angles: after a dip of its supply it is in CONFIG mode."""
        try:
            status, mode = self._same(STATUS, 1)[0], self._same(MODE, 1)[0]
        except HardwareError:
            status, mode = 0, CONFIG_MODE  # the chip may be starting: `_start` waits for it
        if (status, mode) != (FUSION_RUNS, NDOF):
            self._start()

    def _start(self) -> None:
        self._await_boot()
        self._enter(CONFIG_MODE)
        for register, value in self._settings:
            self._write(register, value)
            if self._same(register, 1)[0] != value:
                raise self._error(
                    f"register 0x{register:02x} does not keep what is written; switch its power off and on"
                )
        if self._restored:
            self._write(OFFSETS, *self._restored)
        self._enter(NDOF)
        status, error = self._same(STATUS, 2)
        if status == SYSTEM_ERROR:
            raise self._error(f"it reports system error {error}; switch its power off and on")

    def _await_boot(self) -> None:
        until_s = self._clock() + BOOT_S
        while True:
            try:
                page = self._same(PAGE, 1)[0]
                break
            except HardwareError:
                if self._clock() >= until_s:
                    raise
                self._sleep(BOOT_STEP_S)
        if page == 1:  # another program has used the registers of page 1
            self._write(PAGE, 0)
        identity = self._same(IDENTITY, 1)[0]
        if identity != CHIP_IDENTITY:
            raise self._error(
                f"the chip's identity is 0x{identity:02x}, a BNO055 has 0xa0; another chip is at this address"
            )

    def _enter(self, mode: int) -> None:
        self._write(MODE, mode)
        self._sleep(INTO_CONFIG_S if mode == CONFIG_MODE else INTO_FUSION_S)
        if (now := self._same(MODE, 1)[0]) != mode:
            raise self._error(f"it stays in mode 0x{now:02x}; switch its power off and on")

    # --- answers that agree

    def _angles(self) -> Attitude | None:
        heading, roll, pitch = (part / STEPS_PER_DEG for part in struct.unpack("<hhh", self._read(EULER, 6)))
        possible = 0.0 <= heading <= 360.0 and abs(roll) <= 90.0 and abs(pitch) <= 180.0
        return Attitude(heading % 360.0, roll, pitch) if possible else None

    def _same(self, register: int, count: int) -> bytes:
        """The answer that came AGREEING times in a row."""
        agreeing, before = 0, b""
        for _ in range(READS):
            now = self._read(register, count)
            agreeing = agreeing + 1 if now == before else 1
            before = now
            if agreeing == AGREEING:
                return now
        raise self._unsteady()

    def _unsteady(self) -> HardwareError:
        return self._error(
            "its answers change from reading to reading; the Raspberry Pi up to 4 garbles them when the chip stretches "
            "the clock: put it on a bus of its own with dtoverlay=i2c-gpio, or set i2c_arm_baudrate=10000"
        )

    def _read(self, register: int, count: int) -> bytes:
        return self._tried(lambda: self._bus.write_read(self._address, bytes([register]), count))

    def _write(self, register: int, *values: int) -> None:
        self._tried(lambda: self._bus.write(self._address, bytes([register, *values])))

    def _tried(self, transfer: Callable[[], T]) -> T:
        """Repeat a transfer: now and then the chip is busy and does not acknowledge."""
        for _ in range(TRIES - 1):
            try:
                return transfer()
            except HardwareError:
                self._sleep(1e-3)
        return transfer()

    def _error(self, text: str) -> HardwareError:
        return HardwareError(f"BNO055 at 0x{self._address:02x}: {text}")


def _alike(a: Attitude, b: Attitude) -> bool:
    turns_deg = (a.heading_deg - b.heading_deg, a.roll_deg - b.roll_deg, a.pitch_deg - b.pitch_deg)
    return all(abs((turn_deg + 180.0) % 360.0 - 180.0) <= ALIKE_DEG for turn_deg in turns_deg)
