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
    was: str = ""
    """The beginning of a line inside the marks that stood here before, and comes back; empty: there are none."""

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
        old = self._found.search(text)
        rest = self.without(text)
        if not wanted:
            return rest
        place = old.start() if old else len(rest) if self.last else 0
        return self.between(rest[:place], wanted, rest[place:])

    def between(self, before: str, wanted: Sequence[str], after: str) -> str:
        """The text with a block of these lines at this place."""
        line_end = "\r\n" if next(iter(lines(before + after)), "").endswith("\r\n") else "\n"
        block = line_end.join([self.begin, *wanted, self.end])
        if before and not before.endswith("\n"):
            return before + line_end + block
        return before + block + line_end + after

    def without(self, text: str) -> str:
        """The text without the block. Raises SetupError if only one of the two marks is there."""
        blocks = list(self._found.finditer(text))
        rest = self._found.sub(
            lambda block: "".join(line.removeprefix(self.was) for line in self._strange(block["inside"])), text
        )
        if re.search(rf"^[^\S\n]*{re.escape(f'# {self.name}: ')}(begin|end)[^\S\n]*$", rest, re.MULTILINE):
            raise self._torn()
        if blocks and not blocks[-1][0].endswith("\n"):
            return rest.removesuffix(blocks[-1]["line_end"])
        return rest

    def strangers(self, text: str) -> list[str]:
        """The lines that the user has added inside the marks."""
        inside = [line for block in self._found.finditer(text) for line in self._strange(block["inside"])]
        return [line.strip() for line in inside if not (self.was and line.startswith(self.was))]

    @property
    def _found(self) -> re.Pattern[str]:
        blank = r"[^\S\n]*"
        begin, end = (rf"^{blank}{re.escape(mark)}" for mark in (self.begin, self.end))
        return re.compile(
            rf"{begin}[^\S\r\n]*(?P<line_end>\r*\n)(?P<inside>(?:.*\n)*?){end}{blank}(?:\n|\Z)", re.MULTILINE
        )

    def _strange(self, inside: str) -> list[str]:
        return [line for line in lines(inside) if not self.ours.fullmatch(line.strip())]

    def _torn(self) -> SetupError:
        return SetupError(
            f'only one of the two marks "{self.begin}" and "{self.end}" is left: '
            "remove that line, and the lines that belonged to it, by hand"
        )
