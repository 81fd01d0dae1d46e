"""Digital outputs and contacts on the Linux GPIO character device, through libgpiod's Python package.

Knows how to find a Raspberry Pi's header among the chips, how to take lines without a glitch, and how the kernel
records the changes of an input. Does not know what is wired to the lines. The only importer of gpiod.
"""

from __future__ import annotations

import errno
import glob
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from datetime import timedelta
from typing import Any, TypeVar

from hw.ports import ContactChange, HardwareError

PI_HEADER_LABEL = r"pinctrl-(bcm2835|bcm2711|rp1)"
"""The label of the chip with the 40-pin header. The chip's number is no key: on the Pi 5 it changed twice."""

T = TypeVar("T")

EVENTS_KEPT = 1024
"""How many changes the kernel records, its maximum: 20 s of a contact that chatters 50 times a second."""


class LinesBusyError(HardwareError):
    """Another program holds the line."""


class NoHeaderError(HardwareError):
    """This computer has no 40-pin header of a Raspberry Pi."""


def real_gpiod() -> Any:
    """The gpiod package. Raises HardwareError where it is missing, or where another package has its name."""
    try:
        import gpiod  # noqa: PLC0415 - hardware packages are imported when hardware is opened
    except ImportError as fault:
        raise HardwareError(f"GPIO: the Python package gpiod cannot be loaded: {fault}") from fault
    if not hasattr(gpiod, "request_lines"):
        raise HardwareError("GPIO: this is gpiod 1.x, another interface: install gpiod 2.1 or later in the venv")
    return gpiod


def find_chip(api: Any, label: str = PI_HEADER_LABEL, paths: list[str] | None = None) -> str:
    """The path of the first chip whose label matches the pattern. `api`: the gpiod package, or an object of its shape.

    Raises HardwareError, with a list of the chips found.
    """
    found = []
    for path in sorted(glob.glob("/dev/gpiochip*")) if paths is None else paths:
        try:
            with api.Chip(path) as chip:
                name = chip.get_info().label
        except PermissionError as fault:
            raise HardwareError(f"GPIO: no permission for {path}: add the user to the group gpio") from fault
        except OSError:
            continue
        if re.fullmatch(label, name):
            return path
        found.append(f"{path} ({name})")
    seen = ", ".join(found) if found else "none at all"
    raise NoHeaderError(f"GPIO: no chip labelled {label}; found {seen}")


def holders(api: Any, path: str, offsets: Iterable[int]) -> dict[int, str]:
    """The names of the programs that hold these lines; free lines are left out. Takes no line. Raises HardwareError."""
    with _explained(path), api.Chip(path) as chip:
        lines = [chip.get_line_info(offset) for offset in offsets]
    return {line.offset: line.consumer or "the kernel" for line in lines if line.used}


class _HeldLines:
    """Lines that this program holds until `close`. Using them later raises HardwareError."""

    def __init__(self, request: Any) -> None:
        self._request = request
        self._closed = False

    def close(self) -> None:
        """Release the lines. May be called twice."""
        self._closed = True
        self._request.release()

    def _ask(self, call: Callable[[], T], doing: str, names: Iterable[object]) -> T:
        """What the call of the request returns. `doing` and `names` are its task in words, for the HardwareError."""
        if self._closed:
            raise HardwareError(f"GPIO: cannot {doing} {', '.join(map(str, names))}: the lines have been released")
        try:
            return call()
        except OSError as fault:
            why = fault.strerror or fault
            raise HardwareError(f"GPIO: cannot {doing} {', '.join(map(str, names))}: {why}") from fault


class GpioOutputs(_HeldLines):
    """Named output lines on one chip, through `api`: a `hw.ports.OutputLines`. All are off from the request on.

    `offsets`: the GPIO number of each name. `consumer`: the name under which the lines are taken. Raises HardwareError.
    """

    def __init__(
        self, api: Any, path: str, offsets: Mapping[str, int], *, consumer: str, active_low: bool = False
    ) -> None:
        gpiod = real_gpiod()
        line = gpiod.line
        self._on, self._off = line.Value.ACTIVE, line.Value.INACTIVE
        self._offsets = dict(offsets)
        setting = gpiod.LineSettings(
            direction=line.Direction.OUTPUT, active_low=active_low, output_value=line.Value.INACTIVE
        )
        super().__init__(_taken(api, path, self._offsets, {tuple(offsets.values()): setting}, consumer=consumer))

    def set(self, levels: dict[str, bool]) -> None:
        values = {self._offsets[name]: self._on if on else self._off for name, on in levels.items()}
        self._ask(lambda: self._request.set_values(values), "switch", levels)


class GpioInputs(_HeldLines):
    """Named switches to ground on one chip, through `api`. The Pi's own resistors pull the line of an open switch high.

    `offsets`: the GPIO number of each name. Raises HardwareError.
    """

    def __init__(self, api: Any, path: str, offsets: Mapping[str, int], *, consumer: str) -> None:
        line = real_gpiod().line
        self._active = line.Value.ACTIVE
        self._offsets = dict(offsets)
        setting = real_gpiod().LineSettings(direction=line.Direction.INPUT, bias=line.Bias.PULL_UP, active_low=True)
        super().__init__(_taken(api, path, self._offsets, {tuple(offsets.values()): setting}, consumer=consumer))

    def read(self) -> dict[str, bool]:
        """Each switch by name, True: closed. Raises HardwareError."""
        values = self._ask(lambda: self._request.get_values(list(self._offsets.values())), "read", self._offsets)
        return {name: value is self._active for name, value in zip(self._offsets, values, strict=True)}


class GpioContact(_HeldLines):
    """One contact on an input line, through `api`: a `hw.ports.ContactInput`. The kernel filters the bounce.

    A change is recorded `debounce_s` seconds after the contact has come to rest; a shorter change is not seen.
    `active_low`: the line is low while the contact is closed, as with an opto-isolator to ground. `pull`: the Pi's own
    resistor pulls the line to the level of an open contact. Raises HardwareError.
    """

    def __init__(
        self,
        api: Any,
        path: str,
        offset: int,
        *,
        consumer: str,
        active_low: bool = True,
        pull: bool = True,
        debounce_s: float = 0.02,
    ) -> None:
        line = real_gpiod().line
        self._offset = offset
        self._names = (f"GPIO{offset}",)
        self._active = line.Value.ACTIVE
        self._seqno = 0
        resting = line.Bias.PULL_UP if active_low else line.Bias.PULL_DOWN
        setting = real_gpiod().LineSettings(
            direction=line.Direction.INPUT,
            edge_detection=line.Edge.BOTH,
            bias=resting if pull else line.Bias.DISABLED,
            active_low=active_low,
            debounce_period=timedelta(seconds=debounce_s),
        )
        super().__init__(
            _taken(api, path, {"contact": offset}, {offset: setting}, consumer=consumer, event_buffer_size=EVENTS_KEPT)
        )

    def closed(self) -> bool:
        value = self._ask(lambda: self._request.get_value(self._offset), "read", self._names)
        return bool(value is self._active)

    def changes(self) -> list[ContactChange]:
        return self._ask(self._read_changes, "read", self._names)

    def _read_changes(self) -> list[ContactChange]:
        changes: list[ContactChange] = []
        while self._request.wait_edge_events(0):
            for event in self._request.read_edge_events():
                # The kernel numbers the events of a line: a gap means events dropped because its buffer was full.
                lost = event.line_seqno - self._seqno - 1
                self._seqno = event.line_seqno
                closed = event.event_type.name == "RISING_EDGE"
                changes.append(ContactChange(event.timestamp_ns * 1e-9, closed, lost))
        return changes


class GpioPair(_HeldLines):
    """The two channels of an encoder, or its only one, through `api`: the kernel records their edges in one order.

    `offsets`: A, B. `pull`: the Pi's own resistors hold the lines high, for open collectors. Raises HardwareError.
    """

    def __init__(self, api: Any, path: str, offsets: tuple[int, ...], *, consumer: str, pull: bool = True) -> None:
        line = real_gpiod().line
        self._offsets = offsets
        self._names = tuple(f"GPIO{offset}" for offset in offsets)
        self._active = line.Value.ACTIVE
        self._seqno = 0
        setting = real_gpiod().LineSettings(
            direction=line.Direction.INPUT,
            edge_detection=line.Edge.BOTH,
            bias=line.Bias.PULL_UP if pull else line.Bias.DISABLED,
        )
        named = dict(zip(("channel A", "channel B"), offsets, strict=False))
        super().__init__(_taken(api, path, named, {offsets: setting}, consumer=consumer, event_buffer_size=EVENTS_KEPT))

    def levels(self) -> tuple[int, ...]:
        """A and B now: 1 is high. Raises HardwareError."""
        values = self._ask(lambda: self._request.get_values(list(self._offsets)), "read", self._names)
        return tuple(int(value is self._active) for value in values)

    def changes(self) -> list[tuple[int, int, int]]:
        """Since the last call: the channel (0: A, 1: B), its level, and how many edges before were not recorded.

        Never waits. Raises HardwareError.
        """
        return self._ask(self._read_changes, "read", self._names)

    def _read_changes(self) -> list[tuple[int, int, int]]:
        changes = []
        while self._request.wait_edge_events(0):
            for event in self._request.read_edge_events():
                lost, self._seqno = event.global_seqno - self._seqno - 1, event.global_seqno
                level = int(event.event_type.name == "RISING_EDGE")
                changes.append((self._offsets.index(event.line_offset), level, lost))
        return changes


def _taken(
    api: Any,
    path: str,
    offsets: Mapping[str, int],
    config: Mapping[Any, Any],
    *,
    consumer: str,
    event_buffer_size: int | None = None,
) -> Any:
    """A gpiod request for these lines. Raises HardwareError, with their names."""
    pins = ", ".join(f"{name} on GPIO{offset}" for name, offset in offsets.items())
    with _explained(path, f"cannot take {pins}: "):
        return api.request_lines(path, consumer=consumer, config=config, event_buffer_size=event_buffer_size)


@contextmanager
def _explained(path: str, doing: str = "") -> Iterator[None]:
    """Turn an error of gpiod into a HardwareError with what to do. `doing`: the failed task, ending in a colon."""
    try:
        yield
    except PermissionError as fault:
        raise HardwareError(f"GPIO: no permission for {path}: add the user to the group gpio") from fault
    except OSError as fault:
        if fault.errno == errno.EBUSY:
            raise LinesBusyError(f"GPIO: {path}: {doing}a line is taken by another program") from fault
        raise HardwareError(f"GPIO: {path}: {doing}{fault.strerror or fault}") from fault
    except ValueError as fault:
        raise HardwareError(f"GPIO: {path}: {fault}") from fault
