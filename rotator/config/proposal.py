"""A change of the configuration file before it is written: the new text, what differs, and what the loader says of it.

Knows the file, and that two people may change it at the same time: each names the text that it started from. Does not
know who asks, nor what happens to the box afterwards.
"""

from __future__ import annotations

import difflib
import hashlib
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rotator.config import migrations
from rotator.config.load import ConfigError, parse
from rotator.config.model import Config
from rotator.config.statements import Place, statements
from rotator.config.toml_text import WRITING, read, replace


class OverwritesError(Exception):
    """The file has another text than the one that the change started from."""

    def __init__(self) -> None:
        super().__init__("the file has been changed meanwhile, by another browser or at the box: load it anew")


@dataclass(frozen=True, slots=True)
class FormMistake:
    """A mistake of a text, for a form. `places`: the keys or tables that it is about; empty: the whole file."""

    text: str
    places: tuple[Place, ...]


@dataclass(frozen=True, slots=True)
class KeyChange:
    """One key with its two values, or a whole table of a list such as a link. None: it is not in the file."""

    place: Place
    before: Any
    after: Any


@dataclass(frozen=True, slots=True)
class Settings:
    """What a file says now. `config`: None where it has a mistake."""

    text: str
    values: dict[str, Any]
    config: Config | None

    @property
    def digest(self) -> str:
        return digest(self.text)


@dataclass(frozen=True, slots=True)
class Proposal:
    before: str
    after: str
    mistakes: tuple[FormMistake, ...]

    @property
    def diff(self) -> list[str]:
        """The lines that change, with two around them. Empty: nothing changes."""
        rows = difflib.unified_diff(self.before.splitlines(), self.after.splitlines(), n=2, lineterm="")
        return [row for row in rows if not row.startswith(("---", "+++"))]

    @property
    def changes(self) -> list[KeyChange]:
        """The keys whose values differ. Empty: at most remarks do."""
        with suppress(ValueError):  # a text that is no TOML has its mistake
            return list(_differences((), migrations.values(self.before), migrations.values(self.after)))
        return []


def _differences(place: Place, before: Any, after: Any) -> Iterator[KeyChange]:
    match before, after:
        case (dict() | None, dict() | None):
            for key in {**(before or {}), **(after or {})}:
                yield from _differences((*place, key), (before or {}).get(key), (after or {}).get(key))
        case (None, [dict(), *_]) | ([dict(), *_], None) | ([dict(), *_], [dict(), *_]):
            old, new = before or [], after or []
            if len(old) == len(new):
                for at, pair in enumerate(zip(old, new, strict=True)):
                    yield from _differences((*place, at), *pair)
                return
            # One that comes or goes moves those behind it: those that stay as they are have not changed.
            yield from (KeyChange((*place, at), each, None) for at, each in enumerate(old) if each not in new)
            yield from (KeyChange((*place, at), None, each) for at, each in enumerate(new) if each not in old)
        case _ if before != after:
            yield KeyChange(place, before, after)


def digest(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()


def settings(path: Path) -> Settings:
    """Raises OSError, and ConfigError for what is no TOML."""
    text = read(path)
    try:
        values = migrations.values(text)
    except ValueError:
        parse(text, str(path))
        raise
    try:
        return Settings(text, values, parse(text, str(path)))
    except ConfigError:
        return Settings(text, values, None)


def propose(path: Path, begun: str, make: Callable[[str], str]) -> Proposal:
    """The file with the text that `make` makes of its own. `begun`: the digest of the text that the change starts from.

    Raises what `make` raises, OverwritesError, OSError, and ConfigError for a file that is no TOML.
    """
    before = read(path)
    if digest(before) != begun:
        raise OverwritesError
    try:
        after = make(before)
    except ValueError:
        settings(path)  # where the file is no TOML, that is why
        raise
    return Proposal(before, after, _form_mistakes(after))


def write(path: Path, proposal: Proposal) -> None:
    """Write it, the old text beside it as `.bak`. Raises OverwritesError, OSError, and ConfigError for one with
    mistakes."""
    with WRITING:
        if read(path) != proposal.before:
            raise OverwritesError
        parse(proposal.after, str(path))
        replace(path, proposal.before, proposal.after)


def _form_mistakes(text: str) -> tuple[FormMistake, ...]:
    try:
        parse(text, "the file")
    except ConfigError as fault:
        at = {each.line: each.place for each in statements(text)}
        return tuple(
            FormMistake(mistake.text, tuple(at[line] for line in mistake.lines if line in at))
            for mistake in fault.mistakes
        )
    return ()
