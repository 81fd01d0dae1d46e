"""Which turn, answer by answer: an encoder that knows the angle within a turn of the antenna, and one behind a gear."""

from __future__ import annotations

import math

import pytest

from hw.moteus.orders import Answer, Home, Mode, MoteusSpec
from hw.moteus.placing import LOST, Placing

DIRECT = MoteusSpec(1, geared=False, min_deg=0.0, max_deg=450.0)
GEARED = MoteusSpec(1, rev_per_turn=2.0, geared=True, min_deg=0.0, max_deg=450.0)


def says(shown_deg: float, home: Home = Home.ROTOR, mode: Mode = Mode.STOPPED, spec: MoteusSpec = DIRECT) -> Answer:
    return Answer(mode, spec.revolutions(shown_deg), 0.0, 24.0, 30.0, 0, home)


def direct() -> Placing:
    """A direct drive at 270° whose controller has just said -90°."""
    placing = Placing(DIRECT)
    assert placing.see(says(-90.0)) == pytest.approx(0.75)
    return placing


@pytest.mark.parametrize("home", [Home.RELATIVE, Home.ROTOR])
def test_behind_a_gear_only_the_output_s_position_is_one(home: Home) -> None:
    placing = Placing(GEARED)
    assert placing.unknown == LOST
    assert placing.see(says(100.0, home, spec=GEARED)) is None
    assert placing.unknown == LOST
    placing = Placing(GEARED)
    placing.see(says(100.0, Home.OUTPUT, spec=GEARED))
    assert placing.unknown == ""
    assert placing.angle_deg(says(101.0, Home.OUTPUT, spec=GEARED)) == pytest.approx(101.0)


def test_an_encoder_that_knows_nothing_is_lost_without_a_gear_too() -> None:
    placing = Placing(DIRECT)
    placing.see(says(100.0, Home.RELATIVE))
    assert placing.unknown == LOST


def test_the_turn_in_the_range_is_given_until_the_controller_has_taken_it() -> None:
    placing = direct()
    assert placing.unknown == ""
    assert placing.angle_deg(says(-90.0)) == pytest.approx(270.0)
    assert placing.see(says(-86.4)) == pytest.approx(0.76), "it was turned meanwhile"
    assert placing.see(says(-86.4, Home.OUTPUT)) == pytest.approx(0.76), "an answer older than the order"
    assert placing.see(says(273.6, Home.OUTPUT)) is None
    assert placing.angle_deg(says(275.0, Home.OUTPUT)) == pytest.approx(275.0)


def test_where_the_controller_s_turn_is_the_right_one_it_is_given_so_that_it_is_sure() -> None:
    placing = Placing(DIRECT)
    assert placing.see(says(200.0)) == pytest.approx(200 / 360)
    placing = Placing(DIRECT)
    assert placing.see(says(200.0, Home.OUTPUT)) is None
    assert placing.unknown == ""


@pytest.mark.parametrize(("mode", "known"), [(Mode.POSITION, True), (Mode.TIMEOUT, True), (Mode.STOPPED, False)])
def test_what_an_earlier_run_moved_is_in_its_turn_and_what_nothing_moved_may_be_in_either(
    mode: Mode, known: bool
) -> None:
    placing = Placing(DIRECT)
    placing.see(says(405.0, Home.OUTPUT, mode))
    if known:
        assert placing.unknown == ""
        assert placing.angle_deg(says(405.0, Home.OUTPUT)) == pytest.approx(405.0)
    else:
        assert "the antenna stands at 45° or at 405°: look at its cables" in placing.unknown


def test_an_antenna_may_have_been_pushed_five_degrees_beyond_its_range() -> None:
    for shown_deg, known in ((-4.9, True), (-5.1, False), (454.9, True), (455.1, False)):
        placing = Placing(GEARED)
        placing.see(says(shown_deg, Home.OUTPUT, spec=GEARED))
        assert (placing.unknown == "") is known
        assert known or placing.unknown.startswith(f"shows {shown_deg:.0f}°, outside of 0° to 450°")


@pytest.mark.parametrize(("jump_deg", "known"), [(179.0, True), (-179.0, True), (181.0, False), (-181.0, False)])
def test_a_leap_of_half_a_turn_between_two_answers_is_a_lost_supply(jump_deg: float, known: bool) -> None:
    placing = Placing(GEARED)
    placing.see(says(200.0, Home.OUTPUT, spec=GEARED))
    placing.see(says(200.0 + jump_deg, Home.OUTPUT, spec=GEARED))
    assert placing.unknown == ("" if known else LOST)
    placing.see(says(200.0, Home.OUTPUT, spec=GEARED))
    assert placing.unknown == ("" if known else LOST), "only a person says where it is"


def test_an_answer_without_a_position_makes_the_angle_unknown() -> None:
    placing = direct()
    assert placing.see(says(math.nan)) is None
    assert placing.unknown == "has no position: check its encoder"


def test_a_person_s_word_takes_the_place_of_a_turn_that_was_not_taken_yet() -> None:
    placing = direct()
    placing.doubt()
    assert (placing.unknown, placing.given_rev) == (LOST, None)
    placing.confirmed()
    assert placing.unknown == ""
    assert placing.see(says(20.0, Home.OUTPUT)) is None, "at any angle of the new scale"
    assert placing.angle_deg(says(20.0, Home.OUTPUT)) == pytest.approx(20.0)
    placing.doubt()
    assert placing.unknown == "", "the controller has it already"


@pytest.mark.parametrize(
    ("shown_deg", "said_deg", "agreed_deg"),
    [(45.0, 60.0, 45.0), (45.0, 400.0, 405.0), (45.0, 135.0, 45.0), (45.0, 135.5, None), (-90.0, 300.0, 270.0)],
)
def test_an_encoder_within_a_turn_needs_only_the_turn(
    shown_deg: float, said_deg: float, agreed_deg: float | None
) -> None:
    agreed = Placing(DIRECT).agreed_deg(says(shown_deg), said_deg)
    assert agreed == (None if agreed_deg is None else pytest.approx(agreed_deg))


@pytest.mark.parametrize(
    ("spec", "answer"),
    [
        (GEARED, says(45.0, spec=GEARED)),
        (DIRECT, says(45.0, Home.RELATIVE)),
        (DIRECT, says(math.nan)),
    ],
)
def test_an_encoder_that_does_not_know_the_angle_cannot_contradict(spec: MoteusSpec, answer: Answer) -> None:
    assert Placing(spec).agreed_deg(answer, 200.0) == 200.0
