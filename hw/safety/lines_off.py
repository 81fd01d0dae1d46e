"""Switches relay lines off, whoever switched them on and whatever became of him.

Knows the lines as numbers on a chip, so that a process that has nothing else loaded can do it at once. Does not know
why: that is the sentinel's, the service manager's, or a person's affair.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import Any

from hw.buses.gpio import GpioOutputs, LinesBusyError
from hw.ports import HardwareError

RETRY_S = 0.002
"""A process that has died holds its lines until the kernel has taken it apart."""


@dataclass(frozen=True, slots=True)
class RelayLines:
    """Every line that must be off for the motors to stand still: relays, master, heartbeat."""

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
    """Take the lines with their off level and let them go again. `api` is the gpiod package, or of its shape.

    Waits that long for whoever still holds them. Raises HardwareError; LinesBusyError when they were not let go.

    A Raspberry Pi's kernel leaves a line as it was set when it is let go, others make it an input: off either way,
    where the pin's pull means off.
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
