"""A marked block of our lines in a file of the system: inserts, updates and removes it, and leaves no trace.

Knows lines and marks, not what the lines mean. In a file without a line feed at its end, the block at the end has none
either. So the line feed before that block is ours, and is removed with it.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from rotator.setup.plan import SetupError, lines


@dataclass(frozen=True, slots=True)
class Block:
    name: str
    """The name in the marks: the command that wrote the block."""
    ours: re.Pattern[str]
    """The pattern of our lines. Other lines inside the marks were added by the user, and stay."""
    last: bool = False
    """The block is at the end of the file; else at its top."""

    @property
    def begin(self) -> str:
        return f"# {self.name}: begin"

    @property
    def end(self) -> str:
        return f"# {self.name}: end"

    def into(self, text: str, wanted: Sequence[str]) -> str:
        """The text with these lines in the block. An old block is replaced in its place; no lines, no block.

        Raises SetupError if only one of the two marks is there.
        """
        rest = self.without(text)
        if not wanted:
            return rest
        place = self._place(text)
        if place is None:
            place = len(rest) if self.last else 0
        before, after = rest[:place], rest[place:]
        line_end = "\r\n" if next(iter(lines(rest)), "").endswith("\r\n") else "\n"
        block = line_end.join([self.begin, *wanted, self.end])
        if before and not before.endswith("\n"):
            return before + line_end + block
        return before + block + line_end + after

    def without(self, text: str) -> str:
        """The text without the block. Raises SetupError if only one of the two marks is there."""
        kept: list[str] = []
        line_end = ""
        inside = False
        for line in lines(text):
            match line.strip():
                case self.begin if not inside:
                    inside = True
                    line_end = line[len(line.rstrip("\r\n")) :]
                case self.end if inside:
                    inside = False
                    if not line.endswith("\n") and kept:
                        kept[-1] = kept[-1].removesuffix(line_end)
                case self.begin | self.end:
                    raise self._torn()
                case bare if inside and self.ours.fullmatch(bare):
                    continue
                case _:
                    kept.append(line)
        if inside:
            raise self._torn()
        return "".join(kept)

    def strangers(self, text: str) -> list[str]:
        """The lines that the user has added inside the marks."""
        inside = False
        found = []
        for line in map(str.strip, lines(text)):
            if line in (self.begin, self.end):
                inside = line == self.begin
            elif inside and not self.ours.fullmatch(line):
                found.append(line)
        return found

    def _place(self, text: str) -> int | None:
        before = 0
        for line in lines(text):
            if line.strip() == self.begin:
                return before
            before += len(line)
        return None

    def _torn(self) -> SetupError:
        return SetupError(
            f'only one of the two marks "{self.begin}" and "{self.end}" is left: '
            "remove that line, and the lines that belonged to it, by hand"
        )
