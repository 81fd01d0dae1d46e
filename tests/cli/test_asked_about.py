"""What a person tells the box of its antenna: `rotator confirm`, `home`, `let-go`; `resume` and `where` at a fault."""

from __future__ import annotations

import json
import re
import signal
from pathlib import Path
from typing import Any

import pytest

from hw.ports import Axis
from rotator.exchange.faults import Fault, FaultKind
from rotator.exchange.status import AxisStatus, Status
from tests.cli.scripted import COMMAND, Rotator, Start, StartInTerminal, counted, why


def test_letting_go_is_asked_about_first(
    scripted: Any, rotator: Rotator, start_in_terminal: StartInTerminal, config: Path
) -> None:
    console = scripted(counted(0))
    for key, code, told in (("n", 1, "nothing was done"), ("y", 0, "Nothing moves until `rotator resume`.")):
        assert console.heard == []
        asking = start_in_terminal("let-go", "--config", config)
        asking.until(r"an antenna that is out of balance turns. Let go of it\? \[y/N\]: ")
        asking.press(f"{key}\r")
        assert asking.ends() == code
        assert told in asking.rest
    assert console.heard == ["let-go"]
    assert why(rotator("let-go", "--config", config)) == "rotator: nothing was done (--yes does it without asking)\n"


def test_ctrl_c_stops_an_axis_that_homes(scripted: Any, start_in_terminal: StartInTerminal, config: Path) -> None:
    console = scripted(counted(123), counted(123, turns=True))
    homing = start_in_terminal("home", "azimuth", "--config", config)
    homing.until(r"Watch the antenna: azimuth turns to its low end. Ctrl-C stops it. Begin\? \[y/N\]: ")
    assert console.heard == []
    homing.press("y\r")
    homing.until("azimuth 123.0°")
    homing.press("\x03")
    assert homing.ends() == 1
    assert console.heard == ["home azimuth", "stop"]


def test_a_terminal_that_closes_stops_an_axis_that_homes(scripted: Any, start: Start, config: Path) -> None:
    console = scripted(counted(123), counted(123, turns=True))
    homing = start("home", "azimuth", "--yes", "--config", config)
    assert console.ordered.wait(60)
    assert homing.stop(signal.SIGHUP) == 1
    assert console.heard == ["home azimuth", "stop"]


def test_both_axes_with_a_fault(scripted: Any, rotator_here: Rotator, config: Path) -> None:
    faults = [Fault(FaultKind.POT_OPEN, axis, "reads 0.000", "0.02 to 0.98") for axis in Axis]
    azimuth, elevation = (AxisStatus(0.0, 180.0, 10.0, fault=fault, seen=False) for fault in faults)
    scripted(Status(0.0, azimuth, elevation))
    done = rotator_here("where", "--json", "--config", config)
    assert done.returncode == 3
    told = json.loads(done.stdout)
    assert [told[axis.value]["fault"]["text"] for axis in Axis] == [str(fault) for fault in faults]
    assert [told[axis.value]["angle_is_current"] for axis in Axis] == [False, False]


@pytest.mark.parametrize("answers", [0, 1, 3])
@pytest.mark.parametrize(
    "words",
    [
        "where", "where --json", "point 180 45", "jog cw 1", "park", "home azimuth --yes", "track iss", "track",
        "confirm azimuth 10", "resume", "let-go --yes", "tell status", "stop", "pair --list",
    ],
)  # fmt: skip
def test_of_a_box_that_ends_meanwhile_it_is_said_that_it_has_ended(
    scripted: Any, rotator_here: Rotator, config: Path, words: str, answers: int
) -> None:
    console = scripted(counted(20, turns=True), counted(20, turns=True, by=COMMAND))
    console.states = ["planning"] * 9
    console.ends_after = answers
    done = rotator_here(*words.split(), "--config", config)
    if console.ends_after >= 0:
        return  # it asked no more than that
    assert re.search(r"\b(the box|it) has ended\b", why(done))
    assert "no box runs" not in done.stderr
