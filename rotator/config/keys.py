"""A key of the model taken apart: the table that it holds, its bare type, and its limits.

Knows the types that pydantic's fields have. Does not know how a key is shown.
"""

from __future__ import annotations

from types import NoneType, UnionType
from typing import Annotated, Any, Union, get_args, get_origin

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from rotator.config.table import Channel, Gpio, I2CAddress, I2CBus


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
