"""The checks of chips that are told and tell nothing: a PCA9685 of servos or panel, digital pots on the kernel's SPI.

Knows what such a chip looks like before and after the box has started. Tells none of them anything.
"""

from __future__ import annotations

import os
from collections.abc import Iterator

from hw.ports import Axis, HardwareError
from rotator.config.model import Config
from rotator.doctor.bus import chip_name
from rotator.doctor.chips import OutputBoard
from rotator.doctor.finding import Finding, fine, skipped, wrong
from rotator.doctor.machine import Machine
from rotator.doctor.wires import box_is_running

BOARDS = ("servo.address", "panel.outputs_address")
SELECTS = {8: 0, 7: 1}
"""The selects of the kernel's SPI, by GPIO: CE0 and CE1."""

SPIDEV = (
    "Installed by install.sh: sudo ./install.sh puts it in, now that the file asks for it (it needs gcc and "
    "python3-dev). Else pip install 'spidev>=3.6' in the program's venv; or digipot.spi = \"lines\"."
)


def boards(config: Config) -> list[tuple[int, int, str]]:
    return [chip for chip in config.chips() if chip[2] in BOARDS]


def has_boards(config: Config) -> bool:
    return bool(boards(config))


def output_boards(machine: Machine, config: Config) -> Iterator[Finding]:
    try:
        is_running: bool | None = box_is_running(machine, config)
    except HardwareError:
        is_running = None
    for number, address, key in boards(config):
        name = f"{chip_name(key)}: 0x{address:02x}"
        try:
            with machine.chips.bus(number) as bus:
                if not bus.answers(address):
                    yield skipped(f"{name} does not answer")
                    continue
                yield _board(name, machine.chips.output_board(bus, address), is_running=is_running)
        except HardwareError:
            yield skipped(f"{name}: the bus cannot be asked")


def _board(name: str, board: OutputBoard, *, is_running: bool | None) -> Finding:
    if not board.plausible:
        return wrong(
            f"{name} is no PCA9685: MODE1 0x{board.mode:02x}, PRE_SCALE 0x{board.prescale:02x}",
            "Another chip has this address: see which of them is where with i2cdetect, and move one.",
        )
    if board.waits_for_a_clock:
        return wrong(
            f"{name} waits for a clock from outside, and makes no pulse",
            "Some program has told it to; only switching its 3.3 V off and on ends that.",
        )
    if is_running and board.asleep:
        return wrong(
            f"{name} has been reset since the box started: no pulses",
            "Its supply dips: VCC from the Pi's 3.3 V, V+ from a supply of its own, and a capacitor there.",
        )
    state = "asleep until the box starts" if board.asleep else "awake"
    if not board.asleep and is_running is False:
        state = "still makes the pulses of the last run, as far as OE lets them out"
    return fine(f"{name} is a PCA9685, {state}")


def uses_spi(config: Config) -> bool:
    return config.rotor.type == "digipot" and config.digipot.spi == "kernel"


def spi(machine: Machine, config: Config) -> Iterator[Finding]:
    try:
        machine.chips.spidev()
    except HardwareError as fault:
        yield wrong(str(fault), SPIDEV)
    if config.rotor.hardware == "sim":
        yield fine("both digital pots")
        return
    for axis in Axis:
        yield _device(machine, f"digipot.{axis.value}.select", getattr(config.digipot, axis.value).select)


def _device(machine: Machine, key: str, pin: int) -> Finding:
    if pin not in SELECTS:
        return wrong(f"{key} = {pin} is no select of the kernel's SPI", f'{key} = 8 or 7; or digipot.spi = "lines".')
    name = f"/dev/spidev0.{SELECTS[pin]}"
    path = machine.at(name)
    if not path.exists():
        return wrong(f"{name} is not there", "sudo rotator setup pins switches it on (dtparam=spi=on); then reboot.")
    if not os.access(path, os.R_OK | os.W_OK):
        return wrong(f"{name}: not yours", f"sudo usermod -aG spi {machine.user}, then log in again.")
    return fine(f"{name} is there and may be opened")
