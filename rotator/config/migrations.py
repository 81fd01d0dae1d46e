"""Brings a file of an earlier format up to today's, before its keys are looked at: an old file works for ever.

Knows the number at the top of a file, and each step from one format to the next; comments stay. A file without a number
is of format 1. A new key needs no new format; one that is renamed, or means something else, does. What the keys are,
the model knows. The file itself changes only when a calibration is saved in it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from rotator.exchange.foreign import toml_of

if TYPE_CHECKING:
    from tomlkit import TOMLDocument

Step = Callable[["TOMLDocument"], None]
"""Changes a document of one format into the next."""
STEPS: tuple[Step, ...] = ()
"""The first from format 1 to 2. Beside a new one, files of the format before it go into tests/formats."""
KEY = "format"
"""A number above all tables. Left out, it is 1."""


class FormatError(ValueError):
    """The number is none, or a later version's. The text says what to do."""


def values(text: str, steps: Sequence[Step] = STEPS) -> dict[str, Any]:
    """The keys of the file as today's model knows them, without the number. Raises like `brought_up`."""
    found = toml_of(text)
    if _number(found, steps) <= len(steps):
        found = toml_of(brought_up(text, steps))
    found.pop(KEY, None)
    return found


def brought_up(text: str, steps: Sequence[Step] = STEPS) -> str:
    """The text in today's format. Raises FormatError, and ValueError where it is no TOML."""
    number, today = _number(toml_of(text), steps), 1 + len(steps)
    if number == today:
        return text
    import tomlkit  # noqa: PLC0415 - slow to load, and a file of today's format does without it

    document = tomlkit.parse(text)
    for step in steps[number - 1 :]:
        step(document)
    if KEY in document:
        document[KEY] = today
        return tomlkit.dumps(document)
    return f"{KEY} = {today}\n\n{tomlkit.dumps(document)}"


def _number(keys: Mapping[str, Any], steps: Sequence[Step]) -> int:
    """The format of a file with these keys. Raises FormatError."""
    number, today = keys.get(KEY, 1), 1 + len(steps)
    if not isinstance(number, int) or isinstance(number, bool) or number < 1:
        raise FormatError(
            f"{KEY} = {number!r}: must be a whole number from 1 to {today}; a file without it is of format 1"
        )
    if number > today:
        raise FormatError(
            f"{KEY} = {number}: a later version of the program wrote this file, and this one reads {KEY}s up to "
            f"{today}: update the program, or take the file from before the update (.bak)"
        )
    return number
