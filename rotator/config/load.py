"""Reads a configuration file, or a shipped one, and lists all its faults at once.

Knows TOML, the wording of a fault, and harmless values with which it goes on to find further faults. The keys are in
the model.
"""

from __future__ import annotations

import difflib
from collections.abc import Mapping
from importlib.resources import files
from pathlib import Path
from typing import Any, get_args

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from rotator.config import migrations, toml_text
from rotator.config.model import Config

_KINDS = {
    "float": "a number",
    "int": "a whole number",
    "bool": "true or false",
    "string": "text in quotes",
    "list": "a list in brackets",
    "tuple": "a pair of numbers in brackets",
    "model": "a table",
}
"""The first word of a pydantic error type, in words for the user."""

SIMULATED = "simulated"
"""The name of the configuration that runs without a file."""


class ConfigError(Exception):
    """The file cannot be used. `faults`: one line for each thing to change."""

    def __init__(self, name: str, faults: list[str]) -> None:
        super().__init__(name, faults)
        self.name = name
        self.faults = faults

    def __str__(self) -> str:
        count = "1 fault" if len(self.faults) == 1 else f"{len(self.faults)} faults"
        return "\n".join((f"{self.name}: {count}", *(f"  {fault}" for fault in self.faults)))


def load(path: Path | None) -> Config:
    """The configuration in the file, or the shipped simulated station's. Raises ConfigError."""
    if path is None:
        return parse(shipped(), "the shipped configuration")
    try:
        text = toml_text.read(path)
    except (OSError, UnicodeDecodeError) as fault:
        raise ConfigError(str(path), [f"cannot be read: {fault}"]) from fault
    return parse(text, str(path))


def shipped(name: str = SIMULATED) -> str:
    """The text of a shipped configuration. Raises ConfigError for an unknown name, with the list of names."""
    if name == SIMULATED:
        return files("rotator.config").joinpath("simulated.toml").read_text(encoding="utf-8")
    if name not in profiles():
        known = [SIMULATED, *profiles()]
        raise ConfigError(name, [f"no such configuration{_meant(name, known)}; there are: {', '.join(known)}"])
    return files("rotator.config").joinpath("profiles", f"{name}.toml").read_text(encoding="utf-8")


def profiles() -> list[str]:
    """The names of the shipped configurations for real rotors."""
    texts = files("rotator.config").joinpath("profiles").iterdir()
    return sorted(text.name.removesuffix(".toml") for text in texts if text.name.endswith(".toml"))


def parse(text: str, name: str) -> Config:
    """The checked configuration in a TOML text. `name` stands in the errors. Raises ConfigError."""
    try:
        values = migrations.values(text)
    except ValueError as fault:
        raise ConfigError(name, [str(fault)]) from fault
    faults: list[str] = []
    while True:
        try:
            config = Config.model_validate(values)
            break
        except ValidationError as invalid:
            errors = invalid.errors()
        faults += [_explain(error) for error in errors]
        if any(not error["loc"] for error in errors):
            break
        # One fault can hide another: limits are compared only if both are numbers. Mend the faults, and check again.
        for error in errors:
            _mend(values, list(error["loc"]))
    if faults:
        raise ConfigError(name, list(dict.fromkeys(faults)))
    return config


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


def _explain(error: ErrorDetails) -> str:
    """One fault in words: the key, its value, the allowed values, and the likely intended one."""
    place = list(error["loc"])
    key = _key(place)
    value = error["input"]
    context: Mapping[str, Any] = error.get("ctx", {})
    match error["type"]:
        case "extra_forbidden":
            known = list(_known_keys(place[:-1]))
            return f"{key} = {_show(value)}: no such key{_meant(str(place[-1]), known)}; known here: {', '.join(known)}"
        case "missing":
            return f"{key}: must be given"
        case "literal_error":
            allowed = [str(choice) for choice in _choices(context)]
            return f"{key} = {_show(value)}: must be one of {', '.join(allowed)}{_meant(str(value), allowed)}"
        case "value_error" if not place:
            return str(context["error"])
        case "value_error":
            return f"{key}: {context['error']}"
        case kind:
            expected = _KINDS.get(kind.split("_")[0]) if kind.endswith(("_type", "_parsing")) else None
            expected = expected or error["msg"].removeprefix("Input should be ")
            return f"{key} = {_show(value)}: must be {expected}"


def _key(place: list[int | str]) -> str:
    text = ""
    for part in place:
        text += f"[{part}]" if isinstance(part, int) else f".{part}"
    return text.removeprefix(".")


def _show(value: object) -> str:
    text = f'"{value}"' if isinstance(value, str) else f"{value!r}"
    return text if len(text) <= 60 else text[:57] + "..."


def _choices(context: Mapping[str, Any]) -> list[str]:
    return [choice.strip().strip("'") for choice in str(context["expected"]).replace(" or ", ", ").split(",")]


def _meant(word: str, known: list[str]) -> str:
    close = difflib.get_close_matches(word, known, n=1, cutoff=0.6)
    return f"; did you mean {close[0]}?" if close else ""


def _known_keys(place: list[int | str]) -> list[str]:
    """The keys of the table at `place` in the model."""
    table: type[BaseModel] = Config
    for part in place:
        if isinstance(part, int):
            continue
        annotation = table.model_fields[part].annotation
        inner = [kind for kind in (annotation, *get_args(annotation)) if isinstance(kind, type)]
        tables = [kind for kind in inner if issubclass(kind, BaseModel)]
        if not tables:
            break
        table = tables[0]
    return list(table.model_fields)
