"""The keys of `rotator run`: STOP is one key at any moment, and no single key starts a motor."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotator.cli.run_keys import RunKeys
from rotator.orders import Park, Release, Stop
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


@pytest.mark.parametrize("text", ["park\r", "PARK\n", "px\x7fpark\r", "\x1b[Apark\r", "par\rk\r"])
def test_the_word_parks(bench: BenchBox, text: str) -> None:
    assert typed(bench, text).line == "park: done"
    assert bench.orders == [Park(storm=True)]


@pytest.mark.parametrize("text", ["paxrk\r", "pxaorrk\r", "pa5rk\r", "resxume\r", "pa-rk\r"])
def test_a_slip_ends_the_word(bench: BenchBox, text: str) -> None:
    typed(bench, text)
    assert bench.orders == []


def test_the_word_releases(bench: BenchBox) -> None:
    assert typed(bench, " resume\r").line == "resume: done"
    assert bench.orders == [Stop(latch=True), Release()]


def test_what_is_typed_shows(bench: BenchBox) -> None:
    assert typed(bench, "pa").line == "> pa_  Enter does it"
    assert typed(bench, "pa5").line == "5 is no key here; begin again"
    assert typed(bench, "pa\r").line == "> pa_  write it whole: park or resume"
    assert typed(bench, "5").line == "5 is no key here"
    assert typed(bench, "pa\x1b").line == ""


def test_a_word_without_effect_says_why(bench: BenchBox) -> None:
    assert typed(bench, " park\r").line == "park: stopped by link#1: nothing moves until resume"


def test_a_park_after_a_later_stop_is_not_called_done(bench: BenchBox) -> None:
    keys = typed(bench, " resume\r")
    bench.wait(1.0)
    for pressed in " park\r":
        keys.key(pressed)
    assert keys.line == "park: stopped by link#1: nothing moves until resume"


def test_a_release_does_not_say_that_a_fault_is_gone() -> None:
    bench = BenchBox(blind=True)
    bench.wait(1.0)
    assert typed(bench, "resume\r").line == "resume: a fault stays until repaired"


def test_q_quits_at_any_moment(bench: BenchBox) -> None:
    assert RunKeys(bench).key("q")
    assert typed(bench, "pa").key("q")


@given(st.lists(st.sampled_from(ANY_KEY), max_size=40))
def test_no_keys_without_a_whole_word_start_anything(keys: list[str]) -> None:
    bench = BenchBox()
    typed(bench, "".join(keys))
    letters = "".join(key.lower() for key in keys)
    may = {"park": Park, "resume": Release}
    allowed = [order for word, order in may.items() if all(letter in letters for letter in word)]
    assert all(isinstance(order, (Stop, *allowed)) for order in bench.orders)
