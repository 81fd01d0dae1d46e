"""What the operator types is taken whole or refused: no text that is not one number is ever read as a number."""

from __future__ import annotations

import re

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from hw.ports import Axis, Direction
from rotator.calibrating.entries import NUMBER_FORM, Entry, Keyboard, Number, Press, StopNow, Unknown, Word, from_line
from rotator.config.load import parse
from rotator.control.axis.goals import UNCALIBRATED_JOG_S
from tests.calibrating.rig import QUIET, Calibration
from tests.search import examples
from tests.tables import every_row

ONE_NUMBER = re.compile(r"[+-]?[0-9]{1,4}([.,][0-9]{0,4})?")
NEAR_NUMBERS = st.text("0123456789.,-+ eExX°'\t", min_size=1, max_size=10)
LINES = st.text(st.characters(exclude_characters="\r\n", codec="utf-8"), max_size=12)


def keys(text: str) -> list[Entry]:
    """What single keys lead to, with Enter at the end."""
    keyboard = Keyboard()
    return [entry for key in (*text, "\r") if (entry := keyboard.key(key)) is not None]


@every_row(
    ("text", "value"), [("438.5", 438.5), ("438,5", 438.5), ("-2", -2.0), ("+5", 5.0), (" 90 ", 90.0), ("0,25", 0.25)]
)
def test_one_number(text: str, value: float) -> None:
    assert from_line(text) == Number(value)
    assert keys(text.strip()) == [Number(value)]


@given(st.one_of(NEAR_NUMBERS, LINES))
@example("438,5,1")
@example("4-5")
@example("1e3")
@example("٣")
@example("5 0")
def test_a_line_is_one_number_or_none(text: str) -> None:
    entry = from_line(text)
    if ONE_NUMBER.fullmatch(text.strip()):
        assert entry == Number(float(text.strip().replace(",", ".")))
    else:
        assert not isinstance(entry, Number)


@given(st.one_of(NEAR_NUMBERS, LINES.filter(lambda text: "\x1b" not in text)))
@example("438x5")
@example("43r5")
@example("4,3,5")
@example("43s5")
@example("43 5")
def test_keys_are_one_number_or_none(text: str) -> None:
    """Backspace apart, the keys that were typed are judged whole."""
    text = text.replace("\x7f", "").replace("\b", "")
    numbers = [entry for entry in keys(text) if isinstance(entry, Number)]
    begun = text.lstrip("".join(set(text) - set("0123456789.,-+")))
    if ONE_NUMBER.fullmatch(begun.strip()):
        assert numbers == [Number(float(begun.strip().replace(",", ".")))]
    else:
        assert not numbers


def test_the_right_form_is_shown() -> None:
    assert from_line("438,5,1") == Unknown("438,5,1", NUMBER_FORM)
    assert "438.5" in NUMBER_FORM


def test_a_refused_text_is_gone_and_backspace_mends_one_before_enter() -> None:
    assert keys("438,x\r438.5") == [Unknown("438,x", NUMBER_FORM), Number(438.5)]
    assert keys("438,x\x7f5") == [Number(438.5)]


@pytest.mark.parametrize("text", ["?", "h", "help"])
def test_help_is_an_entry(text: str) -> None:
    assert from_line(text) == Word.HELP


def test_an_arrow_within_a_number_turns_nothing_and_drops_nothing() -> None:
    assert [type(entry) for entry in keys("43\x1b[C8")] == [Unknown, Number]
    assert keys("43\x1b[C8")[1] == Number(438.0)


@pytest.mark.parametrize("key", [" ", "s", "S"])
def test_a_stop_within_a_number_stops_at_once(key: str) -> None:
    keyboard = Keyboard()
    for character in "43":
        assert keyboard.key(character) is None
    assert keyboard.key(key) == StopNow()


@pytest.mark.parametrize("before", ["\x1b", "\x1b[", "\x1bO", "\x1b\x1b"])
def test_a_stop_after_escape_stops(before: str) -> None:
    assert keys(before + "s")[0] == StopNow()
    assert keys(before + " ")[0] == StopNow()


@pytest.mark.parametrize("line", ["s", "stop", "stop it", "S 5"])
def test_a_line_that_begins_with_stop_stops(line: str) -> None:
    assert from_line(line) == StopNow()


def test_keys_that_turn() -> None:
    assert keys("r")[0] == Press(Axis.AZIMUTH, Direction.PLUS, 0.7)
    assert keys("D")[0] == Press(Axis.ELEVATION, Direction.MINUS, UNCALIBRATED_JOG_S)
    assert keys("\x1b[D")[0] == keys("\x1bOD")[0] == Press(Axis.AZIMUTH, Direction.MINUS, 0.7)
    assert keys("12\x7f\x7f") == [Word.ENTER]
    assert from_line("r 0,5") == Press(Axis.AZIMUTH, Direction.PLUS, 0.5)
    assert from_line("r 99") == Press(Axis.AZIMUTH, Direction.PLUS, UNCALIBRATED_JOG_S)
    assert isinstance(from_line("r fast"), Unknown)


@pytest.fixture(scope="module")
def at_the_angle() -> Calibration:
    """A calibration whose open question is the angle of the low end."""
    run = Calibration(parse(QUIET, "test"))
    run.say("r", "y", "l", "")
    return run


@given(st.one_of(NEAR_NUMBERS, LINES))
@settings(max_examples=examples(60), deadline=None)
@example("438,5,1")
@example("438.5x")
def test_a_question_for_an_angle_takes_nothing_else(at_the_angle: Calibration, text: str) -> None:
    """The guide asks again, shows the right form, and nothing can be saved."""
    entry = from_line(text)
    if not isinstance(entry, Unknown):
        return
    said = at_the_angle.say(text)
    assert "means nothing here" in said
    assert entry.form in said
    assert at_the_angle.guide.prompt.startswith("Which angle is that")
    assert not at_the_angle.guide.ended
    assert at_the_angle.guide.result is None
