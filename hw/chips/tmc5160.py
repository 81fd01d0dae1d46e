"""TMC5160 and TMC5130: a chip that counts the microsteps of one stepper, makes its ramps and feeds its coils.

Knows registers and datagrams (data sheets TMC5160A rev. 1.17, TMC5130A rev. 1.20). The TMC5130 has no GLOBALSCALER,
has no short detection to the supply, and clears flags when they are read, not when a 1 is written. Knows microsteps,
not degrees, and not where a motor is to go.
"""

from __future__ import annotations

import math
import threading
from dataclasses import dataclass
from enum import Enum, IntEnum

from hw.buses.spi import SpiBus
from hw.ports import HardwareError

MICROSTEPS = 256
"""To a full step: the ramp generator counts these."""
TURN_OF_FIELD = 4 * MICROSTEPS
WRITE = 0x80
FULL_SCALE_V = 0.325
"""Peak over the sense resistor at full current."""
CHIP_OHM = 0.02
"""The TMC5130's own resistance beside its sense resistor."""
LEAST_SCALER = 32
FAST = (1 << 23) - 512
"""The highest VMAX."""


class Register(IntEnum):
    GCONF = 0x00
    GSTAT = 0x01
    IOIN = 0x04
    GLOBALSCALER = 0x0B
    IHOLD_IRUN = 0x10
    TPOWERDOWN = 0x11
    TCOOLTHRS = 0x14
    RAMPMODE = 0x20
    XACTUAL = 0x21
    VACTUAL = 0x22
    VSTART = 0x23
    A1 = 0x24
    V1 = 0x25
    AMAX = 0x26
    VMAX = 0x27
    DMAX = 0x28
    D1 = 0x2A
    VSTOP = 0x2B
    XTARGET = 0x2D
    SW_MODE = 0x34
    RAMP_STAT = 0x35
    X_ENC = 0x39
    ENC_CONST = 0x3A
    MSCNT = 0x6A
    CHOPCONF = 0x6C
    COOLCONF = 0x6D
    DRV_STATUS = 0x6F


class RampMode(IntEnum):
    POSITION, HOLD = 0, 3


class Model(Enum):
    """`version`: what bits 31 to 24 of IOIN say."""

    TMC5130 = "tmc5130", 0x11
    TMC5160 = "tmc5160", 0x30

    def __init__(self, key: str, version: int) -> None:
        self.key = key
        self.version = version


SHAFT = 1 << 4
DRV_ENN, SD_MODE = 1 << 4, 1 << 6
STOP_L_ENABLE, SG_STOP = 1 << 0, 1 << 10
EVENTS = 0xDC
"""RAMP_STAT: the events that are cleared: latches, stops, StallGuard, position reached."""
CHOPPER = 0x000100C3
"""SpreadCycle, which StallGuard2 needs, as the data sheet begins with it: TOFF 3, HSTRT 4, HEND 1, TBL 2."""
TOFF = 0x0F
SG_FILTER = 1 << 24
DRIVER_OFF = {
    25: "it is too hot and has switched its driver off",
    27: "coil A has a short to ground",
    28: "coil B has a short to ground",
    12: "coil A has a short to the supply",
    13: "coil B has a short to the supply",
}
"""Bits of DRV_STATUS with which the chip itself has switched the coils off."""
SHORT_TO_SUPPLY = 1 << 12 | 1 << 13
HOT, OPEN_A, OPEN_B = 1 << 26, 1 << 29, 1 << 30
RESET_FLAG, AT_SPEED, AT_SWITCH = 1 << 0, 1 << 4, 1 << 6
"""Of the status that comes with each datagram. The first: it has been without supply since GSTAT was cleared."""


@dataclass(frozen=True, slots=True)
class Look:
    """What a chip says of itself in one moment."""

    was_reset: bool
    """It has been without supply since `clear_reset`: its count is worth nothing."""
    microsteps: int
    encoder: int
    """Microsteps, as its encoder has counted them."""
    speed: int
    """VACTUAL: not 0 while its ramp runs."""
    driver: int
    """DRV_STATUS."""
    at_speed: bool
    """The ramp has reached VMAX."""
    at_switch: bool
    """The reference switch at its lower end says so."""
    feeds: bool
    """Its driver is switched on, by register and by its line ENN."""
    disabled: bool
    """Its line ENN is high."""

    @property
    def driver_off(self) -> str:
        """Why the chip has switched the coils off; empty: it has not."""
        return "; ".join(text for bit, text in DRIVER_OFF.items() if self.driver >> bit & 1)


def current(model: Model, run_a: float, sense_ohm: float) -> tuple[int, int]:
    """GLOBALSCALER (0: none, or full scale) and IRUN for a current per coil, in amperes rms. The TMC5160 is to scale by
    the first and keep the second high. Raises ValueError: the chip cannot, with this resistor.
    """
    peak_v = run_a * math.sqrt(2.0) * (sense_ohm + (CHIP_OHM if model is Model.TMC5130 else 0.0))
    if peak_v > FULL_SCALE_V:
        raise ValueError(f"with {sense_ohm:g} ohm the chip gives {FULL_SCALE_V / peak_v * run_a:.2f} A at most")
    share = peak_v / FULL_SCALE_V
    if model is Model.TMC5130:
        return 0, max(0, round(32 * share) - 1)
    scaler = max(LEAST_SCALER, math.ceil(256 * share))
    return scaler % 256, max(0, min(31, round(32 * share * 256 / scaler) - 1))


class Tmc5160:
    """`select`: what the bus calls its select line. `name` opens each error. Safe to call from any thread."""

    def __init__(self, bus: SpiBus, select: str, model: Model, name: str) -> None:
        self._bus = bus
        self._select = select
        self._model = model
        self._name = name
        self._lock = threading.Lock()

    def write(self, register: Register, value: int) -> None:
        with self._lock:
            self._bus.send(self._select, bytes([register | WRITE]) + (value & 0xFFFFFFFF).to_bytes(4, "big"))

    def read(self, *registers: Register) -> tuple[int, list[int]]:
        """The status of the last datagram, and the value of each register. Raises HardwareError."""
        answers = []
        with self._lock:
            # The chip answers in the next datagram. The last one asks again, for the answer to the one before.
            for register in (*registers, registers[-1]):
                answers.append(self._bus.exchange(self._select, bytes([register, 0, 0, 0, 0])))
        return answers[-1][0], [int.from_bytes(answer[1:], "big") for answer in answers[1:]]

    def look(self) -> Look:
        """Raises HardwareError: it does not answer, is another chip, or is wired to take steps from outside."""
        # Not RAMP_STAT: a TMC5130 would forget its events, and a motor that StallGuard has stopped would run on.
        status, (pins, place, speed, driver, encoder, chopper) = self.read(
            Register.IOIN,
            Register.XACTUAL,
            Register.VACTUAL,
            Register.DRV_STATUS,
            Register.X_ENC,
            Register.CHOPCONF,
        )
        version = pins >> 24
        if version in (0x00, 0xFF):
            raise HardwareError(f"{self._name} does not answer")
        if version != self._model.version:
            raise HardwareError(f"{self._name} is no {self._model.name}: its version is 0x{version:02x}")
        if pins & SD_MODE:
            raise HardwareError(f"{self._name}: its pin SD_MODE is high, so it makes no ramps: wire it to ground")
        if self._model is Model.TMC5130:
            driver &= ~SHORT_TO_SUPPLY
        return Look(
            was_reset=bool(status & RESET_FLAG),
            microsteps=signed(place, 32),
            encoder=signed(encoder, 32),
            speed=signed(speed, 24),
            driver=driver,
            at_speed=bool(status & AT_SPEED),
            at_switch=bool(status & AT_SWITCH),
            feeds=bool(chopper & TOFF) and not pins & DRV_ENN,
            disabled=bool(pins & DRV_ENN),
        )

    def motion(self) -> tuple[int, int]:
        """Its count now, and its speed as in VMAX, negative: down. Raises HardwareError."""
        _, (place, speed) = self.read(Register.XACTUAL, Register.VACTUAL)
        return signed(place, 32), signed(speed, 24)

    def clear_reset(self) -> None:
        """From now on a dip of the supply shows in `Look.was_reset`."""
        self.read(Register.GSTAT)
        self.write(Register.GSTAT, 0b111)

    def clear_events(self) -> None:
        """Let a motor run again that a switch or StallGuard has stopped."""
        self.read(Register.RAMP_STAT)
        self.write(Register.RAMP_STAT, EVENTS)

    def phase(self) -> int:
        """Where the field of its coils is within four full steps; 0 after a reset. Raises HardwareError."""
        return self.read(Register.MSCNT)[1][0] & (TURN_OF_FIELD - 1)

    def place(self, microsteps: int) -> None:
        """From now on the motor stands at this count. The motor does not turn. Call it at rest."""
        self.write(Register.RAMPMODE, RampMode.HOLD)
        for register in (Register.XACTUAL, Register.XTARGET, Register.X_ENC):
            self.write(register, microsteps)
        self.write(Register.RAMPMODE, RampMode.POSITION)


def signed(value: int, bits: int) -> int:
    value &= (1 << bits) - 1
    return value - (1 << bits) if value >> (bits - 1) else value


def speed(microsteps_per_s: float, clock_hz: float) -> int:
    """VMAX for that speed."""
    return min(FAST, round(abs(microsteps_per_s) * 2**24 / clock_hz))


def microsteps_per_s(speed: int, clock_hz: float) -> float:
    """Of a speed as in VMAX."""
    return speed * clock_hz / 2**24


def acceleration(microsteps_per_s2: float, clock_hz: float) -> int:
    """AMAX or DMAX for that acceleration; never 0, with which the motor would not stop."""
    return max(1, min(0xFFFF, round(microsteps_per_s2 * 2**41 / clock_hz**2)))


def step_time(microsteps_per_s: float, clock_hz: float) -> int:
    """TCOOLTHRS: the time of a microstep at that speed, in ticks of the clock."""
    return min(0xFFFFF, round(clock_hz / microsteps_per_s))
