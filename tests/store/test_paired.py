"""The file of those who may move the antenna: what it takes, and that no number is used twice."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from rotator.store.paired import Paired, PairedFile, PairedList

DIGEST = "0123456789abcdef" * 4
PHONE = Paired(3, "a phone", DIGEST, 1_800_000_000.0, 0.0)
KEPT = PairedList((PHONE, Paired(5, "x" * 40, "f" * 64, 1e11, 1e11)), highest=9)


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "run" / "paired.json"


def test_there_and_back_with_the_highest_number_ever_used(path: Path) -> None:
    assert PairedFile(path).save(KEPT)
    assert PairedFile(path).load() == KEPT
    assert PairedFile(path).save(PairedList((), highest=9))
    assert PairedFile(path).load() == PairedList((), highest=9), "the last one has gone, and its number with it"


def test_without_a_file_none_is_paired(path: Path) -> None:
    assert PairedFile(path).load() == PairedList((), 0)


def test_the_highest_number_is_never_below_one_in_use(path: Path) -> None:
    PairedFile(path).save(PairedList(KEPT.paired, highest=1))
    assert PairedFile(path).load().highest == 5


def test_a_file_of_an_earlier_version_has_no_highest_number(path: Path) -> None:
    PairedFile(path).save(KEPT)
    whole = json.loads(path.read_text())
    del whole["highest"]
    path.write_text(json.dumps(whole))
    assert PairedFile(path).load() == PairedList(KEPT.paired, highest=5)


def row(number: int) -> dict[str, Any]:
    return {"number": number, "name": "n", "digest": DIGEST, "since_s": 0, "seen_s": 0}


def test_64_are_kept(path: Path) -> None:
    many = PairedList(tuple(Paired(number, "n", DIGEST, 0.0, 0.0) for number in range(1, 65)), highest=64)
    PairedFile(path).save(many)
    assert PairedFile(path).load() == many


@pytest.mark.parametrize(
    "spoil",
    [
        lambda whole: whole["paired"][0].update(name=""),
        lambda whole: whole["paired"][0].update(name="x" * 41),
        lambda whole: whole["paired"][0].update(name="a\x1b[2J"),
        lambda whole: whole["paired"][0].update(name=5),
        lambda whole: whole["paired"][0].update(digest=DIGEST[1:]),
        lambda whole: whole["paired"][0].update(digest=DIGEST.upper()),
        lambda whole: whole["paired"][0].update(digest=None),
        lambda whole: whole["paired"][0].update(number=0),
        lambda whole: whole["paired"][0].update(number=1_000_001),
        lambda whole: whole["paired"][0].update(number=5),
        lambda whole: whole["paired"][0].update(since_s=-1),
        lambda whole: whole["paired"][0].update(seen_s=1.1e11),
        lambda whole: whole.update(paired=[row(number) for number in range(1, 66)]),
        lambda whole: whole.update(highest=-1),
        lambda whole: whole.update(highest=1_000_001),
    ],
)
def test_a_damaged_file_lets_none_in(
    path: Path, spoil: Callable[[dict[str, Any]], None], caplog: pytest.LogCaptureFixture
) -> None:
    PairedFile(path).save(KEPT)
    whole = json.loads(path.read_text())
    spoil(whole)
    path.write_text(json.dumps(whole))
    assert PairedFile(path).load() == PairedList()
    assert "browsers must be paired anew" in caplog.text


def test_a_card_that_refuses_is_told(path: Path) -> None:
    path.parent.write_text("a file where its folder should be")
    assert not PairedFile(path).save(KEPT)
