"""Words for a value that the model refuses: the key, what was found, and what to write instead.

Knows the errors of pydantic, and the keys and words that come near to what was written. Does not know lines.
"""

from __future__ import annotations

import difflib
from collections.abc import Iterator, Mapping
from functools import cache
from typing import Any, get_args, get_origin

from pydantic import BaseModel
from pydantic_core import ErrorDetails

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


def explain(error: ErrorDetails) -> str:
    """One mistake: the key, its value, what is allowed, and what was probably meant."""
    place = list(error["loc"])
    key = written(place)
    value = error["input"]
    context: Mapping[str, Any] = error.get("ctx", {})
    match error["type"]:
        case "extra_forbidden" if len(place) == 1 and isinstance(value, (dict, list)):
            there = [name for name, *_ in tables() if "." not in name]
            near = _near(key, there)
            meant = f"; did you mean {_heading(near)}?" if near else f"; there are {', '.join(there)}"
            return f"[{key}]: no such table{meant}"
        case "extra_forbidden":
            return f"{key} = {show(value)}: no such key{_right_key(place)}"
        case "missing":
            choices = _choices_of(place)
            return f"{key}: must be given{', one of ' if choices else ''}{', '.join(choices)}"
        case "literal_error":
            allowed = [str(choice) for choice in _choices(context)]
            near = _near(str(value), allowed)
            meant = f"; did you mean {near}?" if near else ""
            return f"{key} = {show(value)}: must be one of {', '.join(allowed)}{meant}"
        case "value_error" if not place:
            return str(context["error"])
        case "value_error":
            return f"{key}: {context['error']}"
        case kind:
            sort = kind.split("_")[0]
            expected = _KINDS.get(sort) if kind.endswith(("_type", "_parsing")) else None
            expected = expected or error["msg"].removeprefix("Input should be ")
            is_table = isinstance(value, (dict, list)) and key in {table for table, *_ in tables()}
            return f"{key} = {show(value)}: must be {expected}{f'; write {_heading(key)}' if is_table else ''}"


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


def _right_key(place: list[int | str]) -> str:
    """What was meant by a key that the table at `place` does not have."""
    here = ".".join(str(part) for part in place[:-1] if isinstance(part, str))
    models = {table: model for table, model, _ in tables()}
    known = list(models.get(here, Config).model_fields)
    near = _near(str(place[-1]), known)
    return f"; did you mean {near}?" if near else f"; known here: {', '.join(known)}"


def _heading(name: str) -> str:
    return f"[[{name}]]" if next(several for table, _, several in tables() if table == name) else f"[{name}]"


def _choices(context: Mapping[str, Any]) -> list[str]:
    return [choice.strip().strip("'") for choice in str(context["expected"]).replace(" or ", ", ").split(",")]


def _near(word: str, known: list[str]) -> str | None:
    """The one that differs least, by its letters alone: nothing is guessed of what a person calls it."""
    return next(iter(difflib.get_close_matches(word.lower(), known, n=1)), None)
