"""The form of every file that the box keeps: a format name, and content that may be damaged in any way."""

from __future__ import annotations

import logging
from pathlib import Path
from typing import Any

import pytest

from rotator.store.json_file import Form, JsonFile, decode, encode
from rotator.store.json_file import number as within
from tests.tables import every_row

FORM = Form("rotator test")


def number(content: dict[str, Any]) -> int:
    return int(content["number"]) + 0 * len(content["words"].split())


def test_there_and_back() -> None:
    text = encode(FORM, {"number": 5, "words": "a b"})
    assert text.endswith("}\n"), "a whole line: a person may look at it"
    assert decode(FORM, text, number) == 5


@every_row(
    ("text", "reason"),
    [
        ("", "Expecting value"),
        ("[]", "its format is not 'rotator test 1'"),
        ("5", "its format is not"),
        ('"rotator test 1"', "its format is not"),
        ("{}", "its format is not"),
        ('{"format": "rotator tests 1", "number": 5, "words": ""}', "its format is not"),
        ('{"format": "rotator test 0", "number": 5, "words": ""}', "its format is not"),
        ('{"format": "rotator test one", "number": 5, "words": ""}', "its format is not"),
        ('{"format": ["rotator test 1"], "number": 5, "words": ""}', "its format is not"),
        ('{"format": "rotator test 2", "number": 5, "words": ""}', "a later version of the program wrote it"),
        ('{"format": "rotator test 1", "words": ""}', "the key number is missing"),
        ('{"format": "rotator test 1", "number": "five", "words": ""}', "invalid literal"),
        ('{"format": "rotator test 1", "number": null, "words": ""}', "int"),
        ('{"format": "rotator test 1", "number": 5, "words": 5}', "has no attribute"),
        ("[" * 100_000, "has too many brackets inside each other"),
    ],
)
def test_whatever_is_wrong_is_one_kind_of_error_with_a_reason(text: str, reason: str) -> None:
    with pytest.raises(ValueError, match=reason):
        decode(FORM, text, number)


def test_an_error_without_words_has_its_name() -> None:
    def wordless(_content: dict[str, Any]) -> int:
        raise TypeError

    with pytest.raises(ValueError, match="TypeError"):
        decode(FORM, encode(FORM, {}), wordless)


@pytest.fixture
def file(tmp_path: Path) -> JsonFile:
    return JsonFile(tmp_path / "run" / "of" / "it.json", FORM, "the number")


ABSENT, DAMAGED = -1, -2


def loaded(file: JsonFile) -> int:
    return file.load(number, absent=ABSENT, damaged=DAMAGED, consequence="ignored")


def test_it_makes_its_folders_and_is_read_again(file: JsonFile, caplog: pytest.LogCaptureFixture) -> None:
    assert loaded(file) == ABSENT
    assert file.save({"number": 7, "words": "°"})
    assert file.save({"number": 8, "words": "°"})
    assert loaded(file) == 8
    assert file.trouble == ""
    assert not caplog.records


def test_a_damaged_file_is_told_with_what_it_means(file: JsonFile, caplog: pytest.LogCaptureFixture) -> None:
    file.path.parent.mkdir(parents=True)
    for damage in (b"{", b"\xff\xfe"):
        file.path.write_bytes(damage)
        caplog.clear()
        assert loaded(file) == DAMAGED
        assert f"{file.path}: ignored: " in caplog.text


def test_a_later_version_s_file_is_said_and_never_written_over(
    file: JsonFile, caplog: pytest.LogCaptureFixture
) -> None:
    file.save({"number": 7, "words": ""})
    later = file.path.read_text().replace("test 1", "test 2")
    file.path.write_text(later)
    assert loaded(file) == DAMAGED
    assert "The file stays as it is" in caplog.text
    assert not file.save({"number": 8, "words": ""})
    assert file.path.read_text() == later
    assert file.trouble.endswith("update the program, or move the file away")


def test_what_cannot_be_read_is_as_good_as_damaged(file: JsonFile, caplog: pytest.LogCaptureFixture) -> None:
    file.path.mkdir(parents=True)
    assert loaded(file) == DAMAGED
    assert f"{file.path}: ignored: " in caplog.text


@pytest.mark.parametrize(("size", "read"), [(100_000, 7), (100_001, DAMAGED)])
def test_a_file_a_hundred_times_too_long_is_not_ours(file: JsonFile, size: int, read: int) -> None:
    file.save({"number": 7, "words": ""})
    text = file.path.read_text()
    file.path.write_text(text + " " * (size - len(text)))
    assert loaded(file) == read


@pytest.mark.parametrize("value", [2, 2.0, 2.5, 3])
def test_a_number_within_its_bounds_is_taken(value: float) -> None:
    found = within(value, "the speed", 2.0, 3.0)
    assert found == value
    assert isinstance(found, float)


@every_row("value", [1.999, 3.001, 10**400, -(10**400), float("nan"), True, "2.5", None, [2.5]])
def test_any_other_is_refused_in_a_short_sentence(value: object) -> None:
    with pytest.raises(ValueError, match=r"^the speed is .*; it must be a number from 2 to 3$") as refused:
        within(value, "the speed", 2.0, 3.0)
    assert len(str(refused.value)) < 120


def test_a_write_that_fails_is_logged_once_for_each_reason(file: JsonFile, caplog: pytest.LogCaptureFixture) -> None:
    root = file.path.parents[1]
    root.write_text("")  # a file where its folder should be: not even root writes there
    for _ in range(3):
        assert not file.save({"number": 7})
    (said,) = caplog.records
    assert said.levelno == logging.ERROR
    assert f"{file.path}: the number cannot be kept: " in said.getMessage()
    assert file.trouble in said.getMessage()
    root.unlink()
    assert file.save({"number": 7, "words": ""})
    assert file.trouble == "", "a good write ends the trouble"
    assert loaded(file) == 7
    root.rename(root.with_name("gone"))
    root.write_text("")
    assert not file.save({"number": 7})
    assert len(caplog.records) == 2, "and the next one is told again"
