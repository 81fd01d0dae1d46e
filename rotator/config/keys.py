"""A key of the model taken apart: the table that it holds, its bare type, its limits, and its meaning; and all of them
as plain values, from which the page makes its forms, so that a new key is on the page without a line here.

A meaning is the next docstring below the key in the source; several keys may share one. Pydantic could collect these
itself, but it would read the source of every table at each start of the box, which takes a tenth of a second on a PC.
Knows the types that pydantic's fields have, how each is asked for, and all tables of the file. Does not know what
stands in a file.
"""

from __future__ import annotations

import ast
import inspect
import textwrap
from collections.abc import Iterator
from functools import cache
from types import NoneType, UnionType
from typing import Annotated, Any, Literal, NamedTuple, Union, get_args, get_origin

from pydantic.fields import FieldInfo

from rotator.config.model import Config
from rotator.config.table import Channel, Gpio, I2CAddress, I2CBus, Table


class TableOf(NamedTuple):
    name: str
    """With those around it: `sim.azimuth`."""
    model: type[Table]
    many: bool
    """The file may have several such tables."""
    field: FieldInfo

    @property
    def heading(self) -> str:
        return f"[[{self.name}]]" if self.many else f"[{self.name}]"

    @property
    def keys(self) -> dict[str, FieldInfo]:
        """Without the tables inside."""
        return {key: field for key, field in self.model.model_fields.items() if _held(field) is None}


@cache
def tables() -> dict[str, TableOf]:
    """Each table of the file by its name, in their order; those inside one follow it."""
    return {each.name: each for each in _within("", Config)}


def _within(prefix: str, table: type[Table]) -> Iterator[TableOf]:
    for name, field in table.model_fields.items():
        if (model := _held(field)) is not None:
            yield TableOf(f"{prefix}{name}", model, get_origin(field.annotation) is list, field)
            yield from _within(f"{prefix}{name}.", model)


def _held(field: FieldInfo) -> type[Table] | None:
    kinds = (field.annotation, *get_args(field.annotation))
    return next((kind for kind in kinds if isinstance(kind, type) and issubclass(kind, Table)), None)


def bare(kind: Any, limits: list[Any]) -> tuple[Any, list[Any]]:
    """A key's kind without `| None` and without annotations; those join the limits."""
    if get_origin(kind) in (Union, UnionType):
        (kind,) = (each for each in get_args(kind) if each is not NoneType)
        return bare(kind, limits)
    if get_origin(kind) is Annotated:
        kind, *notes = get_args(kind)
        for note in notes:
            limits = limits + (list(note.metadata) if isinstance(note, FieldInfo) else [note])
        return bare(kind, limits)
    if get_origin(kind) is list:
        # The limits of the items are no limits of the list.
        return list[bare(get_args(kind)[0], [])[0]], limits  # type: ignore[misc]
    return kind, limits


NAMED = {
    name: bare(kind, [])[1]
    for name, kind in {"GPIO": Gpio, "bus": I2CBus, "address": I2CAddress, "input": Channel}.items()
}
"""The limits of each kind of whole number that the legend explains."""


@cache
def describe() -> None:
    """Set the description of each key and table. A key without a docstring has none. It takes a while."""
    models: list[type[Table]] = [Config, *(each.model for each in tables().values())]
    for table in models:
        texts = {key: text for each in reversed(table.__mro__) for key, text in _written_in(each).items()}
        for key, field in table.model_fields.items():
            field.description = texts.get(key)


def _written_in(table: type) -> dict[str, str]:
    """The docstrings of the keys that this class itself declares."""
    if not issubclass(table, Table) or table is Table:
        return {}
    (body,) = ast.parse(textwrap.dedent(inspect.getsource(table))).body
    assert isinstance(body, ast.ClassDef)
    texts: dict[str, str] = {}
    keys: list[str] = []
    for statement in body.body:
        match statement:
            case ast.AnnAssign(target=ast.Name(id=key)):
                keys.append(key)
            case ast.Expr(value=ast.Constant(value=str(text))):
                texts |= dict.fromkeys(keys, " ".join(text.split()))
                keys = []
    return texts


_UNITS = {
    "_deg": "°", "_dps": "°/s", "_dps2": "°/s²", "_s": "s", "_us": "µs", "_hz": "Hz", "_v": "V", "_m": "m",
    "_nm": "N m",
}  # fmt: skip
_KINDS = {bool: "yes", int: "whole", float: "number", str: "text", list[str]: "texts"}
"""How a value is asked for; every other type is a list of numbers."""
_EDGES = {"ge": "least", "gt": "above", "le": "most", "lt": "below"}


@cache
def forms() -> list[dict[str, Any]]:
    """In the order of the model: `path`, `many`, `meaning`, `keys`. It takes a while at the first call."""
    describe()
    return [
        {
            "path": each.name.split("."),
            "many": each.many,
            "meaning": each.field.description,
            "keys": [question(key, field) for key, field in each.keys.items()],
        }
        for each in tables().values()
    ]


def question(key: str, field: FieldInfo) -> dict[str, Any]:
    """How a key is asked for."""
    kind, limits = bare(field.annotation, list(field.metadata))
    choices = list(get_args(kind)) if get_origin(kind) is Literal else None
    found: dict[str, Any] = {
        "key": key,
        "kind": "choice" if choices else _KINDS.get(kind, "numbers"),
        "meaning": field.description,
        "needed": field.is_required(),
    }
    if choices:
        found["choices"] = choices
    if kind is int and (name := next((name for name, known in NAMED.items() if known == limits), "")):
        found["named"] = name
    if unit := next((unit for ending, unit in _UNITS.items() if key.endswith(ending)), ""):
        found["unit"] = unit
    if kind in (int, float):
        found |= {
            word: getattr(limit, edge) for limit in limits for edge, word in _EDGES.items() if hasattr(limit, edge)
        }
    return found
