"""Which turn, answer by answer: an encoder that knows the angle within a turn of the antenna, and one behind a gear."""

from __future__ import annotations

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
