"""What people write that is no TOML: the person reads which line it is, what stands there, and what to write."""

from __future__ import annotations

from pathlib import Path

import pytest

from rotator.config.load import ConfigError, load, parse
from rotator.config.save import save_table

LINK = '[[link]]\nprotocol = "gs232b"\npty = "x"\n'


def told(text: str) -> list[str]:
    with pytest.raises(ConfigError) as wrong:
        parse(text, "rotator.toml")
    return [str(mistake) for mistake in wrong.value.mistakes]


@pytest.mark.parametrize(
    ("line", "right"),
    [
        ("min_deg = 0,5", "min_deg = 0.5"),
        ("min_deg = -10,25  # west", "min_deg = -10.25"),
        ("min_deg = 10°", "min_deg = 10"),
        ("min_deg = 10 deg", "min_deg = 10"),
        ("min_deg = 10,5 deg", "min_deg = 10.5"),
        ("min_deg = 10;", "min_deg = 10"),
        ("coast_s = 170 ms", "coast_s = 0.17"),
        ("rest_s = 5 min", "rest_s = 300"),
        ("min_deg = .5", "min_deg = 0.5"),
        ("min_deg = 5.", "min_deg = 5"),
        ("min_deg = 005", "min_deg = 5"),
        ("min_deg 10", "min_deg = 10"),
        ("min_deg: 10", "min_deg = 10"),
        ("min_deg == 10", "min_deg = 10"),
        ("min deg = 10", "min_deg = 10"),
        ("min_deg\u00a0= 10", "plain space"),
        ("direction_checked = yes", "direction_checked = true"),
        ("direction_checked = True", "direction_checked = true"),
        ("direction_checked = off", "direction_checked = false"),
        ("calibration = [[0,058, 0], [0,942, 360]]", "calibration = [[0.058, 0], [0.942, 360]]"),
        ("calibration = [[0.058 0], [0.942 360]]", "calibration = [[0.058, 0], [0.942, 360]]"),
        ("; a remark", "# a remark"),
        ("// a remark", "# a remark"),
        ("This is my rotor", "# before it"),
        ("min_deg =", "write one, or take the line out"),
    ],
)
def test_a_line_of_an_axis(line: str, right: str) -> None:
    (mistake,) = told(f"# mine\n[azimuth]\n{line}\nmax_deg = 360\n")
    assert mistake.startswith("line 3: ")
    assert mistake.endswith(right)


@pytest.mark.parametrize(
    ("line", "right"),
    [
        ("serial = /dev/ttyUSB0", 'serial = "/dev/ttyUSB0"'),
        ('serial = "/dev/ttyUSB0', 'serial = "/dev/ttyUSB0"'),
        ('serial = /dev/ttyUSB0"', 'serial = "/dev/ttyUSB0"'),
        ("serial = “/dev/ttyUSB0”", 'serial = "/dev/ttyUSB0"'),
        ('serial = "/dev/ttyUSB0";', 'serial = "/dev/ttyUSB0"'),
        ('serial = "\\dev\\ttyUSB0"', 'serial = "/dev/ttyUSB0"'),
    ],
)
def test_a_line_with_a_text(line: str, right: str) -> None:
    assert [mistake.partition(": write ")[2] for mistake in told(f'[[link]]\n{line}\nprotocol = "gs232b"\n')] == [right]


@pytest.mark.parametrize(
    ("heading", "right"),
    [
        ("[azimuth", "[azimuth]"),
        ("azimuth]", "[azimuth]"),
        ("[azimuth];", "[azimuth]"),
        ("[[azimuth]]", "[azimuth]"),
        ("[[azimuth]", "[azimuth]"),
    ],
)
def test_a_heading_of_one_table(heading: str, right: str) -> None:
    found = told(f"{heading}\nmin_deg = 10\n")
    assert found[-1].startswith("line 1: ")
    assert found[-1].endswith(f"write {right}")


@pytest.mark.parametrize("heading", ["[link]", "[[link]", "[link]]", "[ link ]"])
def test_a_heading_of_links(heading: str) -> None:
    found = told(LINK + LINK.replace("[[link]]", heading).replace('"x"', '"y"'))
    assert found[-1].startswith("line 4: ")
    assert found[-1].endswith("write [[link]]")


def test_a_list_that_is_not_closed_is_the_one_to_blame_and_not_the_line_behind_it() -> None:
    (mistake,) = told("[azimuth]\ncalibration = [\n  [0.1, 0],\n  [0.9, 360],\nmin_deg = 0\n")
    assert mistake == "line 2: calibration = [: ] is missing at its end"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (
            "[azimuth]\nmin_deg = 0\n[azimuth]\nmax_deg = 360\n",
            "line 3: [azimuth] is in line 1 already: write its keys there, under one heading",
        ),
        (
            "[azimuth]\nmin_deg = 0\nmin_deg = 1\n",
            "line 3: min_deg = 1: this key is in line 2 already: leave one of the two",
        ),
    ],
)
def test_something_twice(text: str, said: str) -> None:
    assert told(text) == [said]


def test_all_of_them_in_the_order_of_the_file_and_the_mistakes_of_keys_among_them() -> None:
    found = told(
        "[elevation]\nmax_deg = 300\n[azimuth\nmin_deg = 0,5\ntolerence_deg = 3\n[link]\nprotocol = gs232b\n"
        'pty = "x"\n[rotor]\nhardware = "pie"\n'
    )
    assert [mistake.split(":")[0] for mistake in found] == [f"line {line}" for line in (2, 3, 4, 5, 6, 7, 10)]


def test_a_line_that_cannot_be_read_is_not_missed_below() -> None:
    """The link has a protocol, though one without a value."""
    assert told('[[link]]\nprotocol =\npty = "x"\n') == [
        "line 2: protocol = without a value: write one, or take the line out"
    ]


# --- files of other programs


def read(path: Path, data: bytes) -> str:
    path.write_bytes(data)
    with pytest.raises(ConfigError) as wrong:
        load(path)
    (mistake,) = wrong.value.mistakes
    return str(mistake)


@pytest.mark.parametrize("encoding", ["utf-16", "utf-16-le", "utf-32"])
def test_utf_16(tmp_path: Path, encoding: str) -> None:
    said = read(tmp_path / "a.toml", LINK.encode(encoding))
    assert "saved as UTF-16" in said
    assert "iconv -f UTF-16 -t UTF-8" in said


@pytest.mark.parametrize("data", [b"\0" * 4096, LINK.encode() + b"\0" * 512, b"\0"])
@pytest.mark.parametrize("copy", ["a.toml.bak", "a.toml.before-rotator-2026-11-25", None])
def test_zero_bytes_of_a_power_cut(tmp_path: Path, data: bytes, copy: str | None) -> None:
    if copy:
        (tmp_path / copy).write_text(LINK)
    said = read(tmp_path / "a.toml", data)
    assert said.startswith("is damaged: it holds zero bytes, as a power cut leaves them: ")
    assert said.endswith(f"cp {tmp_path / copy} {tmp_path / 'a.toml'}" if copy else "`rotator config --ask --to FILE`")


def test_a_copy_that_is_damaged_too_is_not_advised(tmp_path: Path) -> None:
    (tmp_path / "a.toml.bak").write_bytes(b"\0" * 9)
    assert "cp " not in read(tmp_path / "a.toml", b"\0" * 9)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('{"rotor": {}}', "is JSON"),
        ('\n{\n  "rotor": {}\n}\n', "is JSON"),
        ("<!DOCTYPE html>\n<html>", "is a web page"),
        ("\ufeff<html>", "is a web page"),
    ],
)
def test_another_kind_of_file_is_one_message(tmp_path: Path, text: str, said: str) -> None:
    assert read(tmp_path / "a.toml", text.encode()).startswith(said)


def test_latin_1(tmp_path: Path) -> None:
    said = read(tmp_path / "a.toml", "[rotor]\n# Grüße aus Köln\n".encode("latin-1"))
    assert said.startswith("line 2: # Grüße aus Köln: is not saved as UTF-8")


def test_a_byte_order_mark_is_no_mistake(tmp_path: Path) -> None:
    path = tmp_path / "rotator.toml"
    path.write_text("[azimuth]\nmin_deg = 10\n", encoding="utf-8-sig")
    assert load(path).azimuth.min_deg == 10.0
    save_table(path, "azimuth", max_deg=300.0)
    assert load(path).azimuth.max_deg == 300.0


def test_windows_line_ends_and_tabs_are_no_mistake(tmp_path: Path) -> None:
    path = tmp_path / "rotator.toml"
    path.write_bytes(b"[azimuth]\r\n\tmin_deg\t=\t10\t# west\r\n")
    assert load(path).azimuth.min_deg == 10.0


# --- in a terminal


@pytest.mark.parametrize("columns", [40, 80])
def test_no_word_is_broken_and_what_to_write_stays_together(columns: int) -> None:
    with pytest.raises(ConfigError) as wrong:
        parse("[azimuth]\nmin_deg = 0,5\nspeed_dps = 6 deg/s\ntolerence_deg = 3\n", "rotator.toml")
    rows = wrong.value.wrapped(columns).splitlines()
    assert max(map(len, rows)) <= columns
    assert any("min_deg = 0.5" in row for row in rows)
    assert any("speed_dps = 6" in row and "deg/s" not in row.partition("write")[2] for row in rows)
    assert " ".join(" ".join(rows).split()) == " ".join(str(wrong.value).split())
