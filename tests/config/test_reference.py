"""docs/reference/keys.md lists the keys that the program knows, with their true defaults and bounds."""

from __future__ import annotations

import re
from pathlib import Path
from typing import get_args, get_origin

import pytest
from pydantic import BaseModel

from rotator.config.model import Config
from rotator.config.reference import reference

PAGE = Path(__file__).parents[2] / "docs" / "reference" / "keys.md"
REFERENCE = reference()
BEGIN, END = "<!-- reference: begin -->\n", "<!-- reference: end -->\n"


def test_page_holds_the_lists_of_keys() -> None:
    """If this fails, paste what `python -c "from rotator.config.reference import *; print(reference())"` prints."""
    page = PAGE.read_text(encoding="utf-8")
    assert page.split(BEGIN)[1].split(END)[0] == f"\n{REFERENCE}\n"


def is_table(kind: object) -> bool:
    """A table, or a list of tables."""
    (kind,) = get_args(kind) if get_origin(kind) is list else (kind,)
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


@pytest.mark.parametrize(
    "line",
    [
        '- `hardware` (`"sim"`; or "pi"): ',
        "- `tolerance_deg` (`4`; >0…45): ",
        "- `speed_dps` (`6`, elevation `2.7`; >0…360): ",
        "- `min_deg` (`0`; -360…720, elevation -90…180): ",
        "- `address` (`0x48`; address): ",
        "- `master` (GPIO): ",
        "- `osc_hz` (`25000000`; 20000000…30000000): ",
        "- `horizon` (`[]`; pairs): ",
        "- `calibration` (pairs): ",
        '- `protocol` (must be given; "gs232a", "gs232b", "gs232-f1efw", "rotctld", "rotctld-follow", "easycomm1", '
        '"easycomm2", "easycomm3", "rot1prog", "rot2prog", "md01", "dcu1", "pstrotator", "n1mm", '
        '"macdoppler", "wsjtx", "lx200", "stellarium", "pstrotatoraz", "prosistel-d", "prosistel-c", "rc2800"): ',
        "- `pulses_per_degree` (1, 2, 4, 10): ",
        "- `name` (up to 24 characters): ",
        "- `id` (`1`, elevation `2`; whole 1…126): ",
        "- `direction_checked` (`false`): ",
        "- `lowest_reading`, `highest_reading` (`0.02`, `0.98`; -0.1…1, 0…1.1): ",
        "- `lamp_manual`, `lamp_park`, `lamp_auto`, `lamp_jog` (whole 0…15): ",
        "- `ia_deg`, `ie_deg`, `an_deg`, `aw_deg`, `ca_deg`, `npae_deg`: as in `[mount.model]`.",
    ],
)
def test_line(line: str) -> None:
    assert line in REFERENCE


def test_the_legend_bounds_what_the_lines_only_name() -> None:
    legend = REFERENCE.split("\n\n")[0].replace("\n", " ")
    for said in ("*GPIO*: 0 to 57", "0 to 255", "0x08 to 0x77", "as 0 to 3"):
        assert said in legend


def test_no_word_of_a_library_stands_in_it() -> None:
    for word in ("Pydantic", "Undefined", "annotation=", "<class", "NoneType", "typing."):
        assert word not in REFERENCE
