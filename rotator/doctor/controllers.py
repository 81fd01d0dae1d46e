"""The check of ready-made controllers: their ports, and what they tell when they are asked for their angle.

Knows what an answer means for the user. Asks, and orders nothing.
"""

from __future__ import annotations

from collections.abc import Iterator

from rotator.config.model import Config
from rotator.doctor.finding import Finding, fine, wrong
from rotator.doctor.links import serial_port
from rotator.doctor.machine import Machine

LOOK = (
    "Its supply; the cable, crossed or straight; protocol, port and baud as in its own menu; another program that has "
    "the port."
)


def ready_made(machine: Machine, config: Config) -> Iterator[Finding]:
    boxes = config.controller.boxes(config.fitted)
    ports = [serial_port(machine, box.serial) for box in boxes.values() if box.serial]
    yield from ports
    if not all(port.ok for port in ports):
        return
    told = machine.chips.controllers(config)
    for axes, box in boxes.items():
        for axis in axes:
            answer = told[axis]
            if isinstance(answer, str):
                yield wrong(f"{axis.value}: {answer}", LOOK)
            else:
                yield fine(f"{axis.value}: {box.protocol} tells {answer:.1f}°: compare it with its own display")
