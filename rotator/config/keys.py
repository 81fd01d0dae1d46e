"""A key of the model taken apart: the table that it holds, its bare type, its limits, and its meaning.

A meaning is the next docstring below the key in the source; several keys may share one. Pydantic could collect these
itself, but it would read the source of every table at each start of the box, which takes a tenth of a second on a PC.
Knows the types that pydantic's fields have. Does not know how a key is shown.
"""

from __future__ import annotations

import ast
import inspect
import textwrap
from types import NoneType, UnionType
from typing import Annotated, Any, Union, get_args, get_origin

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from rotator.config.table import Channel, Gpio, I2CAddress, I2CBus, Table


def table_of(field: FieldInfo) -> tuple[type[BaseModel] | None, bool]:
    """The table that a field holds, None for a key, and whether the file may have several such tables."""
    inner = get_args(field.annotation)
    many = get_origin(field.annotation) is list
    kind = inner[0] if many else field.annotation
    return (kind, many) if isinstance(kind, type) and issubclass(kind, BaseModel) else (None, False)


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


def describe(table: type[Table]) -> None:
    """Set the description of each key of `table`, and of the tables in it. A key without a docstring has none."""
    texts = {key: text for each in reversed(table.__mro__) for key, text in _written_in(each).items()}
    for key, field in table.model_fields.items():
        field.description = texts.get(key)
        for kind in (field.annotation, *get_args(field.annotation)):
            if isinstance(kind, type) and issubclass(kind, Table):
                describe(kind)


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
