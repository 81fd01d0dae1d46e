"""A mistake in a configuration file: what is wrong there, what to write instead, and its lines; and all of one file.

Knows how a mistake is shown. Finds none.
"""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from dataclasses import dataclass

_ORDER = ("first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth", "ninth", "tenth")


def counted(name: str, index: int) -> str:
    """One of several tables `[[name]]`, as people count them. `index`: from 0."""
    return f"the {_ORDER[index] if index < len(_ORDER) else f'{index + 1}th'} [[{name}]]"


@dataclass(frozen=True, slots=True)
class Mistake:
    text: str
    lines: tuple[int, ...] = ()
    """The lines of the file that it is about, from 1; empty where no line is to blame."""

    def __str__(self) -> str:
        text = "".join(mark if mark.isprintable() else mark.encode("unicode_escape").decode() for mark in self.text)
        if not self.lines:
            return text
        *first, last = self.lines
        where = f"lines {', '.join(map(str, first))} and {last}" if first else f"line {last}"
        return f"{where}: {text}"

    def wrapped(self, columns: int) -> str:
        """No word is broken unless it is longer than a line."""
        return textwrap.fill(str(self), columns, initial_indent="  ", subsequent_indent="    ", break_on_hyphens=False)

    @property
    def place(self) -> int:
        """For the order of the file: first what concerns the whole of it."""
        return self.lines[0] if self.lines else 0


class ConfigError(Exception):
    """The file cannot be used. `mistakes`: one for each thing to change, in the order of the file."""

    def __init__(self, name: str, mistakes: Sequence[Mistake]) -> None:
        super().__init__(name, mistakes)
        self.name = name
        self.mistakes = sorted(dict.fromkeys(mistakes), key=lambda mistake: mistake.place)

    def __str__(self) -> str:
        return "\n".join((self._heading, *(f"  {mistake}" for mistake in self.mistakes)))

    def wrapped(self, columns: int) -> str:
        """As `str`, for a terminal of this width."""
        return "\n".join((self._heading, *(mistake.wrapped(columns) for mistake in self.mistakes)))

    @property
    def _heading(self) -> str:
        return f"{self.name}: {'1 mistake' if len(self.mistakes) == 1 else f'{len(self.mistakes)} mistakes'}"
