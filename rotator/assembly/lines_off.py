"""Switches off every line that could keep a motor running, for `rotator off` while no box is running.

Part of the composition root. The kind of rotor names the lines; no sensor and no bus is opened.
"""

from __future__ import annotations

import time

from hw.buses.gpio import LinesBusyError, find_chip, real_gpiod
from hw.ports import HardwareError
from hw.safety.lines_off import switch_off
from rotator.assembly.station import off_lines
from rotator.config.model import Config

PATIENCE_S = 1.0
"""A dying program releases its lines within this time."""


def switch_lines_off(config: Config) -> dict[str, int]:
    """The GPIOs that are off now, by the names of their lines; empty: this rotor has none. Raises HardwareError."""
    lines = off_lines(config, lambda: config.relays.chip or find_chip(real_gpiod()))
    if lines is None:
        return {}
    try:
        switch_off(real_gpiod(), lines, time.monotonic, time.sleep, PATIENCE_S)
    except LinesBusyError as fault:
        raise HardwareError(
            f"{fault}. A box that runs opens its own relays: press stop there, or end it (sudo systemctl stop rotator)"
        ) from fault
    return lines.offsets
