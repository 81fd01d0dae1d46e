"""Gives each key of the model its meaning: the next docstring below it in the source. Several keys may share one.

Knows the source as text. Pydantic could collect these docstrings itself, but it would read the source of every table at
each start of the box, which takes a tenth of a second on a PC. The documents need them, the box does not.
"""

from __future__ import annotations

import ast
import inspect
import textwrap
from typing import get_args

from rotator.config.table import Table


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
