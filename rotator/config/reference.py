"""The key table of docs/configuration.md, made from the model, so that the page cannot drift from the program.

Knows Markdown and the names of the kinds of value. Knows no key: those are in the model.
"""

from __future__ import annotations

from collections.abc import Iterator
from types import NoneType, UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from rotator.config.model import Config
from rotator.config.rotors import USUAL
from rotator.config.table import I2CAddress

_KINDS = {
    str: "text",
    bool: "true or false",
    int: "whole number",
    float: "number",
    list[tuple[float, float]]: "list of [number, number]",
    list[str]: "list of texts",
}
_EDGES = {"ge": "from {}", "gt": "above {}", "le": "to {}", "lt": "below {}"}
_LENGTHS = {"min_length": "{} or more", "max_length": "up to {}"}
"""How limits are worded; that a text is not empty goes without saying."""
_HEADINGS = ("key", "value", "allowed", "default", "meaning")


def reference() -> str:
    """A heading, a sentence and a table of keys for each table of the file; then what differs by kind of rotor."""
    return "\n\n".join([*_tables("", Config), _usual()]) + "\n"


def _usual() -> str:
    rows: list[tuple[str, ...]] = [("`rotor.type`", "key", "default"), ("---", "---", "---")]
    for kind, places in USUAL.items():
        for place, keys in places.items():
            rows += [(f"`{kind}`", f"`{place}.{key}`", f"`{_toml(value)}`") for key, value in keys.items()]
    said = (
        "Other kinds of rotor than relay-pot have these in place of the defaults above (the limits in simulation only)."
    )
    return f"### By kind of rotor\n\n{said}\n\n{_rows(rows)}"


def _tables(prefix: str, model: type[BaseModel]) -> Iterator[str]:
    for name, field in model.model_fields.items():
        table, many = _table_of(field)
        if table is None:
            continue
        heading = f"[[{prefix}{name}]]" if many else f"[{prefix}{name}]"
        keys = [(key, each) for key, each in table.model_fields.items() if _table_of(each)[0] is None]
        yield f"### `{heading}`"
        yield _described(heading, field)
        if keys:
            yield _rows([_HEADINGS, tuple("---" for _ in _HEADINGS), *(_row(heading, *key) for key in keys)])
        yield from _tables(f"{prefix}{name}.", table)


def _table_of(field: FieldInfo) -> tuple[type[BaseModel] | None, bool]:
    """The table that a field is, if it is one, and whether the file may have several of it."""
    inner = get_args(field.annotation)
    many = get_origin(field.annotation) is list
    kind = inner[0] if many else field.annotation
    return (kind, many) if isinstance(kind, type) and issubclass(kind, BaseModel) else (None, False)


def _rows(rows: list[tuple[str, ...]]) -> str:
    return "\n".join("| " + " | ".join(cell.replace("|", r"\|") for cell in row) + " |" for row in rows)


def _row(heading: str, key: str, field: FieldInfo) -> tuple[str, ...]:
    kind, limits = _bare(field.annotation, list(field.metadata))
    if get_origin(kind) is Literal:
        value, allowed = _KINDS[type(get_args(kind)[0])], ", ".join(_toml(choice) for choice in get_args(kind))
    else:
        value, allowed = _KINDS[kind], _bounds(limits, kind)
    if limits == _I2C_LIMITS:
        allowed, default = "0x08 to 0x77", "left out" if field.default is None else f"`0x{field.default:02x}`"
    else:
        default = _default(field)
    return f"`{key}`", value, allowed, default, _described(f"{heading} {key}", field)


def _described(what: str, field: FieldInfo) -> str:
    if not field.description:
        raise ValueError(f"{what} has no description: write a docstring below it")
    return " ".join(field.description.split())


def _bare(kind: Any, limits: list[Any]) -> tuple[Any, list[Any]]:
    """The type of a key without `| None` and without annotations; those join the limits."""
    if get_origin(kind) in (Union, UnionType):
        (kind,) = (each for each in get_args(kind) if each is not NoneType)
        return _bare(kind, limits)
    if get_origin(kind) is Annotated:
        kind, *notes = get_args(kind)
        for note in notes:
            limits = limits + (list(note.metadata) if isinstance(note, FieldInfo) else [note])
        return _bare(kind, limits)
    if get_origin(kind) is list:
        # A limit of the items is no limit of the list.
        return list[_bare(get_args(kind)[0], [])[0]], limits  # type: ignore[misc]
    return kind, limits


_I2C_LIMITS = _bare(I2CAddress, [])[1]


def _bounds(limits: list[Any], kind: Any) -> str:
    wording = _LENGTHS if kind in (str, list[tuple[float, float]], list[str]) else _EDGES
    edges = {name: getattr(limit, name) for limit in limits for name in wording if hasattr(limit, name)}
    if kind is str:
        edges.pop("min_length", None)
    words = [wording[name].format(edge) for name, edge in edges.items()]
    text = " ".join(words).replace("from ", "", 1) if len(words) == 2 else " ".join(words)
    return f"{text} {'characters' if kind is str else 'of them'}" if text and wording is _LENGTHS else text


def _default(field: FieldInfo) -> str:
    if field.is_required():
        return "must be given"
    return "left out" if field.default is None else f"`{_toml(field.default)}`"


def _toml(value: object) -> str:
    match value:
        case bool():
            return "true" if value else "false"
        case str():
            return f'"{value}"'
        case [*points]:
            return f"[{', '.join(_toml(point) for point in points)}]"
        case _:
            return f"{value}"
