"""What `rotator track` tells of a box whose tracking ends, rests, or is taken over while it asks."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from rotator.exchange.status import AxisStatus
from tests.cli.scripted import Rotator, pointed, said, why

STANDS = pointed(AxisStatus(0.0, 450.0, 200.0), by="")
RESTS = "rests: the plan rests for 9:50 min more, after an order of page#1; `rotator track plan` ends that"


@pytest.mark.parametrize(
    ("states", "told"),
    [
        (["off"], "The antenna goes there, and stays.\n"),
        ([RESTS], "The antenna goes there, and stays.\n"),
    ],
)
def test_a_direction_needs_no_plan(
    scripted: Any, rotator_here: Rotator, config: Path, states: list[str], told: str
) -> None:
    scripted(STANDS).states = states
    assert said(rotator_here("track", "200", "30", "--config", config)) == told


@pytest.mark.parametrize(
    ("states", "told"),
    [
        (["planning", "off"], "another person has ended the tracking meanwhile"),
        (["planning", RESTS], "another person has ended the tracking meanwhile"),
        (["planning", "ended: page#1 stopped it"], "the page stopped it"),
        (["planning", "refused: ISS does not rise"], "ISS does not rise; what was tracked goes on"),
    ],
)
def test_who_asked_hears_what_came_instead(
    scripted: Any, rotator_here: Rotator, config: Path, states: list[str], told: str
) -> None:
    scripted(STANDS).states = states
    assert told in why(rotator_here("track", "iss", "--config", config))


@pytest.mark.parametrize(
    ("state", "told"),
    [
        ("off", "The box tracks nothing.\n"),
        ("planning", "The box makes a plan.\n"),
        ("ended: console#2 stopped it", "The box tracks nothing: a rotator command stopped it.\n"),
        (RESTS, f"The box tracks nothing: {RESTS.removeprefix('rests: ').replace('page#1', 'the page')}.\n"),
    ],
)
def test_without_words_it_tells_the_reason(
    scripted: Any, rotator_here: Rotator, config: Path, state: str, told: str
) -> None:
    scripted(STANDS).states = [state]
    assert said(rotator_here("track", "--config", config)) == told
