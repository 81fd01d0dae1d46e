"""What a person tells the box of its antenna: `rotator confirm`, `home`, `let-go`; `resume` and `where` at a fault."""

from __future__ import annotations

import json
import re
import signal
from pathlib import Path
from typing import Any

import pytest

from hw.ports import Axis
from rotator.exchange.faults import Fault, FaultKind, Missing
from rotator.exchange.status import AxisStatus, Status
from tests.cli.scripted import COMMAND, Rotator, Start, StartInTerminal, counted, pointed, said, why


def test_letting_go_is_asked_about_first(
    scripted: Any, rotator: Rotator, start_in_terminal: StartInTerminal, config: Path
) -> None:
    console = scripted(counted(0))
    for key, code, told in (("n", 1, "nothing was done"), ("y", 0, "Nothing moves until `rotator resume`.")):
        assert console.heard == []
        asking = start_in_terminal("let-go", "--config", config)
        asking.until(r"an antenna that is out of balance turns. Let go of both axes\? \[y/N\]: ")
        asking.press(f"{key}\r")
        assert asking.ends() == code
        assert told in asking.rest
    assert console.heard == ["let-go"]
    assert why(rotator("let-go", "--config", config)) == "rotator: nothing was done (--yes does it without asking)\n"


def test_what_was_confirmed_is_what_the_box_then_reads(scripted: Any, rotator_here: Rotator, config: Path) -> None:
    console = scripted(counted(20), counted(20), counted(123.4))
    assert said(rotator_here("confirm", "azimuth", "123,4", "--config", config)) == (
        "Taken: azimuth 123.4° counted. Before: azimuth 20.0° counted.\n"
    )
    assert console.heard == ["confirm azimuth 123.4"]


def test_a_confirmation_without_effect_is_no_success(scripted: Any, rotator_here: Rotator, config: Path) -> None:
    scripted(counted(20))
    done = rotator_here("confirm", "azimuth", "300", "--config", config)
    assert why(done) == "rotator: 300° had no effect: azimuth 20.0° counted\n"


def test_a_sensor_that_knows_the_angle_within_a_turn_keeps_its_own(
    scripted: Any, rotator_here: Rotator, config: Path
) -> None:
    scripted(counted(0), counted(0), counted(36))
    assert said(rotator_here("confirm", "azimuth", "20", "--config", config)) == (
        "Taken: azimuth 36.0° counted, the nearest to 20° that fits its sensor. Before: azimuth 0.0° counted.\n"
    )


def test_an_angle_that_was_not_known_is_known_now(scripted: Any, rotator_here: Rotator, config: Path) -> None:
    """A moteus after power-on: the person sees 38°, and the encoder knows it better."""
    lost, found = pointed(AxisStatus(0.0, 450.0, None)), pointed(AxisStatus(0.0, 450.0, 34.7))
    scripted(lost, lost, found)
    assert said(rotator_here("confirm", "azimuth", "38", "--config", config)) == (
        "Taken: azimuth 34.7° measured, the nearest to 38° that fits its sensor. Before: azimuth not known.\n"
    )


def test_homing_ends_when_the_axis_stands(scripted: Any, rotator_here: Rotator, config: Path) -> None:
    # Between its turns it stands for a moment.
    turns = [counted(angle_deg, turns=True) for angle_deg in (20, 10)]
    console = scripted(counted(25), *turns, *[counted(0)] * 4, counted(5, turns=True), counted(0))
    assert said(rotator_here("home", "azimuth", "--yes", "--config", config)) == "azimuth 0.0° counted: homed.\n"
    assert console.heard == ["home azimuth"]


def test_an_axis_that_was_not_homed(scripted: Any, rotator_here: Rotator, config: Path) -> None:
    fault = Fault(FaultKind.NOT_HOMED, Axis.AZIMUTH, "no pulse came in either direction")
    scripted(counted(25), counted(20, turns=True), counted(20, fault=fault, missing=(Missing.HOMING,)))
    done = rotator_here("home", "azimuth", "--yes", "--config", config)
    assert why(done, 3) == f"rotator: {fault}\n"


def test_an_axis_that_still_needs_homing(scripted: Any, rotator_here: Rotator, config: Path) -> None:
    scripted(counted(25), counted(20, turns=True), counted(20, missing=(Missing.HOMING,)))
    done = rotator_here("home", "azimuth", "--yes", "--config", config)
    assert why(done) == "rotator: azimuth is not homed: it needs homing\n"


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


def test_a_resume_in_a_storm_park_says_that_it_goes_on(scripted: Any, rotator_here: Rotator, config: Path) -> None:
    moving = AxisStatus(0.0, 450.0, 120.0, target_deg=0.0, tolerance_deg=4.0, moving=True)
    scripted(pointed(moving, latched="console#3", storm=True), pointed(moving))
    assert said(rotator_here("resume", "--config", config)) == (
        "The antenna may move again.\nIt still goes to its park position; `rotator stop` ends that.\n"
    )


def test_both_axes_with_a_fault(scripted: Any, rotator_here: Rotator, config: Path) -> None:
    faults = [Fault(FaultKind.POT_OPEN, axis, "reads 0.000", "0.02 to 0.98") for axis in Axis]
    azimuth, elevation = (AxisStatus(0.0, 180.0, 10.0, fault=fault, seen=False) for fault in faults)
    scripted(Status(0.0, azimuth, elevation))
    done = rotator_here("where", "--json", "--config", config)
    assert done.returncode == 3
    told = json.loads(done.stdout)
    assert [told[axis.value]["fault"]["text"] for axis in Axis] == [str(fault) for fault in faults]
    assert [told[axis.value]["angle_is_current"] for axis in Axis] == [False, False]


def test_a_fault_whose_cause_is_still_there_is_not_called_mended(
    scripted: Any, rotator_here: Rotator, config: Path
) -> None:
    fault = Fault(FaultKind.POT_OPEN, Axis.AZIMUTH, "reads 0.000", "0.02 to 0.98")
    scripted(pointed(AxisStatus(0.0, 450.0, 120.0, fault=fault)))
    done = rotator_here("resume", "--config", config)
    assert why(done, 3) == f"rotator: the cause is still there:\n         {fault}\n"


@pytest.mark.parametrize("answers", range(5))
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
