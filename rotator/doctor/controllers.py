"""The checks of controllers: a moteus's library, adapter and state, and a ready-made one's port and angle.

Knows what their answers mean for the user. Sends queries and no order: two programs on one adapter take each other's
answers.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import PurePath

from hw.ports import Axis, HardwareError
from rotator.assembly.chips import Heard
from rotator.config.model import Config
from rotator.doctor.finding import Finding, fine, skipped, warn, wrong
from rotator.doctor.links import serial_port
from rotator.doctor.machine import Machine, shown

LEAST_V = 10.0
"""The lowest supply of a moteus r4.11 and of the smaller models."""
CAN_FD_MTU = "72"
UP = 1
"""The bit of an interface's flags in /sys/class/net."""

LIBRARY = (
    "sudo ./install.sh installs it, now that the file needs it. Without install.sh, in the program's "
    "venv: pip install --no-deps 'moteus>=1.1,<2', and pip install importlib-metadata packaging 'python-can>=4.3'."
)
BRING_UP = (
    "sudo ip link set {0} up type can bitrate 1000000 dbitrate 5000000 sjw 10 dsjw 5 sample-point 0.666 "
    "dsample-point 0.666 restart-ms 1000 fd on"
)


def moteus(machine: Machine, config: Config) -> Iterator[Finding]:
    if config.rotor.hardware == "pi":
        way = _interface(machine, config.moteus.can) if config.moteus.can else _port(machine, config.moteus.port)
        yield way
        if not way.ok:
            return
    try:
        heard = machine.chips.moteus(config)
    except HardwareError as fault:
        yield wrong(str(fault), LIBRARY)
        return
    for axis in Axis:
        yield _controller(axis.value, config.moteus.of(axis).id, heard[axis])
    if config.rotor.hardware == "pi":
        yield skipped(
            "servo.timeout_mode, servopos.position_min and position_max cannot be asked for from here",
            "Look once with tview: 10 decelerates and holds when the box is silent (as sold, 12, the antenna may sag); "
            "the positions stand a little outside of min_deg and max_deg. See: rotator help isel",
        )


def _port(machine: Machine, name: str) -> Finding:
    port = serial_port(machine, name)
    if not port.ok:
        names = ", ".join(str(path) for path in machine.glob("/dev/serial/by-id/*"))
        return wrong(port.found, f"{port.advice} Known by name: {names}.") if names else port
    holder = machine.holder({name, str(machine.at(name)), str(machine.at(name).resolve())})
    if holder is None:
        return port
    if any(PurePath(word).name == "rotator" for word in holder):
        return skipped(f"{name}: the box has it, or rotator calibrate, and talks to the controllers itself")
    return wrong(f"{name} is held by {shown(holder)}", "End that program: tview and the box cannot share it.")


def _interface(machine: Machine, name: str) -> Finding:
    folder = f"/sys/class/net/{name}"
    flags = machine.text(f"{folder}/flags")
    if flags is None:
        return wrong(f"{name}: there is no such CAN interface", "Is the adapter plugged in? ip link lists them.")
    if not int(flags, 16) & UP:
        return wrong(f"{name} is down", BRING_UP.format(name))
    if machine.text(f"{folder}/mtu") != CAN_FD_MTU:
        return wrong(f"{name} is up without CAN FD", f"sudo ip link set {name} down; {BRING_UP.format(name)}")
    return fine(f"{name} is up, with CAN FD")


def _controller(axis: str, can_id: int, heard: Heard) -> Finding:
    name = f"{axis}: moteus {can_id}"
    if heard.silent:
        return wrong(
            f"{name} does not answer: {heard.silent}",
            "Its supply, the stop button, the CAN wires (H with H, L with L, 120 Ω at the end); "
            f"is its id.id {can_id}? As sold all are 1.",
        )
    found = f"{name}, {heard.volts:.1f} V, {heard.temperature_c:.0f} °C"
    if heard.fault:
        remedy = f"{heard.remedy[:1].upper()}{heard.remedy[1:]}."
        return wrong(f"{found}, stopped by itself: {heard.fault}", f"{remedy} Then acknowledge it at the box.")
    if heard.volts < LEAST_V:
        return wrong(f"{found}, which is too little", f"It needs {LEAST_V:g} to 44 V: look at its supply under load.")
    if heard.angle_deg is None:
        return warn(
            f"{found}, does not know which way the antenna points",
            f"It has been switched on. Look at the antenna; when the box runs: rotator confirm {axis} DEGREES.",
        )
    limit = f", held back by {heard.limit}" if heard.limit else ""
    return fine(f"{found}, at {heard.angle_deg:.1f}°{limit}")


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
