"""Switches off every line that could keep a motor running, for `rotator off` while no box is running.

Part of the composition root. The kind of rotor names the lines; no sensor is opened. Where an output sets a motor's
speed, it is put to its lowest last: a bus that hangs holds no line up.
"""

from __future__ import annotations

import time
from contextlib import suppress

from hw.buses.gpio import LinesBusyError, find_chip, real_gpiod
from hw.buses.i2c import open_bus
from hw.buses.pwm import KernelFiles
from hw.ports import HardwareError
from hw.safety.lines_off import switch_off
from hw.safety.off_at_once import BRAKE_AFTER_S, any_on
from rotator.assembly.speed import speed_output
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
        switch_off(real_gpiod(), lines.motors, time.monotonic, time.sleep, PATIENCE_S)
        if brakes := lines.brakes.offsets:
            if any_on(lines.chip, [*brakes.values()], active_low=lines.active_low):
                time.sleep(BRAKE_AFTER_S)
            switch_off(real_gpiod(), lines.brakes, time.monotonic, time.sleep, PATIENCE_S)
    except LinesBusyError as fault:
        raise HardwareError(
            f"{fault}. A box that runs opens its own relays: press stop there, or end it (sudo systemctl stop rotator)"
        ) from fault
    for axis in config.speeds:
        with suppress(HardwareError):  # the relays are off, and without them no motor turns
            speed_output(config.axis(axis), KernelFiles(), open_bus, time.monotonic, time.sleep)
    return lines.offsets
