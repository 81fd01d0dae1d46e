"""Switches relay lines off, for a program that has switched them on and cannot do it any more.

Knows the lines as numbers on a chip, so that a small process can do it at once. Does not know why: the sentinel, the
service manager or the operator does.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import Any

from hw.buses.gpio import GpioOutputs, LinesBusyError
from hw.ports import HardwareError

RETRY_S = 0.002
"""The pause, in seconds, before the next try: a dead process holds its lines until the kernel has cleaned up."""


@dataclass(frozen=True, slots=True)
class RelayLines:
    """All lines that must be off so that the motors stand still: relays, master, heartbeat."""

    chip: str
    offsets: dict[str, int]
    active_low: bool

    def to_json(self) -> str:
        return json.dumps(asdict(self))

    @classmethod
    def from_json(cls, text: str) -> RelayLines:
        """Raises HardwareError for a text that `to_json` did not write."""
        try:
            said = json.loads(text)
            offsets = {str(name): int(offset) for name, offset in said["offsets"].items()}
            return cls(str(said["chip"]), offsets, bool(said["active_low"]))
        except (ValueError, KeyError, TypeError, AttributeError) as fault:
            raise HardwareError(f"not a description of relay lines: {text[:60]!r}") from fault


def switch_off(
    api: Any, lines: RelayLines, clock: Callable[[], float], sleep: Callable[[float], None], patience_s: float
) -> None:
    """Take the lines with their off level, and give them back. `api`: the gpiod package, or an object of its shape.

    Waits up to `patience_s` for a program that still holds them. Raises HardwareError; LinesBusyError when it goes on
    holding them.

    A Raspberry Pi's kernel leaves a line as it was set when it is given back. Other kernels make it an input, which is
    off too where the pin's pull resistor means off.
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
            taken.close()
            return
