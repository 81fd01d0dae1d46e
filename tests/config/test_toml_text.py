"""What people write that is no TOML: the person reads which line it is, what stands there, and why it is none."""

from __future__ import annotations

from pathlib import Path

import pytest

from rotator.config.load import ConfigError, load, parse
from rotator.config.save import save_tables

LINK = '[[link]]\nprotocol = "gs232b"\npty = "x"\n'


def told(text: str) -> list[str]:
    with pytest.raises(ConfigError) as wrong:
        parse(text, "rotator.toml")
    return [str(mistake) for mistake in wrong.value.mistakes]


@pytest.mark.parametrize(
    "line",
    [
        "min_deg = 0,5", "min_deg = 10°", "min_deg = 10 deg", "min_deg = 10;", "min_deg = 005", "min_deg 10",
        "min_deg: 10", "min_deg\u00a0= 10", "direction_checked = yes", "calibration = [[0.058 0], [0.942 360]]",
        "; a remark", "This is my rotor", "min_deg =", "[elevation", "elevation]", "name = “mine”", 'name = "mine',
        'name = "\\mine"', "max_deg = 1", "[azimuth]",
    ],
)  # fmt: skip
def test_the_line_that_is_no_toml_is_told_as_it_stands_with_how_values_are_written(line: str) -> None:
    (mistake,) = told(f"# mine\n[azimuth]\nmax_deg = 360\n{line}\n[rotor]\n")
    assert mistake.startswith(f"line 4: {line.replace(chr(0xA0), ' ')}: is not TOML: ")
    assert mistake.endswith('; a number is written 4.5, a text "in quotes", and a remark begins with #')


def test_a_list_that_ends_nowhere_is_told_with_the_last_line() -> None:
    (mistake,) = told("[azimuth]\ncalibration = [\n  [0.1, 0],\n  [0.9, 360],\n\n")
    assert mistake.startswith("line 4: [0.9, 360],: is not TOML: ")


@pytest.mark.parametrize(
    ("heading", "said"),
    [
        ("[[azimuth]]", "azimuth = [{ min_deg = 1 }]: must be a table; write [azimuth]"),
        ("[link]", "link = { min_deg = 1 }: must be a list in brackets; write [[link]]"),
        ("[azimut]", "[azimut]: no such table; did you mean [azimuth]?"),
        ("[[Links]]", "[Links]: no such table; did you mean [[link]]?"),
    ],
)
def test_a_heading_with_the_wrong_brackets_or_name(heading: str, said: str) -> None:
    assert told(f"{heading}\nmin_deg = 1\n") == [f"line 1: {said}"]


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
    save_tables(path, {"azimuth": {"max_deg": 300.0}})
    assert load(path).azimuth.max_deg == 300.0


def test_windows_line_ends_and_tabs_are_no_mistake(tmp_path: Path) -> None:
    path = tmp_path / "rotator.toml"
    path.write_bytes(b"[azimuth]\r\n\tmin_deg\t=\t10\t# west\r\n")
    assert load(path).azimuth.min_deg == 10.0


# --- in a terminal


@pytest.mark.parametrize("columns", [40, 80])
def test_no_word_is_broken(columns: int) -> None:
    with pytest.raises(ConfigError) as wrong:
        parse("[azimuth]\nmin_deg = 'x'\nspeed_dps = 6\ntolerence_deg = 3\n", "rotator.toml")
    rows = wrong.value.wrapped(columns).splitlines()
    assert max(map(len, rows)) <= columns
    assert " ".join(" ".join(rows).split()) == " ".join(str(wrong.value).split())
