"""What a drill takes for held off by a person on the page, and how a button on the page ends: from the script alone."""

from __future__ import annotations

import pytest

from benchmarks.drills.goals import Ranges
from benchmarks.drills.orders import Orders
from benchmarks.drills.script import Event
from tests.drills.scripted import Script

NONE = (False, False)


def test_take_stops_what_goes_on_and_holds_programs_off_until_it_is_given_back() -> None:
    script = Script()
    script.say("gs232b", "aim", 100.0, 40.0)
    script.say("page", "take")
    assert script.moves == NONE
    script.say("gs232b", "aim", 200.0, 40.0)
    assert script.moves == NONE
    script.say("page", "give-back")
    script.say("gs232b", "aim", 200.0, 40.0)
    assert script.moves == (True, True)


@pytest.mark.parametrize("what", ["aim", "jog"])
def test_a_person_at_the_box_is_not_held_off(what: str) -> None:
    script = Script()
    script.say("page", "take")
    script.say("console", what, *((200.0, 40.0) if what == "aim" else ("cw", 2.0)))
    assert script.moves[0]


def test_what_the_page_moved_may_hold_a_program_off_and_both_are_excused() -> None:
    script = Script()
    script.say("page", "aim", 100.0, 40.0)
    script.say("gs232b", "aim", 200.0, 60.0)
    assert script.moves == (True, True)
    assert not any(goal.angles_deg for who, goal in script.orders.axes["azimuth"].goals.items() if who == "gs232b")


@pytest.mark.parametrize(("waits_s", "turns"), [(0.4, True), (0.8, False)])
def test_a_button_without_signs_ends_within_its_lease(waits_s: float, turns: bool) -> None:
    script = Script()
    script.say("page", "hold", "cw")
    script.wait(waits_s)
    assert script.moves == (turns, False)


def test_a_button_that_is_let_go_ends_at_once() -> None:
    script = Script()
    script.say("page", "hold", "up")
    script.say("page", "hold", "off")
    script.wait(0.25)
    assert script.moves == NONE


def test_at_an_end_of_the_range_what_went_on_may_go_on() -> None:
    """The box refuses the jog with the reason."""
    script = Script()
    script.orders = Orders(
        (Ranges(0.0, 360.0, False), Ranges(0.0, 180.0, False)), (0.0, 0.0), at_end=lambda _axis, way: way < 0
    )
    script.say("console", "aim", 100.0, 40.0)
    script.say("console", "jog", "down", 0.5)
    script.wait(20.0)
    assert script.moves == (True, True)
    script.say("console", "jog", "up", 0.5)
    script.wait(20.0)
    assert script.moves == (True, False)


def test_a_panel_s_switch_that_is_read_for_the_first_time_may_end_what_was_taken_before() -> None:
    orders = Orders((Ranges(0.0, 360.0, False), Ranges(0.0, 180.0, False)), (0.0, 0.0))
    orders.note(Event(0.5, "page", "take"))
    orders.note(Event(2.0, "gs232b", "aim", (200.0, 40.0)))
    assert orders.holds("azimuth")
