"""What the relays of an axis do, and what they did last."""

from __future__ import annotations

import math

import pytest

from hw.ports import Direction
from rotator.control.axis.relay_state import RelayState

MINUS, OFF, PLUS = Direction
RUN = RelayState().changed(10.0, PLUS)


def test_at_the_start_they_have_been_open_for_ever() -> None:
    relays = RelayState()
    assert (relays.closed, relays.last, relays.off_for_s(10.0)) == (False, OFF, math.inf)


def test_a_run_and_its_end() -> None:
    assert RelayState(PLUS, since_s=10.0, last=PLUS, begun_s=10.0) == RUN
    assert (RUN.closed, RUN.off_for_s(12.0)) == (True, 0.0)
    ended = RUN.changed(15.0, OFF)
    assert ended == RelayState(OFF, since_s=15.0, last=PLUS, begun_s=10.0)
    assert (ended.closed, ended.off_for_s(17.0)) == (False, 2.0)
    assert ended.changed(20.0, MINUS) == RelayState(MINUS, since_s=20.0, last=MINUS, begun_s=20.0)


def test_the_same_order_again_changes_nothing() -> None:
    assert RUN.changed(12.0, PLUS) is RUN
    ended = RUN.changed(15.0, OFF)
    assert ended.changed(16.0, OFF) is ended


def test_a_reversal_without_a_pause_ends_the_run_before_it() -> None:
    assert RUN.changed(12.0, MINUS) == RelayState(MINUS, since_s=12.0, last=MINUS, begun_s=12.0)


@pytest.mark.parametrize(
    ("open_s", "again", "begun_s"), [(0.05, PLUS, 10.0), (0.15, PLUS, 15.15), (0.05, MINUS, 15.05)]
)
def test_a_relay_that_only_blinked_goes_on_with_its_run(open_s: float, again: Direction, begun_s: float) -> None:
    relays = RUN.changed(15.0, OFF).changed(15.0 + open_s, again)
    assert (relays.since_s, relays.begun_s) == (15.0 + open_s, begun_s)
