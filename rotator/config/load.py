"""Reads a configuration file, or a shipped one, and lists all its mistakes at once, in the order of the file.

Knows harmless values with which it goes on to find further mistakes, and the lines of each. The keys are in the model,
the words in `wording`, what is no TOML in `toml_text`.
"""

from __future__ import annotations

import difflib
import re
import tomllib
from collections.abc import Iterable, Mapping
from importlib.resources import files
from pathlib import Path
from typing import Any

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from rotator.config import migrations, toml_text
from rotator.config.mistake import ConfigError, Mistake
from rotator.config.model import Config
from rotator.config.statements import Place, places
from rotator.config.wording import explain, tables

__all__ = ["SIMULATED", "ConfigError", "Mistake", "load", "parse", "profiles", "shipped"]

_PATHS = re.compile(r"[a-z_0-9]+(?:\[\d+\])?(?:\.[a-z_0-9]+)*")
"""What may be a key in the words of a mistake."""

SIMULATED = "simulated"
"""The name of the configuration that runs without a file."""
_NAMES = "`rotator config --list` has the other rotors"


def load(path: Path | None) -> Config:
    """The configuration in the file, or the shipped simulated station's. Raises ConfigError."""
    if path is None:
        return parse(shipped(), "the shipped configuration")
    try:
        text = toml_text.read(path)
    except OSError as fault:
        raise ConfigError(str(path), [Mistake(_unreadable(path, fault))]) from fault
    except toml_text.NoTextError as none:
        raise ConfigError(str(path), [none.mistake]) from none
    if not any(row.strip() and not row.strip().startswith("#") for row in text.splitlines()):
        raise ConfigError(str(path), [Mistake(f"is empty: `rotator config g5500 > {path}` fills it; {_NAMES}")])
    return parse(text, str(path))


def shipped(name: str = SIMULATED) -> str:
    """The text of a shipped configuration. Raises ConfigError for an unknown name, with the list of names."""
    if name == SIMULATED:
        return files("rotator.config").joinpath("simulated.toml").read_text(encoding="utf-8")
    if name not in profiles():
        known = [SIMULATED, *profiles()]
        near = difflib.get_close_matches(name.lower(), known, n=1, cutoff=0.6)
        meant = f"; did you mean {near[0]}?" if near else ""
        raise ConfigError(name, [Mistake(f"no such configuration{meant}; there are: {', '.join(known)}")])
    return files("rotator.config").joinpath("profiles", f"{name}.toml").read_text(encoding="utf-8")


def profiles() -> list[str]:
    """The names of the shipped configurations for real rotors."""
    texts = files("rotator.config").joinpath("profiles").iterdir()
    return sorted(text.name.removesuffix(".toml") for text in texts if text.name.endswith(".toml"))


def parse(text: str, name: str) -> Config:
    """The checked configuration in a TOML text. `name` stands in the errors. Raises ConfigError."""
    try:
        return Config.model_validate(migrations.values(text))
    except (tomllib.TOMLDecodeError, RecursionError, ValidationError, migrations.FormatError) as first:
        raise ConfigError(name, _mistakes(text)) from first


def _mistakes(text: str) -> list[Mistake]:
    """Everything that is wrong with a text that is no configuration."""
    several = {name for name, _, many in tables() if many}
    mended = toml_text.mended(text, {name for name, *_ in tables()} - several, several)
    found = list(mended.mistakes)
    try:
        keys = migrations.values(mended.text)
    except migrations.FormatError as fault:
        return [*found, Mistake(str(fault), places(mended.text).get((migrations.KEY,), ())[:1])]
    values = {key: value for key, value in keys.items() if key[:1] != toml_text.SCRATCH}
    lines = places(mended.text)
    for _ in range(toml_text.MOST):
        try:
            Config.model_validate(values)
            break
        except ValidationError as invalid:
            errors = invalid.errors()
        # A line that could not be read may hold just what is missing.
        told = [error for error in errors if mended.whole or error["type"] not in ("missing", "value_error")]
        new = [mistake for error in told for mistake in _located(error, lines) if mistake not in found]
        found += new
        if any(not error["loc"] for error in errors) or (told and not new):
            break
        # One mistake can hide another: limits are compared only if both are numbers. Mend the values, and check again.
        for error in errors:
            _mend(values, list(error["loc"]))
    return found


def _located(error: ErrorDetails, lines: Mapping[Place, tuple[int, ...]]) -> Iterable[Mistake]:
    """The mistake with its lines: those of the keys that it names, else that of its table. The rules across tables
    may have found several at once."""
    place = tuple(error["loc"])
    for words in explain(error).split("\n"):
        if error["type"] != "value_error":
            yield Mistake(words, _line_of(place, lines))
            continue
        said = words.removeprefix(f"{_dotted(place)}:") if place else words
        named = [line for path in _PATHS.findall(said) for line in lines.get((*place, *_place(path)), ())]
        yield Mistake(words, tuple(sorted(set(named))) or _line_of(place, lines))


def _line_of(place: Place, lines: Mapping[Place, tuple[int, ...]]) -> tuple[int, ...]:
    """The line of the key at `place`, or of the nearest table around it."""
    around = (lines[place[:length]] for length in range(len(place), 0, -1) if place[:length] in lines)
    return next(around, ())[:1]


def _place(path: str) -> Place:
    return tuple(int(part) if part.isdigit() else part for part in re.split(r"[.\[\]]+", path) if part)


def _dotted(place: Place) -> str:
    return ".".join(str(part) for part in place)


def _unreadable(path: Path, fault: OSError) -> str:
    match fault:
        case FileNotFoundError():
            near = difflib.get_close_matches(path.name, _names_in(path.parent), n=1, cutoff=0.6)
            meant = f"did you mean {path.with_name(near[0])}? " if near else ""
            return f"there is no such file: {meant}`rotator config g5500 > {path}` makes one; {_NAMES}"
        case IsADirectoryError():
            return f"is a folder: name the file in it, such as {path / 'rotator.toml'}"
        case PermissionError():
            return "you may not read it: put sudo before the command, or let its owner give you the right (chmod +r)"
        case _:
            return f"cannot be read: {fault.strerror or fault}"


def _names_in(folder: Path) -> list[str]:
    try:
        return [each.name for each in folder.iterdir() if each.suffix == ".toml"]
    except OSError:
        return []


def _mend(values: dict[str, Any], place: list[int | str]) -> None:
    """Replace the faulty value by a harmless one, to find further faults."""
    parent: Any = values
    *way, last = place
    for part in way:
        if isinstance(parent, list) and not (isinstance(part, int) and part < len(parent)):
            return
        if isinstance(parent, dict) and part not in parent:
            return
        parent = parent[part]
    match parent, last:
        case _ if place[:2] == ["mount", "forbidden"] and len(place) > 2:
            # All keys of a sector but one must be given. A faulty one is left out, and the others with it.
            values["mount"].pop("forbidden")
        case dict(), "protocol":
            places = {"connect": "rotctld-follow", "udp": "pstrotator", "file": "wsjtx"}
            parent[last] = next((protocol for key, protocol in places.items() if key in parent), "rotctld")
        case dict(), "pty" | "serial" | "tcp" | "connect" | "udp" | "file" if place[0] == "link":
            parent[last] = f"mended-{place[1]}:1"
        case dict(), _:
            parent.pop(last, None)
        case list(), int() if place[0] == "link" and len(place) == 2:
            parent[last] = {"protocol": "rotctld", "pty": f"mended-{last}"}
        case _:
            _mend(values, way)
