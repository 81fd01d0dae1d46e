"""The states that hold the box back, as a person on the page or at the console sees them."""

from __future__ import annotations

from typing import Any

import pytest

from rotator.control.rights import State, holds
from rotator.exchange.orders import Mode
from rotator.exchange.sources import Source
from rotator.exchange.status import AxisStatus, Status

ANNA, BERT, CONSOLE = Source("page", 1), Source("page", 2), Source("console", 3)


def status(**more: Any) -> Status:
    return Status(at_s=0.0, azimuth=AxisStatus(0, 450), elevation=AxisStatus(0, 180), **more)


@pytest.mark.parametrize("source", [ANNA, CONSOLE, None])
def test_a_box_that_nothing_holds_back(source: Source | None) -> None:
    assert holds(status(), source) == {}


@pytest.mark.parametrize(("source", "held"), [(BERT, True), (ANNA, False), (CONSOLE, False), (None, False)])
def test_another_person_s_hold_concerns_the_page_and_not_the_console(source: Source | None, held: bool) -> None:
    found = holds(status(held_by="page#1"), source)
    assert found == ({State.HELD: "page#1 holds the antenna: take it over first"} if held else {})


@pytest.mark.parametrize(("by", "own"), [("page#1", True), ("page#2", False), ("panel", False)])
def test_the_mode_that_a_person_has_set_does_not_hold_back_that_person(by: str, own: bool) -> None:
    assert (holds(status(mode=Mode.MANUAL, mode_by=by), ANNA) == {}) is own


@pytest.mark.parametrize(("by", "own"), [("console#7", True), ("page#2", False)])
def test_on_the_console_every_command_has_another_connection(by: str, own: bool) -> None:
    assert (holds(status(mode=Mode.MANUAL, mode_by=by)) == {}) is own


def test_a_stop_holds_back_everyone_and_is_named() -> None:
    for source in (ANNA, CONSOLE, None):
        (words,) = holds(status(latched="page#2"), source).values()
        assert "stopped by page#2" in words
