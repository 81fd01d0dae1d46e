"""GPIO chips of the kernel's own simulator, gpio-sim, made and taken away through configfs.

Knows how a chip is made and how the outside of its pins is read and pulled. Does not know who drives the lines.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from itertools import count
from pathlib import Path
from typing import Self

CONFIG = Path("/sys/kernel/config/gpio-sim")
PERSIST = Path("/sys/module/gpio_sim/parameters/persist")
HEADER_LABEL = "pinctrl-bcm2711"
LINES = 58

_serial = count()


class GpioChip:
    """One chip, with the label and the line names of a Raspberry Pi 4's header unless told otherwise."""

    def __init__(self, label: str = HEADER_LABEL, lines: int = LINES, names: Mapping[int, str] | None = None) -> None:
        self._config = CONFIG / f"bench-{os.getpid()}-{next(_serial)}"
        self._bank = self._config / "bank"
        self._bank.mkdir(parents=True)
        (self._bank / "num_lines").write_text(str(lines))
        (self._bank / "label").write_text(label)
        for offset, name in ({} if names is None else names).items():
            (self._bank / f"line{offset}").mkdir()
            (self._bank / f"line{offset}/name").write_text(name)
        (self._config / "live").write_text("1")
        self.name = (self._bank / "chip_name").read_text().strip()
        self.path = f"/dev/{self.name}"
        device = (self._config / "dev_name").read_text().strip()
        self.lines = Path(f"/sys/devices/platform/{device}/{self.name}")
        """Where the outside of its pins is: sim_gpioN/value to look at, sim_gpioN/pull to pull."""
        self._open: dict[int, int] = {}

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    def level(self, offset: int) -> bool:
        """The physical level of a pin. Takes 20 us from the second time on: fit for a plant's loop."""
        if offset not in self._open:
            self._open[offset] = os.open(self.lines / f"sim_gpio{offset}/value", os.O_RDONLY)
        return os.pread(self._open[offset], 1, 0) == b"1"

    def pull(self, offset: int, up: bool) -> None:
        """Pull a pin from outside; an input then reads it, an output keeps its own level."""
        (self.lines / f"sim_gpio{offset}/pull").write_text("pull-up" if up else "pull-down")

    def close(self) -> None:
        for fd in self._open.values():
            os.close(fd)
        self._open.clear()
        (self._config / "live").write_text("0")
        for line in self._bank.glob("line*"):
            line.rmdir()
        self._bank.rmdir()
        self._config.rmdir()

    def first_number(self) -> int:
        """The kernel's own number of line 0, as tracing names it."""
        for chip in Path("/sys/class/gpio").glob("gpiochip*"):
            if chip.resolve().is_relative_to(self.lines.parent):
                return int((chip / "base").read_text())
        raise LookupError(f"{self.path} is not in /sys/class/gpio")


@contextmanager
def persisting(on: bool) -> Iterator[None]:
    """Lines that are let go of stay driven, as on Raspberry Pi kernels; off: they fall back to their pull."""
    before = PERSIST.read_text()
    PERSIST.write_text("1" if on else "0")
    try:
        yield
    finally:
        PERSIST.write_text(before)
