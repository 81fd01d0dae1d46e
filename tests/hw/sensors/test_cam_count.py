"""Where a count is placed within an error, how far unread changes lead it, and looking ahead: a cam of 5° and 6°/s.

The closures themselves are counted in `test_cam`.
"""

from __future__ import annotations

import pytest

from hw.ports import Direction
from hw.sensors.cam import Cam
from hw.sensors.cam_count import CamCount

PLUS, MINUS, OFF = Direction.PLUS, Direction.MINUS, Direction.OFF
CAM = Cam(spacing_deg=5.0, closed_deg=1.0, closes_at_deg=0.0, speed_dps=6.0, coast_s=0.5)


def at(angle_deg: float, *, closed: bool, cam: Cam = CAM) -> CamCount:
    count = CamCount(cam)
    assert count.place(0.0, angle_deg, closed=closed)
    return count


# --- placed with an error


@pytest.mark.parametrize(
    ("angle_deg", "closed", "within_deg", "words"),
    [
        (3.0, True, 0.5, "the contact is closed, as it is at no place within 0.5° of 3.0°"),
        (5.5, False, 0.3, "the contact is open, as it is at no place within 0.3° of 5.5°"),
        (5.5, False, 0.8, "the contact is open, as it is at more than one place within 0.8° of 5.5°"),
        (3.0, True, 3.0, "the contact is closed, as it is at more than one place within 3° of 3.0°"),
    ],
)
def test_where_none_or_more_than_one_place_fits_it_is_not_believed(
    angle_deg: float, closed: bool, within_deg: float, words: str
) -> None:
    count = CamCount(CAM)
    assert not count.place(0.0, angle_deg, closed=closed, within_deg=within_deg)
    assert count.trouble == f"{words}: correct home_deg, or move the limit switch"
    assert (count.zone, count.angle_deg()) == (CAM.zone_at(angle_deg), angle_deg)


def test_a_new_place_ends_the_old_trouble_and_what_was_to_be_undone() -> None:
    count = at(4.5, closed=False)
    count.drive(0.0, PLUS)
    count.change(0.20, closed=True)
    assert count.place(0.21, 100.5, closed=True)
    count.change(0.25, closed=False)
    assert count.zone == 41, "no undoing across a new place"
    count.change(0.9, closed=False)
    assert count.trouble
    assert count.place(1.0, 0.5, closed=True)
    assert count.trouble == ""


# --- changes that were not read


@pytest.mark.parametrize(
    ("way", "lost", "closed", "zone"),
    [(PLUS, 1, True, 4), (PLUS, 3, True, 6), (PLUS, 2, False, 5), (MINUS, 2, False, -1)],
)
def test_unread_changes_lead_the_count_on_in_the_direction_of_the_motor(
    way: Direction, lost: int, closed: bool, zone: int
) -> None:
    count = at(5.5, closed=True)
    count.drive(0.0, way)
    count.change(1.0, closed=closed, lost=lost)
    assert count.trouble == f"{lost} changes of the contact went unseen"
    assert count.zone == zone
    assert count.changes == 1


# --- looking ahead


def test_looking_ahead_follows_the_orders_and_changes_no_count() -> None:
    count = at(6.5, closed=False)
    stood_deg = count.angle_deg()
    runs_deg = count.ahead_deg([(0.0, PLUS)], 0.5)
    assert runs_deg == pytest.approx(6.5 + 3.0 - 0.6, abs=0.01)
    assert count.ahead_deg([(0.0, PLUS), (0.3, OFF)], 2.0) == pytest.approx(6.5 + 1.8, abs=0.01)
    assert count.ahead_deg([(0.0, PLUS)], 5.0) == 10.0, "not beyond the next edge"
    assert count.ahead_deg([(0.0, MINUS)], 5.0) == 6.0
    assert count.ahead_deg([], 5.0) == stood_deg == count.angle_deg()
    assert count.at_rest


# --- a motor that turns with no relay on


def turning_at_rest() -> tuple[CamCount, float]:
    """Five changes at the pace of the motor, with no relay on, and when the last one came."""
    count = at(3.0, closed=False)
    at_s = 10.0
    for change, pause_s in enumerate((0.0, 0.17, 0.67, 0.17, 0.67)):
        at_s += pause_s
        count.change(at_s, closed=change % 2 == 0)
    return count, at_s


def test_a_relay_that_closes_ends_that_and_four_changes_show_it_again() -> None:
    count, at_s = turning_at_rest()
    assert count.turning
    count.drive(at_s + 0.05, PLUS)
    assert not count.turning
    count.drive(at_s + 0.1, OFF)
    at_s += 2.0
    closed = count.zone % 2 == 0
    for change, pause_s in enumerate((0.0, 0.17, 0.67, 0.17) if not closed else (0.0, 0.67, 0.17, 0.67)):
        assert not count.turning
        at_s += pause_s
        closed = not closed
        count.change(at_s, closed=closed)
        assert count.turning is (change == 3)
