"""What `rotator track` tells of a box whose tracking ends, rests, or is taken over while it asks."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from hw.ports import Axis
from rotator.exchange.faults import Fault, FaultKind
from rotator.exchange.status import AxisStatus, Flown
from tests.cli.scripted import Rotator, pointed

STANDS = pointed(AxisStatus(0.0, 450.0, 200.0), by="")
WHY = "the plan rests for 9:50 min more, after an order of {}"
RESTS = f"rests: {WHY.format('page#1')}"
ENDED = "rotator: another person has ended the tracking meanwhile\n"


@pytest.mark.parametrize(
    ("words", "states", "code", "told"),
    [
        # A direction needs no plan.
        ("200 30", ["off"], 0, "The antenna goes there, and stays.\n"),
        ("200 30", [RESTS], 0, "The antenna goes there, and stays.\n"),
        ("iss", ["planning", "off"], 1, ENDED),
        ("iss", ["planning", RESTS], 1, ENDED),
        ("iss", ["planning", "ended: page#1 stopped it"], 1, "rotator: the page stopped it\n"),
        ("iss", ["planning", "refused: ISS does not rise"], 1,
         "rotator: ISS does not rise; what was tracked goes on\n"),
        ("", ["off"], 0, "The box tracks nothing.\n"),
        ("", ["planning"], 0, "The box makes a plan.\n"),
        ("", ["ended: console#2 stopped it"], 0, "The box tracks nothing: a rotator command stopped it.\n"),
        ("", [RESTS], 0, f"The box tracks nothing: {WHY.format('the page')}; `rotator track plan` ends that.\n"),
    ],
)  # fmt: skip
def test_what_it_tells(
    scripted: Any, rotator_here: Rotator, config: Path, *, words: str, states: list[str], code: int, told: str
) -> None:
    scripted(STANDS).states = states
    done = rotator_here("track", *words.split(), "--config", config)
    assert (done.returncode, done.stdout + done.stderr) == (code, told)


@pytest.mark.parametrize(("words", "told"), [("200 30", "The antenna goes there"), ("iss", "ISS is up")])
def test_a_fault_that_holds_the_antenna_is_told(
    scripted: Any, rotator_here: Rotator, config: Path, words: str, told: str
) -> None:
    fault = Fault(FaultKind.POT_OPEN, Axis.AZIMUTH, "reads 0.000", "0.02 to 0.98")
    flown = Flown("ISS", begin_s=0.0, end_s=600.0, expected_error_deg=0.0)
    held = pointed(AxisStatus(0.0, 450.0, 200.0, fault=fault), by="", flown=flown)
    scripted(held).states = ["off" if words[0] == "2" else "tracking"]
    done = rotator_here("track", *words.split(), "--config", config)
    assert done.returncode == 3
    assert done.stdout.startswith(told)
    assert str(fault) in done.stderr
