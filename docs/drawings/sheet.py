"""A sheet: parts put in their places and the nets that join their pins, by name. Knows no geometry of wires."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from itertools import count

from docs.drawings import parts
from docs.drawings.header import GPIO_PINS
from docs.drawings.parts import Part, Pin
from docs.drawings.shapes import LARGE, PLAIN, Place, Words

BLACK, RED, ORANGE = "#222", "#c62828", "#d2691e"
BLUE, GREEN, PURPLE, BROWN, TEAL, PINK = "#1f5fbf", "#2e7d32", "#7b1fa2", "#795548", "#00838f", "#c2185b"
WIDTH = 1200


@dataclass(frozen=True, slots=True)
class Net:
    colour: str
    pins: tuple[str, ...]
    """Each `part.pin`."""


@dataclass(slots=True)
class Sheet:
    file: str
    title: str
    height: int
    parts: dict[str, Part] = field(default_factory=dict)
    nets: list[Net] = field(default_factory=list)
    notes: list[Words] = field(default_factory=list)
    _numbers: count[int] = field(default_factory=count)

    def __post_init__(self) -> None:
        self.notes.append(Words((30, 36), self.title, LARGE + 2, bold=True))

    def put(self, *put: Part) -> None:
        for part in put:
            if part.name in self.parts:
                raise ValueError(f"{self.file}: two parts are called {part.name}")
            self.parts[part.name] = part

    def pin(self, name: str) -> Pin:
        """Raises KeyError for a pin that is not there."""
        part, _, pin = name.partition(".")
        return self.parts[part].pins[pin]

    def wire(self, colour: str, *pins: str) -> None:
        """Joins the pins; the first two make the trunk, the others branch off it."""
        for name in pins:
            self.pin(name)
        self.nets.append(Net(colour, pins))

    def relays(self, driven: Mapping[str, tuple[int, str]]) -> None:
        """Each relay of the part `relays`, in turn: from its GPIO, and to the pin that its contact switches. GPIO and
        colour by that pin."""
        for relay, (switched, (gpio, colour)) in reversed(list(enumerate(driven.items(), 1))):
            self.wire(colour, switched, f"relays.K{relay} NO")
            self.wire(colour, f"pi.{GPIO_PINS[gpio]}", f"relays.IN{relay}")

    def ground(self, *pins: str) -> None:
        for name in pins:
            self.put(parts.ground(f"ground {next(self._numbers)}", self.pin(name)))

    def rail(self, text: str, colour: str, *pins: str) -> None:
        for name in pins:
            self.put(parts.rail(f"rail {next(self._numbers)}", self.pin(name), text, colour))

    def note(self, at: Place, *lines: str, size: int = PLAIN, bold: bool = False) -> None:
        self.notes += [Words((at[0], at[1] + 24 * row), line, size, bold=bold) for row, line in enumerate(lines)]

    def words(self) -> list[Words]:
        """All that stands outside the parts."""
        return [*self.notes, *(label for part in self.parts.values() for label in part.labels)]
