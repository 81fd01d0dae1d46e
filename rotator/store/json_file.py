"""A small JSON file that is written whole: the form that everything the box keeps from one run to the next has.

Knows the file's format name, and that a damaged or foreign file must not stop the box. Does not know what the content
means: each store brings its own `parse`.
"""

from __future__ import annotations

import json
import logging
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, TypeVar

from rotator.store.whole import write_whole

log = logging.getLogger(__name__)

T = TypeVar("T")

Parse = Callable[[dict[str, Any]], T]
"""From the file's content to a value. May raise ValueError, KeyError, TypeError or AttributeError: it is damaged."""


def encode(form: str, content: Mapping[str, object]) -> str:
    return json.dumps({"format": form, **content}, indent=1) + "\n"


def decode(form: str, text: str, parse: Parse[T]) -> T:
    """Raises ValueError where the text is damaged or has another format name than `form`."""
    try:
        content = json.loads(text)
        if not isinstance(content, dict) or content.get("format") != form:
            raise ValueError("it is not the box's")
        return parse(content)
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError) as fault:
        raise ValueError(str(fault) or type(fault).__name__) from fault


class JsonFile:
    """`form`: the format name. `what`: the content in a few words, for the log. Neither `load` nor `save` raises."""

    def __init__(self, path: Path, form: str, what: str) -> None:
        self.path = path
        self.trouble = ""
        """Why the file could not be written the last time; empty: it was."""
        self._form = form
        self._what = what

    def load(self, parse: Parse[T], *, absent: T, damaged: T, consequence: str) -> T:
        """The value in the file. `absent`: the value without a file; `damaged`: with one that cannot be trusted.

        `consequence` tells the log's reader what a damaged file means for the box.
        """
        try:
            return decode(self._form, self.path.read_text(encoding="utf-8"), parse)
        except FileNotFoundError:
            return absent
        except (OSError, ValueError) as fault:
            log.warning("%s: %s: %s", self.path, consequence, fault)
            return damaged

    def save(self, content: Mapping[str, object]) -> bool:
        """Write the file, whole or not at all. False: it could not be written; the log has each reason once."""
        try:
            self.path.parent.mkdir(parents=True, exist_ok=True)
            write_whole(self.path, encode(self._form, content))
        except OSError as fault:
            if str(fault) != self.trouble:
                log.error("%s: %s cannot be kept: %s", self.path, self._what, fault)
            self.trouble = str(fault)
            return False
        self.trouble = ""
        return True
