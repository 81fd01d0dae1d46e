"""docs/reference/keys.md lists the keys that the program knows, with their true defaults and bounds."""

from __future__ import annotations

import re
from pathlib import Path
from types import UnionType
from typing import get_args, get_origin

import pytest
from pydantic import BaseModel

from docs.keys import reference
from rotator.config.model import Config

PAGE = Path(__file__).parents[2] / "docs" / "reference" / "keys.md"
REFERENCE = reference()
BEGIN, END = "<!-- reference: begin -->\n", "<!-- reference: end -->\n"


def test_page_holds_the_lists_of_keys() -> None:
    """If this fails, paste what `python -c "from docs.keys import *; print(reference())"` prints."""
    page = PAGE.read_text(encoding="utf-8")
    assert page.split(BEGIN)[1].split(END)[0] == f"\n{REFERENCE}\n"


def is_made_of_one(kind: object) -> bool:
    return get_origin(kind) is list or (get_origin(kind) is UnionType and len(get_args(kind)) == 2)


def is_table(kind: object) -> bool:
    """A table, a list of tables, or a table that may be left out."""
    (kind,) = [each for each in get_args(kind) if each is not type(None)] if is_made_of_one(kind) else (kind,)
    return isinstance(kind, type) and issubclass(kind, BaseModel)


@pytest.mark.parametrize("name", [name for name in Config.model_fields if name not in ("sim", "link")])
def test_every_key_has_its_place(name: str) -> None:
    section = next(each for each in REFERENCE.split("### ") if f"`[{name}]`" in each.splitlines()[0])
    table = Config.model_fields[name].annotation
    assert isinstance(table, type)
    assert issubclass(table, BaseModel)
    keys = [key for key, field in table.model_fields.items() if not is_table(field.annotation)]
    lines = [line for line in section.splitlines() if line.startswith("- `")]
    assert [key.strip("`") for line in lines for key in re.findall(r"^[^:(]+", line)[0][2:].strip().split(", ")] == keys


def test_no_word_of_a_library_stands_in_it() -> None:
    for word in ("Pydantic", "Undefined", "annotation=", "<class", "NoneType", "typing."):
        assert word not in REFERENCE
