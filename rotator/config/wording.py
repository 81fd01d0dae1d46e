"""Words for a value that the model refuses: the key, what was found, and what to write instead.

Knows the errors of pydantic, and the keys and words that come near to what was written. Does not know lines.
"""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterator, Mapping
from functools import cache
from typing import Any, get_args, get_origin

from pydantic import BaseModel
from pydantic_core import ErrorDetails

from rotator.config.model import Config
from rotator.config.rotor_names import type_of

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
_PROTOCOL_OF = {
    "yaesu": "gs232b", "gs232": "gs232b", "g5500": "gs232b", "satpc32": "gs232b", "sattrack": "gs232-f1efw",
    "hamlib": "rotctld", "gpredict": "rotctld", "easycomm": "easycomm2", "spid": "rot2prog", "arduino": "gs232-f1efw",
}  # fmt: skip
"""What a person calls a protocol, in small letters and digits, and the one that is meant."""
_LISTENS = ("tcp", "listen")
"""Keys for a port of this machine: a bare number is the port."""


def explain(error: ErrorDetails) -> str:
    """One mistake: the key, its value, what is allowed, and what was probably meant."""
    place = list(error["loc"])
    key = written(place)
    value = error["input"]
    context: Mapping[str, Any] = error.get("ctx", {})
    match error["type"]:
        case "extra_forbidden" if len(place) == 1 and isinstance(value, (dict, list)):
            there = [name for name, *_ in tables() if "." not in name]
            near = _near(key.lower(), there, 0.6)
            meant = f"; did you mean {_heading(near)}?" if near else f"; there are {', '.join(there)}"
            return f"[{key}]: no such table{meant}"
        case "extra_forbidden":
            return f"{key} = {show(value)}: no such key{_right_key(place, value)}"
        case "missing":
            choices = _choices_of(place)
            return f"{key}: must be given{', one of ' if choices else ''}{', '.join(choices)}"
        case "literal_error":
            allowed = [str(choice) for choice in _choices(context)]
            sentence = f"{key} = {show(value)}: must be one of {', '.join(allowed)}"
            return sentence + (_right_choice(value, allowed) or (_right_type(value) if key == "rotor.type" else ""))
        case "value_error" if not place:
            return str(context["error"])
        case "value_error":
            return f"{key}: {context['error']}"
        case kind:
            sort = kind.split("_")[0]
            expected = _KINDS.get(sort) if kind.endswith(("_type", "_parsing")) else None
            expected = expected or error["msg"].removeprefix("Input should be ")
            name = next((str(part) for part in reversed(place) if isinstance(part, str)), "")
            return f"{key} = {show(value)}: must be {expected}{_right_form(key, name, value)}"


def written(place: list[int | str]) -> str:
    """As the page names a key: `link[0].pty`."""
    text = ""
    for part in place:
        text += f"[{part}]" if isinstance(part, int) else f".{part}"
    return text.removeprefix(".")


def show(value: object) -> str:
    """A value as TOML writes it, if that is short."""
    match value:
        case bool():
            text = "true" if value else "false"
        case str():
            text = f'"{value}"'
        case dict():
            text = "{ " + ", ".join(f"{key} = {show(each)}" for key, each in value.items()) + " }"
        case list() | tuple():
            text = f"[{', '.join(show(each) for each in value)}]"
        case _:
            text = f"{value}"
    text = text if text.isprintable() else ascii(text)
    return text if len(text) <= 60 else text[:57] + "..."


@cache
def tables() -> tuple[tuple[str, type[BaseModel], bool], ...]:
    """Each table of the file by its name, and whether there may be several."""
    return tuple(_tables_in("", Config))


def _tables_in(prefix: str, table: type[BaseModel]) -> Iterator[tuple[str, type[BaseModel], bool]]:
    for name, field in table.model_fields.items():
        several = get_origin(field.annotation) is list
        for kind in (field.annotation, *get_args(field.annotation)):
            if isinstance(kind, type) and issubclass(kind, BaseModel):
                yield f"{prefix}{name}", kind, several
                yield from _tables_in(f"{prefix}{name}.", kind)


def _choices_of(place: list[int | str]) -> list[str]:
    """The words from which a key takes one; empty: any."""
    here = ".".join(part for part in place[:-1] if isinstance(part, str))
    models = [model for table, model, _ in tables() if table == here]
    field = models[0].model_fields.get(str(place[-1])) if models else None
    return [choice for choice in get_args(field.annotation) if isinstance(choice, str)] if field else []


def _right_key(place: list[int | str], value: object) -> str:
    """What was meant by a key that the table at `place` does not have."""
    name = str(place[-1])
    here = ".".join(str(part) for part in place[:-1] if isinstance(part, str))
    models = {table: model for table, model, _ in tables()}
    known = list(models.get(here, Config).model_fields)
    if name.lower() == "name" and "type" in known and isinstance(value, str) and type_of(value):
        return f"; did you mean type? {type_of(value)}"
    near = _near(name.lower(), known, 0.6)
    return f"; did you mean {near}?" if near else f"; known here: {', '.join(known)}"


def _heading(name: str) -> str:
    return f"[[{name}]]" if next(several for table, _, several in tables() if table == name) else f"[{name}]"


def _right_type(value: object) -> str:
    advice = type_of(value) if isinstance(value, str) else None
    return f"; {advice}" if advice else ""


def _right_choice(value: object, allowed: list[str]) -> str:
    if isinstance(value, str) and value in allowed:
        return f"; write {value} without quotes"
    if isinstance(value, bool) and len(allowed) == 2 and "off" in allowed:
        on = next(choice for choice in allowed if choice != "off")
        return f'; write "{on if value else "off"}"'
    usual = _PROTOCOL_OF.get(re.sub(r"[^a-z0-9]", "", str(value).lower()))
    if usual in allowed:
        return f"; did you mean {usual}?"
    near = _near(str(value).lower(), allowed, 0.6)
    return f"; did you mean {near}?" if near else ""


def _right_form(key: str, name: str, value: object) -> str:
    """A heading with the wrong number of brackets; and `tcp = 4533`, a port alone, of this machine alone."""
    if isinstance(value, (dict, list)) and key in {table for table, *_ in tables()}:
        return f"; write {_heading(key)}"
    return f'; write "127.0.0.1:{value}"' if name in _LISTENS and type(value) is int else ""


def _choices(context: Mapping[str, Any]) -> list[str]:
    return [choice.strip().strip("'") for choice in str(context["expected"]).replace(" or ", ", ").split(",")]


def _near(word: str, known: list[str], cutoff: float) -> str | None:
    return next(iter(difflib.get_close_matches(word, known, n=1, cutoff=cutoff)), None)
