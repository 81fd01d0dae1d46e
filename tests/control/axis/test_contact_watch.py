"""Whether the relay of an axis that counts has been seen to open: contact and relays by hand, at 20 Hz."""

from __future__ import annotations

import pytest

from hw.ports import Axis, Direction
from rotator.control.axis.motion import Motor
from rotator.control.axis.run_watch import RunWatch
from rotator.control.axis.sensing import Condition
from rotator.control.sky.mount import Range
from rotator.status import Trust

MINUS, OFF, PLUS = Direction
PERIOD_S, COAST_S = 5.0 / 6.0, 0.5
EITHER_WAY = frozenset((PLUS, MINUS))
CLOSED_S, OPEN_S = 1.0 / 6.0, 4.0 / 6.0
"""How long the contact is closed, and open, at 6°/s."""


class Shaft:
    """A watched axis, whose contact changes when the test says so."""

    def __init__(self, *, look: bool = False) -> None:
        motor = Motor(6.0, 0.6)
        self.watch = RunWatch(
            Axis.AZIMUTH, Range(0.0, 360.0), {PLUS: motor, MINUS: motor}, PERIOD_S, COAST_S, look=look
        )
        self.now_s = 100.0
        self._changes = 0
        self.supplied = True
        self.ahead = EITHER_WAY

    def pass_by(self, seconds: float) -> None:
        end_s = self.now_s + seconds
        while self.now_s < end_s - 1e-9:
            self.now_s += 0.05
            self.watch.see(
                self.now_s, 100.0, Condition(changes=self._changes, ahead=self.ahead, supplied=self.supplied)
            )

    def turn(self, changes: int) -> None:
        """So many changes of the contact, at full speed."""
        for count in range(changes):
            self.pass_by((CLOSED_S, OPEN_S)[count % 2])
            self._changes += 1
        self.pass_by(0.05)

    def run(self, way: Direction, changes: int = 6) -> None:
        self.watch.driven(self.now_s, way)
        self.turn(changes)
        self.watch.driven(self.now_s, OFF)


def test_the_opposite_relay_waits_for_a_pause_longer_than_those_of_the_run() -> None:
    shaft = Shaft()
    shaft.run(PLUS)
    shaft.pass_by(COAST_S + PERIOD_S)
    assert shaft.watch.forbids(MINUS)
    assert not shaft.watch.forbids(PLUS)
    shaft.pass_by(0.5 * PERIOD_S + 0.2)
    assert not shaft.watch.forbids(MINUS)


def test_it_waits_for_ever_where_the_contact_goes_on_changing() -> None:
    shaft = Shaft()
    shaft.run(PLUS)
    for _ in range(20):
        shaft.turn(2)
        assert shaft.watch.forbids(MINUS)
    fault = shaft.watch.accuse(MINUS)
    assert fault is not None
    assert fault.name == "relay not seen to open"


def test_silence_shows_nothing_where_no_edge_comes_before_the_stop() -> None:
    shaft = Shaft()
    shaft.run(MINUS)
    shaft.ahead = frozenset((PLUS,))
    shaft.pass_by(60.0)
    assert shaft.watch.forbids(PLUS)
    assert shaft.watch.accuse(PLUS) is not None
    assert shaft.watch.accuse(MINUS) is None


def test_silence_without_a_supply_shows_nothing() -> None:
    shaft = Shaft()
    shaft.run(PLUS)
    shaft.supplied = False
    shaft.pass_by(60.0)
    assert shaft.watch.forbids(MINUS)
    shaft.supplied = True
    shaft.pass_by(3.0)
    assert not shaft.watch.forbids(MINUS)


def test_a_run_in_which_the_contact_never_changed_shows_nothing() -> None:
    shaft = Shaft()
    shaft.watch.driven(shaft.now_s, PLUS)
    shaft.pass_by(4.0 * PERIOD_S)
    shaft.watch.driven(shaft.now_s, OFF)
    shaft.pass_by(60.0)
    assert shaft.watch.accuse(MINUS) is not None
    shaft.run(PLUS)
    shaft.pass_by(3.0)
    assert shaft.watch.accuse(MINUS) is None, "a run of its own has shown it"


def test_a_person_may_look_instead() -> None:
    shaft = Shaft()
    shaft.ahead = frozenset()
    shaft.run(PLUS)
    shaft.pass_by(60.0)
    assert shaft.watch.trusts == (Trust.DOUBTED, Trust.OPEN)
    shaft.watch.checked()
    assert not shaft.watch.forbids(MINUS)


@pytest.mark.parametrize("way", [PLUS, MINUS], ids=["plus", "minus"])
def test_before_its_first_relay_the_contact_is_seen_to_be_silent(way: Direction) -> None:
    shaft = Shaft(look=True)
    shaft.pass_by(1.0)
    assert shaft.watch.forbids(way)
    shaft.pass_by(3.0)
    assert not shaft.watch.forbids(way)
