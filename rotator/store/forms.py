"""The name of a file's form with its number, `rotator counts 1`, and the steps from an earlier number to the present.

Knows that a file may come from an earlier version of the program, or from a later one. Does not know any content.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

Step = Callable[[dict[str, Any]], dict[str, Any]]
"""From the content of a file in one form to the content in the next. Raises what a damaged content raises."""


class LaterFormError(ValueError):
    """A later version of the program wrote this file: this version can neither read it, nor may it overwrite it."""


@dataclass(frozen=True, slots=True)
class Form:
    """`steps`: one for each earlier number, the first from 1 to 2. So a file of any age can be read.

    A change of a file's content adds a step, and the present number rises with it.
    """

    name: str
    steps: tuple[Step, ...] = ()

    @property
    def today(self) -> str:
        return f"{self.name} {self._number}"

    @property
    def _number(self) -> int:
        return 1 + len(self.steps)

    def brought_up(self, content: object) -> dict[str, Any]:
        """The content in the present form. Raises LaterFormError; ValueError: it belongs to another file."""
        format_name = content.get("format") if isinstance(content, dict) else None
        found = (
            re.fullmatch(rf"{re.escape(self.name)} ([1-9]\d{{0,5}})", format_name)
            if isinstance(format_name, str)
            else None
        )
        if not isinstance(content, dict) or found is None:
            raise ValueError(f"its format is not {self.today!r}")
        if (number := int(found[1])) > self._number:
            raise LaterFormError(
                f"a later version of the program wrote it: its format is {format_name!r}, not {self.today!r}"
            )
        for step in self.steps[number - 1 :]:
            content = step(content)
        return content
