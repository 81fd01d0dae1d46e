"""The keys of `rotator run`: STOP is one key at any moment, and no single key starts a motor."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from hw.ports import Axis, Direction
from rotator.cli.run_keys import RunKeys
from rotator.exchange.orders import Aim, Jog, Order, Park, Release, Stop
from tests.protocols.conftest import BenchBox

ANY_KEY = [chr(code) for code in range(256)]


@pytest.fixture
def bench() -> BenchBox:
    return BenchBox()


def typed(bench: BenchBox, text: str) -> RunKeys:
    keys = RunKeys(bench)
    for character in text:
        keys.key(character)
    return keys


def test_no_single_key_starts_a_motor_or_releases_it() -> None:
    for key in ANY_KEY:
        bench = BenchBox()
        typed(bench, key)
        assert bench.orders == ([Stop(latch=True)] if key == " " else []), repr(key)


@pytest.mark.parametrize("before", ["", "p", "par", "park", "x", "\x1b", "\x1b[", "resum"])
def test_stop_is_one_key_whatever_has_been_typed(bench: BenchBox, before: str) -> None:
    keys = typed(bench, before + " ")
    assert bench.orders == [Stop(latch=True)]
    assert keys.line == ""
    keys.key("\r")
    assert bench.orders == [Stop(latch=True)], "the word is forgotten"


@pytest.mark.parametrize(
    "text",
    ["stop", "STOP", "stop\r", "s\r", "S\n", "st\r", "sto\r", "stpo\r", "xxstop", "parkstop", "pstop\r", "\x1bstop"],
)
@pytest.mark.parametrize("before", ["", "\r", "x\r", "par\r", "\x1b[A"])
def test_whoever_types_stop_stops(bench: BenchBox, before: str, text: str) -> None:
    typed(bench, before + text)
    assert bench.orders == [Stop(latch=True)]


@pytest.mark.parametrize("word", ["park", "resume"])
def test_after_stop_the_next_word_counts(bench: BenchBox, word: str) -> None:
    """As on the first evening: s-t-o-p and Enter, and then a word."""
    keys = typed(bench, "stop\r")
    assert keys.line == "stop: done"
    for key in f"{word}\r":
        keys.key(key)
    told = {"park": "park: stopped by link#1: nothing moves until resume", "resume": "resume: done"}
    assert keys.line == told[word]


@pytest.mark.parametrize(
    "text", ["park\r", "PARK\n", "px\x7fark\r", "\x1b[Apark\r", "par\rpark\r", "x\rpark\r", "x\x1bpark\r"]
)
def test_the_word_parks(bench: BenchBox, text: str) -> None:
    assert typed(bench, text).line == "park: done"
    assert bench.orders == [Park(storm=True)]


@pytest.mark.parametrize("text", ["paxrk\r", "pxaorrk\r", "pa5rk\r", "rexume\r", "pa-rk\r", "xpark\r", "par\rk\r"])
def test_a_slip_spoils_the_line_until_enter(bench: BenchBox, text: str) -> None:
    typed(bench, text)
    assert bench.orders == []


def test_a_slip_is_told_once_whatever_follows(bench: BenchBox) -> None:
    keys, told = typed(bench, "pak"), set()
    for key in "resumeparkhello":
        keys.key(key)
        told.add(keys.line)
    assert told == {"> pak_  no such word: Enter clears it"}
    keys.key("\r")
    assert keys.line == "pak: no such word. Type stop, park, resume, or a command such as point 180 45"
    assert bench.orders == []


def test_the_word_releases(bench: BenchBox) -> None:
    assert typed(bench, " resume\r").line == "resume: done"
    assert bench.orders == [Stop(latch=True), Release()]


def test_what_is_typed_shows(bench: BenchBox) -> None:
    assert typed(bench, "pa").line == "> pa_  park, then Enter"
    assert typed(bench, "res").line == "> res_  resume, then Enter"
    assert typed(bench, "sto").line == "> sto_  Enter does it"
    assert typed(bench, "pa5").line == "> pa5_  no such word: Enter clears it"
    assert typed(bench, "pa\r").line == "pa: no such word. Type stop, park, resume, or a command such as point 180 45"
    assert typed(bench, "pa\x1b").line == ""
    assert typed(bench, "p\x7f").line == ""


@pytest.mark.parametrize("word", ["stop", "park", "resume"])
def test_enter_does_what_the_line_says_that_it_does(word: str) -> None:
    for end in range(1, len(word) + (word != "stop")):
        bench = BenchBox()
        keys = typed(bench, word[:end])
        promised = keys.line.endswith("Enter does it")
        keys.key("\r")
        assert promised == bool(bench.orders), word[:end]


def test_a_release_does_not_say_that_a_fault_is_gone() -> None:
    bench = BenchBox(blind=True)
    bench.wait(1.0)
    assert typed(bench, "resume\r").line.startswith("resume: the cause is still there: azimuth: ")


@pytest.mark.parametrize(
    ("text", "order"),
    [
        ("point 180 45", Aim(180.0, 45.0)),
        ("Rotator POINT 180,5 45", Aim(180.5, 45.0)),
        ("jog cw 0.5", Jog(Axis.AZIMUTH, Direction.PLUS, 0.5)),
        ("rotator park", Park(storm=True)),
    ],
)
def test_a_command_is_typed_here_as_in_another_terminal(bench: BenchBox, text: str, order: Order) -> None:
    assert typed(bench, text).line == f"> {text.lower()}_  Enter does it"
    assert bench.orders == []
    assert typed(bench, f"{text}\r").line.endswith(": done")
    assert bench.orders == [order]


@pytest.mark.parametrize(
    "text", ["point 180 4 5", "point 900 45", "point x", "jog round 1", "track iss", "track qo-100", "home azimuth"]
)
def test_a_command_that_is_none_says_why_and_stops_nothing(bench: BenchBox, text: str) -> None:
    told = typed(bench, f"{text}\r").line
    assert told.startswith(f"{text}: ")
    assert len(told) > len(text) + 10
    assert bench.orders == []


@pytest.mark.parametrize("text", ["status", "status json", "rotator where", "where", "pair", "track", "help", "let-go"])
def test_a_question_stops_nothing_either(bench: BenchBox, text: str) -> None:
    assert typed(bench, f"{text}\r").line
    assert bench.orders == []


@pytest.mark.parametrize("before", ["point", "point x", "track iss", "rotator", "jog cw"])
def test_a_second_blank_stops(bench: BenchBox, before: str) -> None:
    keys = typed(bench, f"{before}  ")
    assert bench.orders == [Stop(latch=True)]
    assert keys.line == ""


def test_q_quits_a_box_at_rest_at_any_moment(bench: BenchBox) -> None:
    assert RunKeys(bench).key("q")
    assert typed(bench, "pa").key("q")


def test_q_asks_once_while_the_antenna_is_on_its_way() -> None:
    bench = BenchBox(at=(100.0, 30.0))
    bench.order(Aim(200.0, 30.0))
    bench.wait(1.0)
    assert bench.status().moving
    keys = RunKeys(bench)
    assert not keys.key("q")
    assert keys.line == "The antenna is on its way. q again to quit"
    assert not keys.key("x"), "another key takes it back"
    assert not keys.key("q")
    assert keys.key("q")


def test_q_asks_too_where_the_antenna_turns_by_itself() -> None:
    """As with a welded relay: the box that sees it should not go by one slip."""
    bench = BenchBox(at=(100.0, 30.0))
    for step in range(60):
        bench.stands_near(100.0 + step * 0.3)
    assert bench.status().azimuth.by_itself_dps > 5.0
    assert not RunKeys(bench).key("q")


@given(st.lists(st.sampled_from(ANY_KEY), max_size=40))
def test_no_keys_without_a_whole_word_start_anything(keys: list[str]) -> None:
    bench = BenchBox()
    typed(bench, "".join(keys))
    letters = "".join(key.lower() for key in keys)
    may = {"park": Park, "resume": Release}
    allowed = [order for word, order in may.items() if set(word) <= set(letters)]
    assert all(isinstance(order, (Stop, *allowed)) for order in bench.orders)
