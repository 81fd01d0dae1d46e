"""The checks of the PCA9685 boards of servos and panel, and of the kernel's SPI devices.

Knows the state of a PCA9685 before and after the start of the box. Writes to no chip.
"""

from __future__ import annotations

import os
from collections.abc import Iterator

from hw.ports import HardwareError
from rotator.assembly.chips import OutputBoard
from rotator.config.chips import KERNEL_SELECTS, I2CChip, SpiUse
from rotator.config.model import Config
from rotator.doctor.bus import chip_name
from rotator.doctor.finding import Finding, fine, skipped, wrong
from rotator.doctor.machine import Machine
from rotator.doctor.wires import box_is_running

SPIDEV = (
    "sudo ./install.sh installs it, now that the file needs it (with gcc and "
    "python3-dev). Without install.sh: pip install 'spidev>=3.6' in the program's venv;"
)


def boards(config: Config) -> list[I2CChip]:
    return [chip for chip in config.chips() if chip.part == "PCA9685"]


def has_boards(config: Config) -> bool:
    return bool(boards(config))


def output_boards(machine: Machine, config: Config) -> Iterator[Finding]:
    try:
        is_running: bool | None = box_is_running(machine, config)
    except HardwareError:
        is_running = None
    for chip in boards(config):
        name = f"{chip_name(chip.key)}: 0x{chip.address:02x}"
        try:
            with machine.chips.bus(chip.bus) as bus:
                if not bus.answers(chip.address):
                    yield skipped(f"{name} does not answer")
                    continue
                yield _board(name, machine.chips.output_board(bus, chip.address), is_running=is_running)
        except HardwareError:
            yield skipped(f"{name}: the bus cannot be read")


def _board(name: str, board: OutputBoard, *, is_running: bool | None) -> Finding:
    if not board.plausible:
        return wrong(
            f"{name} is no PCA9685: MODE1 0x{board.mode:02x}, PRE_SCALE 0x{board.prescale:02x}",
            "Another chip has this address: look with i2cdetect, and give one of them another address.",
        )
    if board.waits_for_a_clock:
        return wrong(
            f"{name} waits for a clock from outside, and makes no pulse",
            "A program has set it so; only switching its 3.3 V off and on ends that.",
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
    return any(use.kernel for use in config.spi_uses())


def spi(machine: Machine, config: Config) -> Iterator[Finding]:
    uses = [use for use in config.spi_uses() if use.kernel]
    try:
        machine.chips.spidev()
    except HardwareError as fault:
        yield wrong(str(fault), f'{SPIDEV} or {uses[0].table}.spi = "lines".')
    for use in uses:
        if config.rotor.hardware == "sim":
            yield fine(use.chips)
            continue
        for key, pin in use.selects.items():
            yield _device(machine, use, key, pin)


def _device(machine: Machine, use: SpiUse, key: str, pin: int) -> Finding:
    if pin not in KERNEL_SELECTS:
        return wrong(
            f"{use.table}.{key} = {pin} is no select of the kernel's SPI",
            f'{use.table}.{key} = 8 or 7; or {use.table}.spi = "lines".',
        )
    name = f"/dev/spidev0.{KERNEL_SELECTS[pin]}"
    path = machine.at(name)
    if not path.exists():
        return wrong(f"{name} is not there", "sudo rotator setup pins switches it on (dtparam=spi=on); then reboot.")
    if not os.access(path, os.R_OK | os.W_OK):
        return wrong(f"{name}: you may not open it", f"sudo usermod -aG spi {machine.user}, then log in again.")
    return fine(f"{name} is there and may be opened")
