"""`rotator calibrate` in a terminal, typed by a person who slips: keys held, letters in numbers, narrow windows."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from hw.ports import Axis, Direction
from rotator.calibrating.entries import Entry, Number, StopNow, Unknown, Word
from rotator.calibrating.facts import AxisFacts
from rotator.calibrating.table_guide import TableGuide
from rotator.exchange.status import AxisStatus, Status

StartInTerminal = Callable[..., Any]


@pytest.mark.parametrize("columns", [40, 80])
def test_words_stay_whole_and_a_held_key_is_counted(
    start_in_terminal: StartInTerminal, config: Path, columns: int
) -> None:
    guide = start_in_terminal("calibrate", "azimuth", "--config", config, columns=columns)
    seen = guide.until(r"Press r \(clockwise\)")
    guide.press("z" * 300)
    seen += guide.until(r"\(300 times\)")
    guide.press("q")
    assert guide.ends() == 1
    seen += guide.rest
    rows = re.sub(r"\x1b\[[0-9;?]*[A-Za-z]", "", seen).replace("\r", "\n").split("\n")
    assert max(map(len, rows)) <= columns
    assert len([row for row in rows if "'z' means nothing here." in row]) <= 1
    text = " ".join(" ".join(rows).split())
    assert "The box does not know its limits yet: be ready to cut the motors' supply." in text
    assert "q or Ctrl-C leaves: the motors stop, nothing is saved." in text


STANDS = Status(
    0.0, AxisStatus(0.0, 450.0, raw=0.5, drive=Direction.OFF), AxisStatus(0.0, 180.0, raw=0.5, drive=Direction.OFF)
)


@pytest.mark.parametrize("entry", [Word.ENTER, Number(438.5), Unknown("x")])
def test_an_answer_without_a_question_is_not_lost_in_silence(entry: Entry) -> None:
    guide = TableGuide(AxisFacts(Axis.AZIMUTH, 0.0, 450.0, 0.02, 0.98), 3.3)
    assert "Not taken: wait until the box asks." in guide.step(STANDS, entry).lines


def test_a_stop_needs_no_question() -> None:
    guide = TableGuide(AxisFacts(Axis.AZIMUTH, 0.0, 450.0, 0.02, 0.98), 3.3)
    assert "Not taken: wait until the box asks." not in guide.step(STANDS, StopNow()).lines


def test_what_is_typed_is_seen_on_a_narrow_terminal(start_in_terminal: StartInTerminal, config: Path) -> None:
    """The open question is longer than a row there."""
    guide = start_in_terminal("calibrate", "azimuth", "--config", config, columns=40)
    guide.until(r"Press r \(clockwise\)")
    guide.press("12345,")
    guide.until("12345,")
    guide.press("\x7f" * 6 + "q")
    assert guide.ends() == 1
