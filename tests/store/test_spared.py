"""A file on the card with a place in memory beside it: which of the two is read, written and believed."""

from __future__ import annotations

import os
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Any

import pytest

from rotator.store.forms import Form
from rotator.store.spared import SparedFile
from rotator.store.whole import NEW
from tests.refusing import refuse

FORM = Form("rotator test")
NOTHING, DAMAGED = -1, -2
PATIENCE_S = 20.0


@pytest.fixture
def card(tmp_path: Path) -> Path:
    return tmp_path / "card" / "it.json"


@pytest.fixture
def memory(tmp_path: Path) -> Path:
    return tmp_path / "memory"


def opened(card: Path, memory: Path | None) -> SparedFile:
    return SparedFile(card, FORM, "the number", memory)


def number(content: dict[str, Any]) -> int:
    return int(content["number"])


def loaded(file: SparedFile) -> int:
    return file.load(number, absent=NOTHING, damaged=DAMAGED, consequence="ignored")


def test_a_card_in_order_is_all_that_is_written(card: Path, memory: Path) -> None:
    file = opened(card, memory)
    assert loaded(file) == NOTHING
    assert file.save({"number": 7})
    assert (file.trouble, file.outlives, file.in_memory) == ("", True, False)
    assert file.path == card
    assert not list(memory.iterdir())
    assert loaded(opened(card, None)) == 7


WRITES_SEVEN = """
import sys
from pathlib import Path
from tests.store.test_spared import opened
opened(Path(sys.argv[1]), Path(sys.argv[2])).save({"number": 7})
"""


def test_while_the_card_hangs_a_killed_program_leaves_the_newest_in_memory(card: Path, memory: Path) -> None:
    opened(card, memory).save({"number": 1})
    os.mkfifo(card.with_name(card.name + NEW))  # a write to it waits for ever, as on a card that hangs
    program = subprocess.Popen([sys.executable, "-c", WRITES_SEVEN, card, memory])
    pause, since_s = threading.Event(), time.monotonic()
    while not (memory / card.name).exists() and time.monotonic() < since_s + PATIENCE_S:
        pause.wait(0.02)
    program.kill()
    program.wait()
    assert loaded(opened(card, memory)) == 7
    assert loaded(opened(card, None)) == 1, "the card has not taken it"


def test_what_the_card_refuses_is_read_from_memory_until_the_card_takes_it(card: Path, memory: Path) -> None:
    assert opened(card, memory).save({"number": 1})
    blocked = refuse(card)
    file = opened(card, memory)
    assert not file.save({"number": 2})
    assert "directory" in file.trouble
    assert (file.outlives, file.in_memory) == (True, True)
    assert loaded(opened(card, memory)) == 2
    assert loaded(opened(card, None)) == 1, "after a power cut there is only the card"
    blocked.rmdir()
    assert file.save({"number": 3})
    assert (file.trouble, file.in_memory) == ("", False)
    assert loaded(opened(card, memory)) == 3


def test_where_neither_takes_it_nothing_outlives_the_program(card: Path, memory: Path) -> None:
    refuse(card)
    for place in (None, memory):
        if place:
            refuse(memory / card.name)
        file = opened(card, place)
        assert not file.save({"number": 2})
        assert not file.outlives
        assert not file.in_memory


def test_a_note_wears_no_card_and_is_newer_than_it(card: Path, memory: Path) -> None:
    file = opened(card, memory)
    file.save({"number": 1})
    file.note({"number": 2})
    assert loaded(opened(card, None)) == 1
    assert loaded(opened(card, memory)) == 2
    for _ in range(2):
        file.forget_note(file.noted)
        assert loaded(opened(card, memory)) == 1


def test_without_a_memory_a_note_is_none(card: Path) -> None:
    file = opened(card, None)
    file.note({"number": 2})
    file.forget_note(file.noted)
    assert not file.in_memory
    assert not card.parent.exists()


def test_a_memory_that_cannot_be_looked_at_may_hold_something_newer(card: Path, tmp_path: Path) -> None:
    opened(card, None).save({"number": 1})
    file = opened(card, tmp_path / ("x" * 300))  # longer than a name may be: not even root sees whether it is there
    assert file.in_memory
    assert loaded(file) == DAMAGED
