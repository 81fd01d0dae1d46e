"""The file of what the box remembers, and its second place in memory: which is read, written and believed."""

from __future__ import annotations

import logging
import os
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from rotator.store.hanging import writes
from rotator.store.state import DAMAGED, FORM, LOST, Section, State
from tests.refusing import hanging, refuse, wait_until

NOTHING, UNREADABLE = -1, -2


def number(name: str) -> Section[int]:
    """A section that holds a number."""
    return Section(name, lambda content: int(content["n"]), lambda n: {"n": n}, NOTHING, UNREADABLE, "ignored")


STOP, TRIES, KNOBS = number("latch"), number("tries"), number("knobs")


@pytest.fixture
def card(tmp_path: Path) -> Path:
    return tmp_path / "card" / "state.json"


@pytest.fixture
def memory(tmp_path: Path) -> Path:
    return tmp_path / "memory"


def on_card(card: Path) -> tuple[int, int]:
    """What is left after a power cut: the stop and the knobs."""
    state = State(card)
    return state.load(STOP), state.load(KNOBS)


def test_without_a_file_nothing_is_known_and_none_appears(card: Path, caplog: pytest.LogCaptureFixture) -> None:
    state = State(card)
    assert state.load(STOP) == NOTHING
    assert state.save()
    assert not card.parent.exists()
    assert not caplog.records


def test_all_sections_are_in_one_file_that_a_person_can_read(card: Path) -> None:
    state = State(card)
    state.note(STOP, 1)
    assert state.keep(KNOBS, 2)
    assert on_card(card) == (1, 2)
    assert [each.name for each in card.parent.iterdir()] == [card.name]
    assert f'"format": "{FORM.today}"' in card.read_text()


def test_what_the_card_has_is_not_written_again(card: Path) -> None:
    state = State(card)
    state.keep(STOP, 1)
    written_ns = card.stat().st_mtime_ns
    for again in (state, State(card)):
        again.keep(STOP, 1)
    assert card.stat().st_mtime_ns == written_ns


# --- memory


def test_a_card_in_order_is_all_that_is_left(card: Path, memory: Path) -> None:
    state = State(card, memory)
    assert state.keep(STOP, 7)
    assert (state.trouble, state.outlives, state.in_memory) == ("", True, False)
    assert not list(memory.iterdir())


def test_what_the_card_refuses_is_read_from_memory_until_the_card_takes_it(
    card: Path, memory: Path, caplog: pytest.LogCaptureFixture
) -> None:
    State(card, memory).keep(STOP, 1)
    blocked = refuse(card)
    state = State(card, memory)
    assert not state.keep(STOP, 2)
    assert not state.save()
    assert [record.levelno for record in caplog.records] == [logging.ERROR], "each reason once"
    assert "directory" in state.trouble
    assert state.outlives
    later = State(card, memory)
    assert later.in_memory
    assert later.load(STOP) == 2
    assert on_card(card)[0] == 1
    blocked.rmdir()
    assert later.save()
    assert on_card(card)[0] == 2
    assert not list(memory.iterdir())
    assert state.save(), "the refusal ends for the first one too"


def test_where_neither_takes_it_nothing_outlives_the_program(card: Path, memory: Path) -> None:
    refuse(card)
    refuse(memory / card.name)
    for place in (None, memory):
        state = State(card, place)
        assert not state.keep(STOP, 2)
        assert not state.outlives
        assert not State(card, place).in_memory


def test_what_changes_too_often_for_a_card_is_in_memory_alone(card: Path, memory: Path) -> None:
    state = State(card, memory)
    state.keep(TRIES, 1)
    written_ns = card.stat().st_mtime_ns
    state.note(TRIES, 2, lasting=1)
    assert not state.unwritten
    assert state.save()
    assert card.stat().st_mtime_ns == written_ns
    assert State(card, memory).load(TRIES) == 2
    assert State(card).load(TRIES) == 1
    state.keep(TRIES, 1)
    assert not list(memory.iterdir())


def test_memory_has_only_what_must_outlive_a_kill(card: Path, memory: Path) -> None:
    refuse(card)
    state = State(card, memory)
    state.note(STOP, 1)
    state.keep(KNOBS, 2)
    assert (State(card, memory).load(STOP), State(card, memory).load(KNOBS)) == (1, NOTHING)


def test_a_memory_that_cannot_be_looked_at_may_hold_something_newer(card: Path, tmp_path: Path) -> None:
    State(card).keep(STOP, 1)
    state = State(card, tmp_path / ("x" * 300))  # longer than a name may be: not even root sees whether it is there
    assert state.in_memory
    assert state.load(STOP) == UNREADABLE


def test_while_the_card_hangs_memory_has_the_newest_and_after_it_the_card(card: Path, memory: Path) -> None:
    state = State(card, memory)
    state.keep(STOP, 0)
    state.note(STOP, 1)
    with hanging(card):
        writer = threading.Thread(target=state.save, daemon=True)
        writer.start()
        wait_until(lambda: memory.exists() and list(memory.iterdir()) and card in writes().values())
        # The last one is what the card had: it may have something else by the time that the write ends.
        for newer in (2, 3, 0):
            state.note(STOP, newer)
            assert state.unspared
            state.spare()
            assert not state.unspared
            assert State(card, memory).load(STOP) == newer
            assert on_card(card)[0] == 0
    writer.join()
    assert State(card, memory).load(STOP) == 0
    assert state.save()
    assert on_card(card)[0] == 0
    assert not list(memory.iterdir())


# --- damage


FILES: dict[str, bytes] = {
    "empty": b"",
    "zeros": b"\0" * 200,
    "cut": b'{"format": "rotator state 2", "latch": {"n"',
    "a list": b"[]",
    "null": b"null",
    "no format": b"{}",
    "another file": b'{"format": "rotator counts 1"}',
    "deep": b"[" * 100_000,
    "too long": b'{"format": "rotator state 2"}' + b" " * 1_000_000,
    "no text": b"\xff\xfe\xff",
}


@pytest.mark.parametrize("name", FILES)
def test_a_damaged_file_may_have_held_a_stop_and_is_kept_aside(
    card: Path, name: str, caplog: pytest.LogCaptureFixture
) -> None:
    card.parent.mkdir()
    card.write_bytes(FILES[name])
    state = State(card)
    assert state.load(STOP) == UNREADABLE
    assert state.load(KNOBS) == NOTHING
    assert "nothing in it is believed" in caplog.text
    assert state.keep(KNOBS, 5)
    assert on_card(card) == (UNREADABLE, 5), "who knows nothing of a stop does not end it"
    assert card.with_name(card.name + DAMAGED).read_bytes() == FILES[name]
    assert f"is kept in {card.name}{DAMAGED}" in caplog.text
    assert state.keep(STOP, 0)
    assert on_card(card) == (0, 5)


def test_a_pipe_in_place_of_the_file_keeps_nobody_waiting(card: Path) -> None:
    card.parent.mkdir()
    os.mkfifo(card)
    state = State(card)
    assert state.load(STOP) == UNREADABLE
    assert state.keep(STOP, 1), "where no copy can be kept, a stop is kept all the same"
    assert on_card(card)[0] == 1


@pytest.mark.parametrize("content", [LOST, {"n": "x"}, {"n": None}, [], 5, "n"])
def test_a_damaged_section_leaves_the_others_alone(card: Path, content: Any, caplog: pytest.LogCaptureFixture) -> None:
    raw: Section[Any] = Section("latch", lambda found: found, lambda value: value, None, None, "")
    state = State(card)
    state.note(KNOBS, 5)
    state.keep(raw, content)
    assert on_card(card) == (UNREADABLE, 5)
    assert f"{card}: latch: ignored" in caplog.text
    other = State(card)
    other.keep(KNOBS, 6)
    assert on_card(card) == (UNREADABLE, 6)


def test_the_file_of_a_later_version_stays_and_memory_keeps_a_stop(
    card: Path, memory: Path, caplog: pytest.LogCaptureFixture
) -> None:
    card.parent.mkdir()
    card.write_text('{"format": "rotator state 3", "what": "only the later version knows"}')
    before = card.read_bytes()
    state = State(card, memory)
    assert state.load(STOP) == UNREADABLE
    assert not state.keep(STOP, 1)
    assert "a later version of the program wrote it" in state.trouble
    assert "update the program, or move the file away. The file stays as it is" in caplog.text
    assert State(card, memory).load(STOP) == 1
    assert card.read_bytes() == before
    assert [each.name for each in card.parent.iterdir()] == [card.name]
    card.unlink()
    assert State(card, memory).save()
    assert on_card(card)[0] == 1


# --- two programs


def replaced(path: Path, old: bytes) -> None:
    path.unlink()
    path.write_bytes(old)


WAYS: dict[str, Callable[[Path, bytes], object]] = {
    "deleted": lambda path, _old: path.unlink(),
    "emptied": lambda path, _old: path.write_bytes(b""),
    "garbled": lambda path, _old: path.write_bytes(b"\x00" * 100),
    "an older copy": lambda path, old: path.write_bytes(old),
    "replaced by an older copy": replaced,
}


@pytest.mark.parametrize("way", WAYS)
def test_what_the_box_knows_is_written_again(card: Path, way: str) -> None:
    state = State(card)
    state.keep(KNOBS, 1)
    old = card.read_bytes()
    state.keep(STOP, 2)
    WAYS[way](card, old)
    assert state.save()
    assert on_card(card) == (2, 1)


def test_another_program_s_sections_stay_and_its_old_knowledge_of_ours_does_not(card: Path) -> None:
    box, calibration = State(card), State(card)
    assert box.load(STOP) == NOTHING
    calibration.keep(KNOBS, 5)
    box.keep(STOP, 1)
    assert on_card(card) == (1, 5)
    calibration.keep(KNOBS, 6)
    assert on_card(card) == (1, 6), "who has not read the stop does not end it"
    box.keep(STOP, 2)
    assert on_card(card) == (2, 6)
    State(card).keep(STOP, 9)
    box.save()
    assert on_card(card) == (2, 6), "who has read it answers for it"


def test_who_knows_nothing_of_a_stop_leaves_memory_alone(card: Path, memory: Path) -> None:
    compass, box = State(card, memory), State(card, memory)
    blocked = refuse(card)
    box.keep(STOP, 1)
    assert not compass.keep(KNOBS, 5)
    assert State(card, memory).load(STOP) == 1
    blocked.rmdir()
    assert compass.save()
    assert State(card, memory).load(STOP) == 1


def test_two_programs_at_once_lose_nothing(card: Path) -> None:
    def keep(name: str) -> None:
        state = State(card)
        for each in range(50):
            state.keep(number(name), each)

    writers = [threading.Thread(target=keep, args=(name,)) for name in ("latch", "tries", "knobs")]
    for writer in writers:
        writer.start()
    for writer in writers:
        writer.join()
    state = State(card)
    assert [state.load(number(name)) for name in ("latch", "tries", "knobs")] == [49, 49, 49]
