"""The mode that a person has set at no switch: on the page, or on the console."""

from __future__ import annotations

import pytest

from rotator.control.authority import Authority
from rotator.control.rights import Deed
from rotator.exchange.orders import Mode
from rotator.exchange.sources import Source

ANNA, BERT = Source("page", 1), Source("page", 2)
CONSOLE, LATER, PANEL, PC = Source("console", 1), Source("console", 2), Source("panel"), Source("gs232b", 1)


def switched(by: Source, mode: Mode) -> Authority:
    authority = Authority()
    authority.switch(by, mode)
    return authority


def movers(authority: Authority, deed: Deed = Deed.AIM) -> set[Source]:
    return {each for each in (ANNA, BERT, CONSOLE, LATER, PANEL, PC) if authority.allows(each, 0.0, deed)}


@pytest.mark.parametrize(
    ("mode", "aim", "jog"),
    [
        (Mode.AUTO, {ANNA, BERT, CONSOLE, LATER, PANEL, PC}, {ANNA, BERT, CONSOLE, LATER, PANEL, PC}),
        (Mode.MANUAL, {ANNA, PANEL}, {ANNA, PANEL}),
        (Mode.JOG, {PANEL}, {ANNA, PANEL}),
        (Mode.PARK, set(), set()),
    ],
)
def test_who_moves_what_in_a_mode_of_the_page(mode: Mode, aim: set[Source], jog: set[Source]) -> None:
    authority = switched(ANNA, mode)
    assert movers(authority) == aim
    assert movers(authority, Deed.JOG) == jog


def test_on_the_console_each_command_has_a_connection_of_its_own() -> None:
    assert movers(switched(CONSOLE, Mode.MANUAL)) == {CONSOLE, LATER}
    assert movers(switched(CONSOLE, Mode.JOG), Deed.JOG) == {CONSOLE, LATER}


def test_a_person_who_takes_the_antenna_over_ends_the_other_person_s_mode() -> None:
    authority = switched(ANNA, Mode.MANUAL)
    authority.take(BERT, stopped=True)
    assert (authority.mode, authority.mode_by) == (Mode.AUTO, "")
    assert BERT in movers(authority)
    assert ANNA not in movers(authority), "Bert holds it"


def test_a_person_who_takes_it_in_a_mode_of_the_same_person_keeps_the_mode() -> None:
    authority = switched(ANNA, Mode.MANUAL)
    authority.take(ANNA, stopped=True)
    assert authority.mode is Mode.MANUAL
    assert ANNA in movers(authority)


def test_giving_back_lets_programs_move_it() -> None:
    authority = switched(ANNA, Mode.MANUAL)
    authority.take(ANNA, stopped=True)
    authority.give_back(ANNA)
    assert PC in movers(authority)


@pytest.mark.parametrize("mode", [Mode.MANUAL, Mode.JOG, Mode.PARK])
def test_only_a_hand_turns_a_real_switch(mode: Mode) -> None:
    authority = switched(PANEL, mode)
    authority.take(ANNA, stopped=True)
    authority.give_back(ANNA)
    assert authority.mode is mode
    assert PC not in movers(authority)
