"""One JSON file with a format name, replaced as a whole: the form of each file in which the box stores something.

The name has a number, "rotator counts 1", and steps from an earlier number to the present. Knows that a damaged or
foreign file must not stop the box, and that the file of a later version stays as it is. Does not know what the content
means: each store has its own `parse`.
"""

from __future__ import annotations

import json
import logging
import re
import reprlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

from rotator.exchange.foreign import json_of
from rotator.store.whole import write_block, write_whole

log = logging.getLogger(__name__)

T = TypeVar("T")

Parse = Callable[[dict[str, Any]], T]
"""From the file's content to a value. Raises ValueError, KeyError, TypeError or AttributeError for damaged content."""
LONGEST_BYTES = 100_000
"""A hundred times what any of these files holds: a larger one is another's."""


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


def encode(form: Form, content: Mapping[str, object]) -> str:
    """The file's text."""
    return json.dumps({"format": form.today, **content}, indent=1) + "\n"


def decode(form: Form, text: str, parse: Parse[T]) -> T:
    """The value in the file's text. Raises LaterFormError; ValueError where the text is damaged, or of another form."""
    try:
        return parse(form.brought_up(json_of(text)))
    except LaterFormError:
        raise
    except (ValueError, KeyError, TypeError, AttributeError) as fault:
        raise ValueError(damage(fault)) from fault


def damage(fault: Exception) -> str:
    """The error in the content of a file, in words."""
    if isinstance(fault, KeyError):
        return f"the key {fault.args[0]} is missing"
    return str(fault) or type(fault).__name__


def number(value: object, name: str, least: float, most: float) -> float:
    """A number within bounds, from a file. Raises ValueError, with the value in a few characters."""
    # Compared before it becomes a float: a whole number of 400 digits has no float. NaN is not within any bounds.
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not least <= value <= most:
        raise ValueError(f"{name} is {reprlib.repr(value)}; it must be a number from {least:g} to {most:g}")
    return float(value)


class JsonFile:
    """`description`: of the content, in a few words, for the log. `one_block`: it is written often, in place, and has a
    check sum.

    `load` and `save` raise nothing: their failures go to the log.
    """

    def __init__(self, path: Path, form: Form, description: str, *, one_block: bool = False) -> None:
        self.path = path
        self._write = write_block if one_block else write_whole
        self.trouble = ""
        """The reason of the last failed write; empty after a good one."""
        self._form = form
        self._description = description
        self._seen: tuple[int, ...] | None = None
        """The mark of the file as it was read or written last; None: there was none."""
        self.later = ""
        """Why the file belongs to another version, and stays as it is; empty: it is of this version."""

    def load(self, parse: Parse[T], *, absent: T, damaged: T, consequence: str) -> T:
        """The value in the file; `absent` without a file; `damaged` if the file cannot be read or parsed.

        `consequence`: for the log: the effect of a damaged file on the box.
        """
        try:
            self._seen = self._mark()
            return decode(self._form, self._text(), parse)
        except FileNotFoundError:
            return absent
        except LaterFormError as fault:
            self.later = f"{fault}; update the program, or move the file away"
            log.warning("%s: %s: %s. The file stays as it is", self.path, consequence, self.later)
            return damaged
        except (OSError, ValueError) as fault:
            log.warning("%s: %s: %s", self.path, consequence, fault)
            return damaged

    @property
    def changed(self) -> bool:
        """Whether another program or a person has changed, emptied or deleted the file since. What the box knows stays,
        and is to be written again."""
        return not self.trouble and self.touched

    @property
    def touched(self) -> bool:
        """As `changed`, also by a write of the box that failed halfway."""
        return self._mark() != self._seen

    def _mark(self) -> tuple[int, ...] | None:
        try:
            now = self.path.stat()
        except OSError:
            return None
        return now.st_ino, now.st_size, now.st_mtime_ns

    def _text(self) -> str:
        """The text of the file. Raises OSError; ValueError: no text, or too large."""
        if self.path.exists() and not self.path.is_file():
            raise ValueError("it is no file")  # a pipe would keep the start waiting
        with self.path.open("rb") as file:
            content = file.read(LONGEST_BYTES + 1)
        if len(content) > LONGEST_BYTES:
            raise ValueError(f"it is longer than {LONGEST_BYTES} bytes")
        return content.decode("utf-8")

    def save(self, content: Mapping[str, object]) -> bool:
        """Replace the file as a whole. False: the write failed. The log has each new reason once."""
        try:
            if self.later:
                raise OSError(self.later)
            self.path.parent.mkdir(parents=True, exist_ok=True)
            self._write(self.path, encode(self._form, content))
            # Deleted in this moment, it is not as it was written.
            self._seen = self._mark() or ()
        except OSError as fault:
            if str(fault) != self.trouble:
                log.error("%s: %s cannot be kept: %s", self.path, self._description, fault)
            self.trouble = str(fault)
            return False
        self.trouble = ""
        return True
