"""The checks of the PCA9685 boards of servos and panel, and of the kernel's SPI devices.

Knows the state of a PCA9685 before and after the start of the box. Writes to no chip.
"""

from __future__ import annotations

from collections.abc import Iterator

from hw.ports import HardwareError
from rotator.assembly.chips import OutputBoard
from rotator.config.chips import KERNEL_SELECTS, I2CChip, SpiUse
from rotator.config.model import Config
from rotator.doctor.chips import chip_name
from rotator.doctor.finding import Finding, fine, skipped, wrong
from rotator.doctor.machine import Machine
from rotator.doctor.wires import box_is_running

SPIDEV = (
    "sudo ./install.sh installs it, now that the file needs it (with gcc and "
    "python3-dev). Without install.sh: pip install 'spidev>=3.6' in the program's venv"
)
ON_LINES_TOO = ("adc", "digipot")
"""The tables whose chips may be on any GPIO lines."""


def boards(config: Config) -> list[I2CChip]:
    return [chip for chip in config.chips() if chip.part == "PCA9685"]


def output_boards(machine: Machine, config: Config) -> Iterator[Finding]:
    is_running = box_is_running(machine, config)
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


def pwm(machine: Machine, _config: Config) -> Iterator[Finding]:
    try:
        yield fine(f"{machine.chips.pwm()}: at the header's pins")
    except HardwareError as fault:
        yield wrong(str(fault), 'docs/paths/slew-drive.md, "Wire it", or docs/speed.md.')


def kernels_spi(config: Config) -> list[SpiUse]:
    return [use for use in config.spi_uses() if use.kernel]


def spi(machine: Machine, config: Config) -> Iterator[Finding]:
    uses = kernels_spi(config)
    try:
        machine.chips.spidev()
    except HardwareError as fault:
        lines = [f'; or {use.table}.spi = "lines"' for use in uses if use.table in ON_LINES_TOO]
        yield wrong(str(fault), SPIDEV + "".join(lines[:1]) + ".")
    for use in uses:
        if config.simulated:
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
    return machine.opens(name, "spi", "sudo rotator setup pins switches it on (dtparam=spi=on); then reboot.")
