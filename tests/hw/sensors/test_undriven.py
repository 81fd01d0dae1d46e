"""The changes of a contact with no relay on: those of a motor are even, those of wind are not. A cam of 5° and 6°/s."""

from __future__ import annotations

import pytest

from hw.sensors.cam import Cam
from hw.sensors.undriven import UndrivenChanges

CAM = Cam(spacing_deg=5.0, closed_deg=1.0, closes_at_deg=0.0, speed_dps=6.0)
CLOSED_S, OPEN_S = 1.0 / 6.0, 4.0 / 6.0


def changes(*pauses_s: float) -> tuple[UndrivenChanges, float]:
    """A closing at 10 s, then a change after each pause; and the moment of the last one."""
    undriven, at_s = UndrivenChanges(CAM), 10.0
    undriven.note(at_s, closed=True)
    for place, pause_s in enumerate(pauses_s):
        at_s += pause_s
        undriven.note(at_s, closed=place % 2 == 1)
    return undriven, at_s


@pytest.mark.parametrize(
    ("pace", "shown"),
    [(2.1, False), (1.9, True), (1.0, True), (0.6, True), (0.31, True), (0.29, False)],
)
def test_an_even_pace_from_a_third_to_twice_the_speed_is_a_motor(pace: float, shown: bool) -> None:
    undriven, at_s = changes(CLOSED_S / pace, OPEN_S / pace, CLOSED_S / pace)
    assert undriven.show_motor(at_s + 0.1) is shown


def test_three_changes_show_nothing_yet() -> None:
    undriven, at_s = changes(CLOSED_S, OPEN_S)
    assert not undriven.show_motor(at_s)
    undriven.note(at_s + CLOSED_S, closed=False)
    assert undriven.show_motor(at_s + CLOSED_S)


def test_pauses_of_one_length_are_the_wind_about_an_edge() -> None:
    undriven, at_s = changes(0.5, 0.5, 0.5)
    assert not undriven.show_motor(at_s)


def test_a_contact_that_then_stays_as_it_is_shows_that_the_motor_has_stopped() -> None:
    undriven, at_s = changes(CLOSED_S, OPEN_S, CLOSED_S)
    assert undriven.show_motor(at_s + 1.9 * OPEN_S)
    assert not undriven.show_motor(at_s + 2.1 * OPEN_S)


def test_a_relay_that_closes_ends_the_evidence() -> None:
    undriven, at_s = changes(CLOSED_S, OPEN_S, CLOSED_S)
    undriven.forget()
    assert not undriven.show_motor(at_s)
