"""Switches relay lines off in place of a program that has died or hangs.

Knows the lines as numbers on a GPIO chip, so that a small process can switch them without the configuration. Does not
know when to do that: the sentinel, the service manager or the operator does.
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass, replace
from typing import Any

from hw.buses.gpio import GpioOutputs, LinesBusyError
from hw.ports import HardwareError
from hw.safety.off_at_once import BRAKE, BRAKE_AFTER_S, RETRY_S, described, understood


@dataclass(frozen=True, slots=True)
class RelayLines:
    """All lines that must be off so that the motors stand still: relays, master, heartbeat; and those of brakes."""

    chip: str
    offsets: dict[str, int]
    active_low: bool

    @property
    def brakes(self) -> RelayLines:
        """The lines of the brakes alone. On: the brake is off."""
        return replace(self, offsets={name: pin for name, pin in self.offsets.items() if name.endswith(BRAKE)})

    @property
    def motors(self) -> RelayLines:
        """All lines but those of the brakes."""
        return replace(self, offsets={name: pin for name, pin in self.offsets.items() if not name.endswith(BRAKE)})

    def to_text(self) -> str:
        return described(self.chip, self.offsets, active_low=self.active_low)

    @classmethod
    def from_text(cls, text: str) -> RelayLines:
        """Raises HardwareError for a text that `to_text` did not write."""
        try:
            return cls(*understood(text))
        except ValueError as fault:
            raise HardwareError(str(fault)) from fault


def switch_off(
    api: Any,
    lines: RelayLines,
    clock: Callable[[], float],
    sleep: Callable[[float], None],
    patience_s: float,
    *,
    unbraked: Collection[str] = (),
) -> None:
    """Take the lines at their off level, and release them. `api`: the gpiod package, or an object of its shape.

    Waits up to `patience_s` seconds for a program that still holds the lines. Raises HardwareError; LinesBusyError when
    the program holds them for longer.

    `unbraked`: the lines of brakes that are off: these engage `BRAKE_AFTER_S` later, when the antenna has come to rest.

    A Raspberry Pi's kernel keeps the level of a released line. Other kernels make the line an input; the relay is then
    off if the pin's pull resistor holds the off level.
    """
    give_up_s = clock() + patience_s
    while True:
        try:
            taken = GpioOutputs(api, lines.chip, lines.offsets, consumer="rotator-off", active_low=lines.active_low)
        except LinesBusyError:
            if clock() >= give_up_s:
                raise
            sleep(RETRY_S)
        else:
            if unbraked:
                taken.set(dict.fromkeys(unbraked, True))
                sleep(BRAKE_AFTER_S)
                taken.set(dict.fromkeys(unbraked, False))
            taken.close()
            return
