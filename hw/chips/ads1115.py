"""The ADS1115, a four-input 16-bit converter: single-shot readings in volts.

Knows the chip's registers (TI SBAS444, tables 6 to 8). Does not know what its inputs are wired to.
"""

from __future__ import annotations

import struct
from collections.abc import Callable

from hw.ports import HardwareError, I2CBus

CONVERSION = 0x00
CONFIG = 0x01

START = 1 << 15
READY = 1 << 15
SINGLE_SHOT = 1 << 8
COMPARATOR_OFF = 0b11
MUX_AGAINST_GROUND = 0b100
FULL_SCALE_V = {6.144: 0b000, 4.096: 0b001, 2.048: 0b010, 1.024: 0b011, 0.512: 0b100, 0.256: 0b101}
RATE_SPS = {8: 0, 16: 1, 32: 2, 64: 3, 128: 4, 250: 5, 475: 6, 860: 7}

_STEPS = 32768
_OSCILLATOR_TOLERANCE = 1.1
"""A conversion may take 10 % longer than the nominal rate says (electrical characteristics, data rate variation)."""
_WAKE_UP_S = 100e-6
_POLLS = 20
_SLOWEST_POLLS = 500
"""Enough polls for the lowest rate, eight conversions a second, with the time that each poll takes on the bus."""


class Ads1115:
    """One chip. `sleep` waits for a conversion. `rate_sps` and `full_scale_v` are keys of the tables above."""

    def __init__(
        self,
        bus: I2CBus,
        address: int,
        sleep: Callable[[float], None],
        *,
        rate_sps: int = 860,
        full_scale_v: float = 4.096,
    ) -> None:
        self._bus = bus
        self._address = address
        self._sleep = sleep
        self._full_scale_v = full_scale_v
        self._conversion_s = _OSCILLATOR_TOLERANCE / rate_sps + _WAKE_UP_S
        self._quiet = False
        """No conversion runs: this driver started the last one, and it has ended."""
        self._settings = FULL_SCALE_V[full_scale_v] << 9 | SINGLE_SHOT | RATE_SPS[rate_sps] << 5 | COMPARATOR_OFF

    def volts(self, channel: int) -> float:
        """The voltage of input 0 to 3 against ground. Raises HardwareError: no answer, or an endless conversion."""
        if not self._quiet:
            self._quieten()
        self._quiet = False
        config = START | (MUX_AGAINST_GROUND | channel) << 12 | self._settings
        self._write(config)
        self._sleep(self._conversion_s)
        raw = self._result()
        self._quiet = True
        return raw * self._full_scale_v / _STEPS

    def _result(self) -> int:
        """Read status and result in one transfer: transfers take most of the time of a reading."""
        for _ in range(_POLLS):
            status, result = self._bus.read_each(self._address, (CONFIG, CONVERSION), 2)
            if int.from_bytes(status, "big") & READY:
                return int.from_bytes(result, "big", signed=True)
            self._sleep(_WAKE_UP_S)
        raise self._endless()

    def _quieten(self) -> None:
        """Wait for a conversion that another program started: the chip ignores a start in the meantime."""
        self._write(self._settings)
        for _ in range(_SLOWEST_POLLS):
            if int.from_bytes(self._bus.write_read(self._address, bytes([CONFIG]), 2), "big") & READY:
                return
            self._sleep(_WAKE_UP_S)
        raise self._endless()

    def _endless(self) -> HardwareError:
        return HardwareError(f"ADS1115 at 0x{self._address:02x}: a conversion does not end")

    def _write(self, config: int) -> None:
        self._bus.write(self._address, struct.pack(">BH", CONFIG, config))
