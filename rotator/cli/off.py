"""`rotator off`: every relay line off, when no box is running.

Knows which configuration says the lines. How they are switched off is in `hw.safety.lines_off`.
"""

from __future__ import annotations

import time
from pathlib import Path

import click

from hw.buses.gpio import LinesBusyError, find_chip, real_gpiod
from hw.ports import HardwareError
from hw.safety.lines_off import switch_off
from rotator.assembly.station import off_lines
from rotator.config.load import load

HOLDS = {
    "moteus": "the controllers stop and hold by their own watchdog, half a second after the program's last word",
    "servo": "the board goes on with its last pulses, and the servos hold",
    "digipot": "the control boxes go on to where their chips point; a relay in their supply would end that",
}
"""What becomes of a rotor without relays when the program ends."""
PATIENCE_S = 1.0
"""A dying program has given back its lines after this time, in seconds."""


def relays_off(path: Path | None) -> None:
    config = load(path)
    if config.rotor.hardware == "sim":
        click.echo("simulated: there is no relay to open")
        return
    lines = off_lines(config, lambda: config.relays.chip or find_chip(real_gpiod()))
    if lines is None:
        click.echo(f"{config.rotor.type}: there is no relay to open; {HOLDS[config.rotor.type]}")
        return
    try:
        switch_off(real_gpiod(), lines, time.monotonic, time.sleep, PATIENCE_S)
    except LinesBusyError as fault:
        raise HardwareError(
            f"{fault}. A box that runs opens its own relays: press stop there, or end it (sudo systemctl stop rotator)"
        ) from fault
    pins = ", ".join(f"{name} (GPIO{offset})" for name, offset in lines.offsets.items())
    click.echo(f"off: {pins}")
