"""The check of the stop button, the mode switch and the limit switches.

Knows which of them must be closed before a motor may run. Takes their lines for a moment.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from hw.ports import Axis, HardwareError
from rotator.config.model import Config
from rotator.doctor.finding import Finding, fine, skipped, warn, wrong
from rotator.doctor.machine import Machine

POSITIONS = (
    "MANUAL: the knobs move the antenna, programs do not",
    "PARK: the antenna stays where it is",
    "AUTO: programs move the antenna",
    "JOG: the jog switches move the antenna, programs do not",
)
"""Indexed by 2 × MSB + LSB; a closed contact is 1."""


def switches(machine: Machine, config: Config) -> Iterator[Finding]:
    panel = {f"panel.{key}": pin for key, pin in config.panel.switches.items()}
    limits = {f"limits.{key}": pin for key, pin in config.limits.switches.items()}
    try:
        closed = machine.chips.closed(config, panel | limits)
    except HardwareError as fault:
        yield skipped(f"cannot be read: {fault}")
        return
    if "panel.stop" in panel:
        yield _stop(panel["panel.stop"], closed=closed["panel.stop"])
    if "panel.mode_msb" in panel:
        yield fine(f"the mode switch is on {POSITIONS[2 * closed['panel.mode_msb'] + closed['panel.mode_lsb']]}")
    if closed.get("panel.calibrate"):
        yield warn(
            "the calibrate switch is closed: the box calibrates when it starts",
            "Open it, unless you want a calibration.",
        )
    if limits:
        yield from _limits({key: closed[key] for key in limits}, limits)


def _stop(pin: int, *, closed: bool) -> Finding:
    if closed:
        return fine("the stop button is closed: nothing is stopped")
    return wrong(
        f"the stop button is pressed, or its wire is broken: GPIO {pin} is not at ground, and nothing will move",
        "Pull it out. If it is out, measure from the GPIO to ground: a closed contact is 0 V.",
    )


def _limits(closed: Mapping[str, bool], pins: Mapping[str, int]) -> Iterator[Finding]:
    for axis in Axis:
        opened = [key for key in closed if key.startswith(f"limits.{axis.value}") and not closed[key]]
        if len(opened) > 1:
            yield wrong(
                f"both limit switches of the {axis.value} are open, and it will not turn",
                "An antenna is not at both ends: look at what the two have in common, a wire, or their optos' supply.",
            )
        elif opened:
            yield warn(
                f"{opened[0]} (GPIO {pins[opened[0]]}) is open: the {axis.value} goes no further in that direction",
                "Does the antenna stand at that end? Then turn it away. If not, its wire is broken.",
            )
    if all(closed.values()):
        yield fine(f"limit switches: {len(closed)} closed, none reached")
