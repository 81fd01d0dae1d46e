"""A simulated TMC5160 or TMC5130: its SPI, its registers, its ramp in simulated time, and its driver for a stepper.

Knows the data sheets' sections on SPI, registers, ramp generator, StallGuard2, reference switches and the encoder.
Faults: no supply, its data line, heat, a short, an open coil. Not simulated: currents (but for CS_ACTUAL), A1, V1 and
D1, dcStep, CoolStep and latches.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Protocol

STEP_S, CRUISE_S = 0.002, 0.01
"""The ramp is reckoned at this pace, and while its speed does not change at the other."""
BITS = 40
VERSIONS = {"tmc5130": 0x11, "tmc5160": 0x30}
CHOPCONF_AT_RESET = {"tmc5130": 0x00000000, "tmc5160": 0x10410150}
GCONF, GSTAT, IOIN, IHOLD_IRUN, TPOWERDOWN, TCOOLTHRS = 0x00, 0x01, 0x04, 0x10, 0x11, 0x14
RAMPMODE, XACTUAL, VACTUAL, AMAX, VMAX, DMAX, XTARGET = 0x20, 0x21, 0x22, 0x26, 0x27, 0x28, 0x2D
SW_MODE, RAMP_STAT, X_ENC, ENC_CONST, CHOPCONF, COOLCONF, DRV_STATUS = 0x34, 0x35, 0x39, 0x3A, 0x6C, 0x6D, 0x6F
READABLE = {GCONF, RAMPMODE, SW_MODE, CHOPCONF, XTARGET}
"""Registers that are read as they were written; the others of those that are kept can only be written."""
SG_FREE, SG_PRESSED, SG_PER_SGT = 240, -40, 8
"""SG_RESULT of a motor that turns freely, of one that is held up, and what a step of SGT adds."""


class Motor(Protocol):
    """What hangs on its coils."""

    pressed: bool
    """The field has gone on where the shaft could not."""

    @property
    def counts(self) -> int:
        """Of the encoder on its shaft."""

    def turn(self, field: float, *, fed: bool) -> None:
        """The field of the coils is there now, in microsteps; `fed`: they have current."""


class Tmc5160:
    """`motor` hangs on its outputs. `switch_high`: the level at REFL. `clock` gives seconds."""

    def __init__(
        self,
        clock: Callable[[], float],
        motor: Motor,
        *,
        model: str = "tmc5160",
        clock_hz: float = 12e6,
        switch_high: Callable[[], bool] = lambda: False,
    ) -> None:
        self.motor = motor
        self.supplied = True
        self.dumb = False
        """Fault: its data line is broken."""
        self.hot = self.shorted = self.open_coil = self.warm = False
        """Faults of the driver; `warm` is the warning before `hot`."""
        self.enn = False
        """The level of DRV_ENN: high switches the coils off."""
        self._clock = clock
        self._model = model
        self._hz = clock_hz
        self._switch_high = switch_high
        self._now_s = clock()
        self._cs, self._sck = True, True
        self._in = self._out = self._count = 0
        self._asked = 0
        self._reset()

    def _reset(self) -> None:
        self.registers = {CHOPCONF: CHOPCONF_AT_RESET[self._model], ENC_CONST: 1 << 16}
        self.x = self.v = self.field = self.encoder = 0.0
        self._counted = self.motor.counts
        self._events = 0
        self._latched_short = False
        self._gstat = 0b001
        self._stands_s = self._now_s

    # --- pins

    @property
    def so(self) -> bool | None:
        if self._cs or self.dumb or not self.supplied:
            return None
        return bool(self._out >> (BITS - 1 - self._count) & 1) if self._count < BITS else None

    def pins(self, *, cs: bool, sck: bool, si: bool) -> None:
        if self._cs and not cs:
            self._select()
        elif not cs and sck and not self._sck:
            self._in = (self._in << 1 | si) & (1 << BITS) - 1
            self._count += 1
        elif cs and not self._cs:
            self._release()
        self._cs, self._sck = cs, sck

    def frame(self, values: Sequence[int]) -> list[int]:
        """The same for a whole frame at once."""
        self._select()
        silent = self.dumb or not self.supplied
        out = 0 if silent else self._out
        sent = [out >> max(0, 32 - 8 * number) & 0xFF for number in range(len(values))]
        for value in values:
            self._in = (self._in << 8 | value) & (1 << BITS) - 1
        self._count = 8 * len(values)
        self._release()
        return sent

    def _select(self) -> None:
        self._in = self._count = 0
        self.advance()
        self._out = self._status() << 32 | self._value(self._asked)

    def _release(self) -> None:
        if self._count == BITS and self.supplied:
            address, value = self._in >> 32, self._in & 0xFFFFFFFF
            if address & 0x80:
                self._write(address & 0x7F, value)
            self._asked = address & 0x7F

    # --- registers

    def _write(self, address: int, value: int) -> None:
        self.registers[address] = value
        match address:
            case 0x21:
                self.x = _signed(value, 32)
            case 0x39:
                self.encoder = _signed(value, 32)
            case 0x01 if self._model == "tmc5160":
                self._gstat &= ~value
            case 0x35 if self._model == "tmc5160":
                self._events &= ~value
            case 0x6C if not value & 0xF:
                self._latched_short = False
        self.advance()

    def _value(self, address: int) -> int:
        match address:
            case 0x01:
                gstat = self._gstat
                if self._model == "tmc5130":
                    self._gstat = 0
                return gstat
            case 0x04:
                return self._switch_high() | self.enn << 4 | VERSIONS[self._model] << 24
            case 0x21:
                return round(self.x) & 0xFFFFFFFF
            case 0x22:
                return round(self.v * 2**24 / self._hz) & 0xFFFFFF
            case 0x35:
                events = self._events
                if self._model == "tmc5130":
                    self._events = 0
                return events | self._stop_l() | self._at_speed() << 8 | self._arrived() << 9 | (self.v == 0) << 10
            case 0x39:
                return round(self.encoder) & 0xFFFFFFFF
            case 0x6A:
                return round(self._field) % 1024
            case 0x6F:
                return self._driver()
            case _ if address in READABLE:
                return self.registers.get(address, 0)
        return 0

    def _status(self) -> int:
        stands = self.v == 0
        return (
            (self._gstat & 0b11)
            | (self._stall() << 2)
            | (stands << 3)
            | (self._at_speed() << 4)
            | (self._arrived() << 5)
            | (self._stop_l() << 6)
        )

    def _driver(self) -> int:
        irun = self.registers.get(IHOLD_IRUN, 0)
        rests = self._now_s - self._stands_s > self.registers.get(TPOWERDOWN, 0) * 2**18 / self._hz
        scale = irun & 0x1F if rests and self.v == 0 else irun >> 8 & 0x1F
        return (
            self._stallguard()
            | (scale << 16)
            | (self._stall() << 24)
            | (self.hot << 25)
            | ((self.warm or self.hot) << 26)
            | (self._latched_short << 27)
            | (self.open_coil << 29)
            | ((self.v == 0) << 31)
        )

    @property
    def feeds(self) -> bool:
        """Its coils have current."""
        on = self.registers[CHOPCONF] & 0xF and not self.enn and self.supplied
        return bool(on and not self.hot and not self._latched_short)

    @property
    def ordered(self) -> int:
        """The direction of its ramp; 0: it stands, or is to stop."""
        return (self.v > 0) - (self.v < 0) if self.supplied and self.registers.get(VMAX, 0) else 0

    def _stop_l(self) -> bool:
        """Status of the left reference switch: active high, unless its polarity is turned round."""
        return self._switch_high() is not bool(self.registers.get(SW_MODE, 0) & 0b100)

    def _at_speed(self) -> bool:
        return round(abs(self.v) * 2**24 / self._hz) == self.registers.get(VMAX, 0)

    def _arrived(self) -> bool:
        return round(self.x) == _signed(self.registers.get(XTARGET, 0), 32)

    def _stallguard(self) -> int:
        sgt = _signed(self.registers.get(COOLCONF, 0) >> 16, 7)
        result = (SG_PRESSED if self.motor.pressed else SG_FREE) + SG_PER_SGT * sgt
        return min(max(result, 0), 1023) if self.v else 0

    def _stall(self) -> bool:
        """Only above the speed that TCOOLTHRS sets."""
        quick = self.v != 0 and self._hz / abs(self.v) <= self.registers.get(TCOOLTHRS, 0)
        return quick and self._stallguard() == 0

    # --- time

    def power(self, *, on: bool) -> None:
        """Its supply goes, or comes back: then everything is as after a reset."""
        self.advance()
        if on and not self.supplied:
            self._reset()
        self.supplied, self.v = on, 0.0
        self.motor.turn(self._field, fed=self.feeds)

    def advance(self) -> None:
        """Up to the present moment."""
        now_s = self._clock()
        if self.shorted and self.feeds:
            self._latched_short = True
        if self.supplied and (self.hot or self._latched_short):
            self._gstat |= 0b010
        while self._now_s < now_s - 1e-9:
            wanted = self._wanted() if self.supplied else 0.0
            if wanted == 0.0 and self.v == 0.0:
                self._now_s = now_s
                break
            step_s = min(CRUISE_S if wanted == self.v else STEP_S, now_s - self._now_s)
            self._ramp(wanted, step_s)
            self._now_s += step_s
            self._stands_s = self._now_s
            self._turn()
        self._turn()

    def _wanted(self) -> float:
        """The speed that the ramp is on its way to, in microsteps a second."""
        most = self.registers.get(VMAX, 0) * self._hz / 2**24
        match self.registers.get(RAMPMODE, 0):
            case 0:
                left = _signed(self.registers.get(XTARGET, 0), 32) - self.x
                brakes = math.sqrt(2.0 * self._per_s2(DMAX) * abs(left))
                wanted = math.copysign(min(most, brakes), left) if left else 0.0
            case 1:
                wanted = most
            case 2:
                wanted = -most
            case _:
                wanted = self.v
        switch = self.registers.get(SW_MODE, 0)
        stopped = (switch & 0b1 and self._stop_l() and wanted < 0) or self._events & 1 << 6
        return 0.0 if stopped else wanted

    def _ramp(self, wanted: float, step_s: float) -> None:
        switch = self.registers.get(SW_MODE, 0)
        if switch & 1 << 10 and self._stall():
            self._events |= 1 << 6
        if self._events & 1 << 6 or (switch & 0b1 and self._stop_l() and self.v < 0):
            self.v = 0.0
            return
        harder = abs(wanted) > abs(self.v) or not self.registers.get(VMAX, 0)
        most = self._per_s2(AMAX if harder else DMAX) * step_s
        before, self.v = self.v, self.v + min(max(wanted - self.v, -most), most)
        way = (before + self.v) / 2.0 * step_s
        left = _signed(self.registers.get(XTARGET, 0), 32) - self.x
        # It comes to rest on its target, and not a thousandth of a microstep beside it.
        positions = self.registers.get(RAMPMODE, 0) == 0 and self.registers.get(VMAX, 0)
        if positions and abs(self.v) <= 2 * most and abs(left) <= max(1.0, abs(way)):
            way, self.v = left, 0.0
        self.x += way
        self.field += way

    def _per_s2(self, register: int) -> float:
        return self.registers.get(register, 0) * self._hz**2 / 2**41

    @property
    def _field(self) -> float:
        return -self.field if self.registers.get(GCONF, 0) & 1 << 4 else self.field

    def _turn(self) -> None:
        self.motor.turn(self._field, fed=self.feeds and not (self.open_coil and self.v != 0))
        counts = self.motor.counts
        self.encoder += (counts - self._counted) * _signed(self.registers[ENC_CONST], 32) / 2**16
        self._counted = counts

    # --- what it keeps

    def kept(self) -> dict[str, float]:
        """Everything that it keeps while it has its supply."""
        state = {"x": self.x, "field": self.field, "encoder": self.encoder, "gstat": float(self._gstat)}
        return state | {f"r{address}": float(value) for address, value in self.registers.items()}

    def put_back(self, kept: dict[str, float]) -> None:
        self.x, self.field, self.encoder = kept["x"], kept["field"], kept["encoder"]
        self._gstat = int(kept["gstat"])
        self.registers |= {int(name[1:]): int(value) for name, value in kept.items() if name.startswith("r")}
        self._counted = self.motor.counts


def _signed(value: int, bits: int) -> int:
    value &= (1 << bits) - 1
    return value - (1 << bits) if value >> (bits - 1) else value
