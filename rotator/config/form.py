"""All tables of the file and their keys as plain values, from which the page makes its forms.

Knows how each type of value is asked for. Keys, bounds, defaults and meanings come from the model, so that a new key is
on the page without a line here. Does not know what stands in a file.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from typing import Any, Literal, get_args, get_origin

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from rotator.config.keys import NAMED, bare, describe, table_of
from rotator.config.model import Config

_UNITS = {
    "_deg": "°", "_dps": "°/s", "_dps2": "°/s²", "_s": "s", "_us": "µs", "_hz": "Hz", "_v": "V", "_m": "m",
    "_nm": "N m",
}  # fmt: skip
_KINDS = {bool: "yes", int: "whole", float: "number", str: "text", list[str]: "texts"}
"""How a value is asked for; every other type is a list of numbers."""
_EDGES = {"ge": "least", "gt": "above", "le": "most", "lt": "below"}


@cache
def tables() -> list[dict[str, Any]]:
    """In the order of the model: `path`, `many`, `meaning`, `keys`. It takes a while at the first call."""
    describe(Config)
    return list(_tables((), Config))


def _tables(path: tuple[str, ...], model: type[BaseModel]) -> Iterator[dict[str, Any]]:
    for name, field in model.model_fields.items():
        table, many = table_of(field)
        if table is None:
            continue
        keys = [_key(key, each) for key, each in table.model_fields.items() if table_of(each)[0] is None]
        yield {"path": [*path, name], "many": many, "meaning": field.description, "keys": keys}
        yield from _tables((*path, name), table)


def _key(key: str, field: FieldInfo) -> dict[str, Any]:
    kind, limits = bare(field.annotation, list(field.metadata))
    choices = list(get_args(kind)) if get_origin(kind) is Literal else None
    question: dict[str, Any] = {
        "key": key,
        "kind": "choice" if choices else _KINDS.get(kind, "numbers"),
        "meaning": field.description,
        "needed": field.is_required(),
    }
    if choices:
        question["choices"] = choices
    if kind is int and (name := next((name for name, known in NAMED.items() if known == limits), "")):
        question["named"] = name
    if unit := next((unit for ending, unit in _UNITS.items() if key.endswith(ending)), ""):
        question["unit"] = unit
    if kind in (int, float):
        question |= {
            word: getattr(limit, edge) for limit in limits for edge, word in _EDGES.items() if hasattr(limit, edge)
        }
    return question
