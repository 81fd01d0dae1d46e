"""Counting on paper: a cam of 5° that closes from 0° to 1°, and a motor of 6°/s, moment by moment."""

from __future__ import annotations

import random

import pytest

from hw.ports import Direction
from hw.sensors.cam import Cam
from hw.sensors.cam_count import CamCount
from tests.tables import every_row

PLUS, MINUS, OFF = Direction.PLUS, Direction.MINUS, Direction.OFF
CAM = Cam(spacing_deg=5.0, closed_deg=1.0, closes_at_deg=0.0, speed_dps=6.0, coast_s=0.5)


def at(angle_deg: float, *, closed: bool, cam: Cam = CAM) -> CamCount:
    count = CamCount(cam)
    assert count.place(0.0, angle_deg, closed=closed)
    return count


# --- the zones


def test_a_shaft_may_stand_two_closures_beyond_an_end_and_sees_no_edge_beyond_its_stop() -> None:
    cam = Cam(10.0, 2.0, 2.5, 6.0, low_deg=0.0, high_deg=360.0)
    assert [cam.reaches(angle_deg) for angle_deg in (-20.1, -20.0, 380.0, 380.1)] == [False, True, True, False]
    assert cam.ahead(cam.zone_at(1.0)) == {PLUS}
    assert cam.ahead(cam.zone_at(3.0)) == {PLUS, MINUS}
    assert cam.ahead(cam.zone_at(357.0)) == {MINUS}


# --- the same closure met again from the other side


def test_turned_back_inside_a_closure_it_is_where_it_came_from() -> None:
    count = at(4.5, closed=False)
    count.drive(0.0, PLUS)
    count.change(0.20, closed=True)
    assert (count.zone, count.angle_deg()) == (2, 5.0)
    count.drive(0.21, OFF)
    count.drive(0.71, MINUS)
    count.change(0.90, closed=False)
    assert (count.zone, count.angle_deg()) == (1, 5.0)
    assert not count.trouble


def test_turned_back_in_the_gap_it_meets_the_same_closure_at_its_other_edge() -> None:
    count = at(4.5, closed=False)
    count.drive(0.0, PLUS)
    count.change(0.20, closed=True)
    count.change(0.37, closed=False)
    count.drive(0.40, OFF)
    count.drive(0.90, MINUS)
    count.change(1.15, closed=True)
    assert (count.zone, count.angle_deg()) == (2, 6.0)
    count.change(1.32, closed=False)
    assert (count.zone, count.angle_deg()) == (1, 5.0)
    assert not count.trouble


# --- what no rotor does


def true_edges(speed_dps: float) -> list[tuple[float, bool, int]]:
    """From 3° on, turning plus: the moment, what the contact does and the zone entered."""
    return [((CAM.begins_deg(zone) - 3.0) / speed_dps + 0.115, zone % 2 == 0, zone) for zone in range(2, 40)]


@pytest.mark.parametrize("speed_dps", [4.8, 6.0, 7.2])
def test_one_false_pulse_anywhere_is_undone_or_noticed(speed_dps: float) -> None:
    edges = true_edges(speed_dps)
    for seed in range(40):
        count = with_a_false_pulse(edges, random.Random(seed))
        assert count.trouble or count.zone == edges[-1][2], f"seed {seed}"


def with_a_false_pulse(edges: list[tuple[float, bool, int]], chance: random.Random) -> CamCount:
    begins_s, lasts_s = chance.uniform(3.0, 12.0), chance.choice([0.02, 0.05, 0.1, 0.2, 0.4])
    levels = sorted({begins_s, begins_s + lasts_s, *(at_s for at_s, _, _ in edges)})
    count = at(3.0, closed=False)
    count.drive(0.0, PLUS)
    was = False
    for at_s in levels:
        closed = [state for edge_s, state, _ in edges if edge_s <= at_s][-1:] == [True]
        if begins_s <= at_s < begins_s + lasts_s:
            closed = not closed
        if closed is not was:
            was = closed
            count.change(at_s, closed=closed)
    return count


@every_row("speed_dps", [4.8, 6.0, 7.2])
@every_row("missed", range(6, 30, 2))
def test_one_pulse_missed_anywhere_is_noticed(missed: int, speed_dps: float) -> None:
    count = at(3.0, closed=False)
    count.drive(0.0, PLUS)
    for at_s, closed, zone in true_edges(speed_dps):
        if zone not in (missed, missed + 1):
            count.change(at_s, closed=closed)
    assert "too late" in count.trouble


@every_row(
    ("pauses_s", "turns"),
    [
        ((0.17, 0.67, 0.17), True),
        ((0.28, 1.1, 0.28), True),  # a motor at six tenths of its speed
        ((0.42, 1.7, 0.42), True),  # at four tenths
        ((0.42, 0.5, 0.42), False),  # wind
        ((0.05, 2.0, 0.05), False),  # wind, which trembles on an edge
        ((0.9, 3.5, 0.9), False),  # slower than any motor
    ],
)
def test_changes_with_no_relay_on_at_the_even_pace_of_a_motor(pauses_s: tuple[float, ...], turns: bool) -> None:
    count = at(3.0, closed=False)
    at_s = 10.0
    count.advance(at_s)
    for place, pause_s in enumerate((0.0, *pauses_s)):
        at_s += pause_s
        count.change(at_s, closed=place % 2 == 0)
    count.advance(at_s + 0.05)
    assert count.turning is turns


def test_three_periods_without_a_pulse() -> None:
    count = at(100.0, closed=True)
    count.drive(0.0, PLUS)
    count.advance(2.4)
    assert not count.quiet
    count.advance(2.6)
    assert count.quiet
    assert "did not change" in count.trouble


# --- placing


@every_row(
    ("angle_deg", "closed", "believed", "zone"),
    [
        (5.5, True, True, 2),
        (5.1, False, True, 1),
        (5.9, False, True, 3),
        (5.5, False, False, 3),  # below the closure or above it? One of them would be off by one
        (5.3, False, False, 1),
        (6.3, True, True, 2),
        (3.5, True, False, 2),
        (4.9, True, True, 2),
        (1.2, True, True, 0),
    ],
)
def test_a_place_must_fit_the_contact(angle_deg: float, closed: bool, believed: bool, zone: int) -> None:
    count = CamCount(CAM)
    assert count.place(0.0, angle_deg, closed=closed) is believed
    assert count.zone == zone
    assert bool(count.trouble) is not believed


PLAY = Cam(spacing_deg=5.0, closed_deg=0.6, closes_at_deg=-0.375, speed_dps=6.0, play_deg=0.3, low_deg=0.0)
"""At its low stop of 0.0° the cam is between 0.0° and 0.3°: closed to 0.225°, open above."""


@pytest.mark.parametrize(("closed", "zone"), [(True, 0), (False, 1)])
def test_at_a_stop_within_the_play_the_contact_says_where_the_cam_is(closed: bool, zone: int) -> None:
    count = at(0.0, closed=closed, cam=PLAY)
    assert (count.zone, count.angle_deg()) == (zone, 0.0)


def test_where_play_makes_a_switchs_place_double_it_is_not_believed() -> None:
    """Within 0.4° of 0.4° is the upper end of the gap below a closure of 0.6°, and with the play the gap above it."""
    cam = Cam(spacing_deg=5.0, closed_deg=0.6, closes_at_deg=0.3, speed_dps=6.0)
    assert CamCount(cam).place(0.0, 0.4, closed=False, within_deg=0.4)
    with_play = Cam(spacing_deg=5.0, closed_deg=0.6, closes_at_deg=0.3, speed_dps=6.0, play_deg=0.2)
    count = CamCount(with_play)
    assert not count.place(0.0, 0.4, closed=False, within_deg=0.4)
    assert count.trouble.startswith("the contact is open, as it is at more than one place within 0.4° of 0.4°")
