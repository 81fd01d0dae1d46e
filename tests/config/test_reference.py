"""docs/configuration.md lists the keys that the program knows, with their true defaults and bounds."""

from __future__ import annotations

import tomllib
from pathlib import Path

import pytest
from pydantic import BaseModel

from rotator.config.load import parse
from rotator.config.model import Config
from rotator.config.reference import reference

PAGE = Path(__file__).parents[2] / "docs" / "configuration.md"
BEGIN, END = "<!-- reference: begin -->\n", "<!-- reference: end -->\n"


def examples() -> list[str]:
    """The page's TOML blocks that are whole files."""
    blocks = [block.split("```")[0] for block in PAGE.read_text(encoding="utf-8").split("```toml\n")[1:]]
    return [block for block in blocks if "[rotor]" in block]


def test_page_holds_the_key_table() -> None:
    """If this fails, paste what `python -c "from rotator.config.reference import *; print(reference())"` prints."""
    page = PAGE.read_text(encoding="utf-8")
    assert page.split(BEGIN)[1].split(END)[0] == f"\n{reference()}\n"


def is_table(kind: object) -> bool:
    return isinstance(kind, type) and issubclass(kind, BaseModel)


@pytest.mark.parametrize("name", [name for name in Config.model_fields if name not in ("sim", "link")])
def test_every_key_has_its_row(name: str) -> None:
    section = reference().split(f"### `[{name}]`")[1].split("###")[0]
    table = Config.model_fields[name].annotation
    assert isinstance(table, type)
    assert issubclass(table, BaseModel)
    keys = [key for key, field in table.model_fields.items() if not is_table(field.annotation)]
    assert [row.split("`")[1] for row in section.splitlines() if row.startswith("| `")] == keys


@pytest.mark.parametrize(
    "row",
    [
        '| `hardware` | text | "sim", "pi" | `"sim"` |',
        "| `tolerance_deg` | number | above 0 to 45 | `4.0` |",
        "| `address` | whole number | 0x08 to 0x77 | `0x48` |",
        "| `master` | whole number | 0 to 57 | left out |",
        "| `calibration` | list of [number, number] |  | left out |",
        '| `protocol` | text | "gs232a", "gs232b", "gs232-f1efw", "rotctld", "rotctld-follow", "easycomm1", '
        '"easycomm2", "easycomm3", "rot1prog", "rot2prog", "md01", "dcu1", "pstrotator", "n1mm", '
        '"macdoppler", "wsjtx" | must be given |',
        "| `pulses_per_degree` | whole number | 1, 2, 4, 10 | left out |",
        "| `name` | text | up to 24 characters | left out |",
        "| `direction_checked` | true or false |  | `false` |",
    ],
)
def test_row(row: str) -> None:
    assert row in reference()


@pytest.mark.parametrize("text", examples(), ids=lambda text: text.splitlines()[0][:30])
def test_examples_are_good_files(text: str) -> None:
    assert parse(text, "example") == Config.model_validate(tomllib.loads(text))


def test_there_are_examples() -> None:
    assert {parse(text, "example").rotor.hardware for text in examples()} == {"sim", "pi"}
