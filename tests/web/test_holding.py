"""The button that is held: which signs of the finger turn the antenna, and for how long each."""

from __future__ import annotations

from hw.ports import Axis, Direction
from rotator.exchange.orders import Jog
from rotator.web.live import LEASE_S, Holding, Pictures


class Desk:
    """A browser's button, a box that notes its orders, and time in hand."""

    def __init__(self) -> None:
        self.pictures = Pictures()
        self.orders: list[Jog] = []
        self.refuses = ""
        self.button = Holding(self.pictures, self._order)

    def _order(self, jog: Jog) -> str:
        self.orders.append(jog)
        return self.refuses

    @property
    def turns(self) -> bool:
        return bool(self.orders) and self.orders[-1].direction is not Direction.OFF


def test_a_sign_turns_for_what_is_left_of_its_picture_s_lease() -> None:
    desk = Desk()
    number = desk.pictures.next(100.0)
    assert desk.button.sign("cw", 1, number, 100.1) == ""
    (jog,) = desk.orders
    assert (jog.axis, jog.direction, jog.held) == (Axis.AZIMUTH, Direction.PLUS, True)
    assert jog.seconds is not None
    assert abs(jog.seconds - (LEASE_S - 0.1)) < 0.01


def test_no_order_lets_it_turn_for_half_a_second_after_the_last_picture_that_was_seen() -> None:
    desk = Desk()
    number = desk.pictures.next(100.0)
    for step in range(1, 20):
        now_s = 100.0 + step * 0.05
        desk.orders.clear()
        desk.button.sign("cw", step, number, now_s)
        for jog in desk.orders:
            assert jog.direction is Direction.OFF or now_s + (jog.seconds or 0.0) <= 100.5


def test_signs_that_were_stuck_in_the_network_turn_nothing() -> None:
    """The finger left long ago; the signs and the farewell arrive together."""
    desk = Desk()
    number = desk.pictures.next(100.0)
    for later in range(20):
        desk.pictures.next(100.1 + later * 0.1)
    assert "too slow" in desk.button.sign("cw", 1, number, 102.0)
    desk.button.let_go()
    assert desk.orders == []


def test_a_crowd_of_new_browsers_does_not_end_what_is_held() -> None:
    desk = Desk()
    number = desk.pictures.next(100.0)
    for _ in range(100):
        desk.pictures.next(100.1)
    assert desk.button.sign("cw", 1, number, 100.2) == ""


def test_a_number_that_was_never_sent_turns_nothing() -> None:
    desk = Desk()
    seen = [desk.pictures.next(100.0 + at / 100) for at in range(30)]
    ahead = {last + step for last in seen for step in (1, 2, 3, seen[-1] - seen[-2])} - set(seen)
    for number in (0, -1, 10**30, *ahead):
        assert desk.button.sign("cw", 1, number, 100.3)
    assert desk.orders == []
    assert all(0 <= number < 2**53 for number in seen), "JavaScript holds them exactly"


def test_a_press_that_was_lost_for_a_moment_does_not_go_on_by_itself() -> None:
    desk = Desk()
    desk.button.sign("cw", 1, desk.pictures.next(100.0), 100.0)
    assert "press again" in desk.button.sign("cw", 1, desk.pictures.next(101.0), 101.0)
    assert desk.button.sign("cw", 2, desk.pictures.next(101.2), 101.2) == ""


def test_a_sign_of_an_earlier_press_turns_nothing() -> None:
    desk = Desk()
    desk.button.sign("cw", 2, desk.pictures.next(100.0), 100.0)
    assert desk.button.sign("ccw", 1, desk.pictures.next(100.1), 100.1)
    assert desk.orders[-1].direction is Direction.PLUS


def test_to_let_go_stops_that_axis() -> None:
    desk = Desk()
    desk.button.sign("up", 1, desk.pictures.next(100.0), 100.0)
    desk.button.let_go()
    assert desk.orders[-1] == Jog(Axis.ELEVATION, Direction.OFF, held=True)
    desk.button.let_go()
    assert len(desk.orders) == 2


def test_another_button_lets_go_of_the_first() -> None:
    desk = Desk()
    desk.button.sign("up", 1, desk.pictures.next(100.0), 100.0)
    desk.button.sign("cw", 2, desk.pictures.next(100.1), 100.1)
    assert desk.orders[1] == Jog(Axis.ELEVATION, Direction.OFF, held=True)
    assert desk.orders[2].axis is Axis.AZIMUTH


def test_what_the_box_refuses_is_not_tried_again_by_the_same_press() -> None:
    desk = Desk()
    desk.refuses = "stopped"
    assert desk.button.sign("cw", 1, desk.pictures.next(100.0), 100.0) == "stopped"
    desk.refuses = ""
    assert desk.button.sign("cw", 1, desk.pictures.next(100.1), 100.1)
    assert len(desk.orders) == 1
