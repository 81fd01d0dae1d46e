"""Opens the relays of a program that has died, for the service manager: `python -I -S off_at_once.py FILE`.

The program wrote FILE before: the chip, the level that means on, and the lines. A start of Python with its packages
takes seconds on a small Pi, and the motor runs meanwhile. So this file loads almost nothing: no package, no other file
of the project, no configuration. It asks the kernel itself (linux/gpio.h, second version of the interface) for the
lines as outputs that are off, and gives them back. A brake that is off engages later than the relays open: on a beam
that still turns it would break the gear. Does not know what the other lines switch.
"""

from __future__ import annotations

import errno
import fcntl
import os
import struct
import sys
import time

TAKE_LINES = 0xC250B407  # GPIO_V2_GET_LINE_IOCTL
READ_LINES = 0xC010B40E  # GPIO_V2_LINE_GET_VALUES_IOCTL
OUTPUT, ACTIVE_LOW = 0b1000, 0b10  # GPIO_V2_LINE_FLAG_...
MOST_LINES = 64
REQUEST = struct.Struct(f"={MOST_LINES}I32sQ264x2I20xi")
"""struct gpio_v2_line_request: the offsets, the consumer, the flags, then no attributes (every output begins inactive),
the number of lines, the size of a buffer for events, and the lines' file, which the kernel fills in."""
LEVELS = {"active-high": False, "active-low": True}
RETRY_S = 0.002
"""The pause, in seconds, before the next try: a dead process holds its lines until the kernel has cleaned up."""
PATIENCE_S = 5.0
BRAKE = "_brake"
"""How the name of a brake's line ends. On: the brake is off."""
BRAKE_AFTER_S = 3.0
"""The brake of a program that has died engages so long after its relays have opened."""


def described(chip: str, lines: dict[str, int], *, active_low: bool) -> str:
    """The lines as one line of text."""
    level = next(name for name, low in LEVELS.items() if low is active_low)
    return " ".join([chip, level, *(f"{name}={offset}" for name, offset in lines.items())])


def understood(text: str) -> tuple[str, dict[str, int], bool]:
    """The chip, the lines, whether they are active low. Raises ValueError for a text that `described` did not make."""
    try:
        chip, level, *lines = text.split()
        pairs = [line.split("=") for line in lines]
        return chip, {name: int(offset) for name, offset in pairs}, LEVELS[level]
    except (ValueError, KeyError):
        raise ValueError(f"not a description of relay lines: {text[:60]!r}") from None


def request(offsets: list[int], *, active_low: bool, output: int = OUTPUT) -> bytearray:
    """The request to the kernel: these lines as outputs that are off. `output` 0: as they are now."""
    flags = output | (ACTIVE_LOW if active_low else 0)
    padded = offsets + [0] * (MOST_LINES - len(offsets))
    return bytearray(REQUEST.pack(*padded, b"rotator-off", flags, len(offsets), 0, 0))


def switch_off(chip: str, offsets: list[int], *, active_low: bool, patience_s: float = PATIENCE_S) -> None:
    """Take the lines at their off level, and release them. Raises OSError; EBUSY: a program still holds them."""
    os.close(_taken(chip, offsets, patience_s, active_low=active_low, output=OUTPUT))


def any_on(chip: str, offsets: list[int], *, active_low: bool, patience_s: float = PATIENCE_S) -> bool:
    """Whether one of these lines is on. Changes nothing. Raises OSError, as `switch_off`."""
    lines = _taken(chip, offsets, patience_s, active_low=active_low, output=0)
    try:
        values = bytearray(struct.pack("=QQ", 0, (1 << len(offsets)) - 1))
        fcntl.ioctl(lines, READ_LINES, values)
        return any(values[:8])
    finally:
        os.close(lines)


def _taken(chip: str, offsets: list[int], patience_s: float, *, active_low: bool, output: int) -> int:
    """The file of the lines. Raises OSError."""
    give_up_s = time.monotonic() + patience_s
    file = os.open(chip, os.O_RDWR | os.O_CLOEXEC)
    while True:
        asked = request(offsets, active_low=active_low, output=output)
        try:
            fcntl.ioctl(file, TAKE_LINES, asked)
        except OSError as fault:
            if fault.errno != errno.EBUSY or time.monotonic() >= give_up_s:
                raise
            time.sleep(RETRY_S)
        else:
            return int(REQUEST.unpack(asked)[-1])


def main(arguments: list[str]) -> int:
    (path,) = arguments
    try:
        with open(path, encoding="utf-8") as file:
            chip, lines, active_low = understood(file.read())
    except FileNotFoundError:
        return 0  # the program did not take its lines before it ended, or it ran a simulation
    brakes = [offset for name, offset in lines.items() if name.endswith(BRAKE)]
    switch_off(chip, [offset for offset in lines.values() if offset not in brakes], active_low=active_low)
    if brakes:
        if any_on(chip, brakes, active_low=active_low):
            time.sleep(BRAKE_AFTER_S)
        switch_off(chip, brakes, active_low=active_low)
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except (OSError, ValueError) as fault:
        sys.exit(f"relays: {fault}")
