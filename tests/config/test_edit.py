"""Changes of single keys in a text: everything else in it stays, byte by byte."""

from __future__ import annotations

import difflib
import tomllib

import pytest

from rotator.config.edit import Change, NoChangeError, edited
from rotator.config.load import profiles, shipped

TEXT = """\
# my box
[rotor]
type = "relay-pot"   # kind

# The azimuth
[azimuth]
min_deg = 0   # low

# The elevation
[elevation]
sensor = { kind = "own" }
max_deg = 180

# the PC
[[link]]
protocol = "gs232b"  # P
pty = "run/x"

# the phone
[[link]]
protocol = "rotctld"
tcp = "127.0.0.1:4533"
# the end
"""


def differs(text: str, *changes: Change) -> list[str]:
    new = edited(text, changes)
    rows = difflib.unified_diff(text.splitlines(), new.splitlines(), n=0, lineterm="")
    return [row for row in rows if not row.startswith(("---", "+++", "@@"))]


@pytest.mark.parametrize(
    ("change", "rows"),
    [
        (Change(("azimuth", "min_deg"), 5), ["-min_deg = 0   # low", "+min_deg = 5   # low"]),
        (Change(("azimuth", "max_deg"), 450), ["+max_deg = 450"]),
        (Change(("azimuth", "max_deg"), None), []),
        (Change(("azimuth", "min_deg"), None), ["-min_deg = 0   # low"]),
        (Change(("azimuth", "sensor", "kind"), "as5600"), ["+", "+[azimuth.sensor]", '+kind = "as5600"']),
        (Change(("station", "locator"), "JO62qm"), ["+", "+[station]", '+locator = "JO62qm"']),
        (Change(("link", 0, "baud"), 4800), ["+baud = 4800"]),
        (
            Change(("link", 0), None),
            ["-# the PC", "-[[link]]", '-protocol = "gs232b"  # P', '-pty = "run/x"', "-"],
        ),
        (Change(("link", 2), {"protocol": "dcu1"}), ["+", "+[[link]]", '+protocol = "dcu1"']),
        (Change(("elevation", "calibration"), [[0.1, 0], [0.9, 180]]), ["+calibration = [[0.1, 0], [0.9, 180]]"]),
    ],
    ids=str,
)
def test_only_its_own_line_changes(change: Change, rows: list[str]) -> None:
    assert differs(TEXT, change) == rows


def test_a_key_in_a_table_on_one_line() -> None:
    new = edited(TEXT, [Change(("elevation", "sensor", "bus"), 3)])
    assert tomllib.loads(new)["elevation"]["sensor"] == {"kind": "own", "bus": 3}


def test_both_links_out_and_another_one_in() -> None:
    new = edited(
        TEXT, [Change(("link", 1), None), Change(("link", 0), None), Change(("link", 0), {"protocol": "dcu1"})]
    )
    assert tomllib.loads(new)["link"] == [{"protocol": "dcu1"}]
    assert "# the end" in new


@pytest.mark.parametrize("name", ["simulated", *profiles()])
def test_every_shipped_file_takes_new_keys_and_keeps_its_remarks(name: str) -> None:
    text = shipped(name)
    changes = [
        Change(("azimuth", "offset_deg"), 12.5),
        Change(("elevation", "backlash_deg"), 1),
        Change(("mount", "park_azimuth_deg"), 90),
        Change(("station", "locator"), "JN58"),
        Change(("link", len(tomllib.loads(text)["link"])), {"protocol": "dcu1", "pty": "run/dcu1"}),
    ]
    new = edited(text, changes)
    gone = [row for row in text.splitlines() if row.lstrip().startswith("#") and row not in new.splitlines()]
    assert gone == []


def test_a_text_cannot_smuggle_a_line_into_the_file() -> None:
    new = edited(TEXT, [Change(("link", 0, "name"), 'x"\n[page]\nreading = "open')])
    assert tomllib.loads(new)["link"][0]["name"] == 'x"\n[page]\nreading = "open'
    assert "page" not in tomllib.loads(new)


@pytest.mark.parametrize(
    ("place", "value"),
    [
        # What is no key.
        *((place, 1) for place in [("../etc", "passwd"), ("azimuth", "a b"), ("azimuth", 'x"\n[rotor]'), ("link", -1)]),
        *((place, 1) for place in [("link", True), (0,), (), ("a",) * 7, ("azimuth", "")]),
        # What no file has.
        *((("azimuth", "max_deg"), value) for value in [[None], {"a b": 1}, {"a": None}, [[[[[[[[1]]]]]]]]]),
        # A place that is not there.
        (("link", 7), None),
        (("link", 7), {"protocol": "dcu1"}),
        (("rotor", "type", "x"), 1),
        (("link", "baud"), 1),
    ],
    ids=str,
)
def test_what_cannot_be_changed_is_refused(place: tuple[int | str, ...], value: object) -> None:
    with pytest.raises(NoChangeError):
        edited(TEXT, [Change(place, value)])
