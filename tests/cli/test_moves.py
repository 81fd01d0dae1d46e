"""`rotator point`, `park` and `jog`: when they are done, what they say then, and what ends them before."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

from hw.ports import Axis
from rotator.exchange.faults import Fault, FaultKind, Missing
from rotator.exchange.status import AxisStatus, Status
from tests.cli.scripted import COMMAND, Rotator, StartInTerminal, counted, pointed, said, why


def test_the_help_says_what_becomes_of_the_order_when_the_terminal_closes(rotator_here: Rotator) -> None:
    told = " ".join(said(rotator_here("point", "-h")).split())
    assert "a terminal that closes does not: it goes on to its place" in told


@pytest.mark.parametrize("order", [["home", "azimuth", "--yes"], ["point", 0, 0], ["park"], ["jog", "ccw", 3]])
def test_an_order_that_shows_late_is_not_another_command(
    scripted: Any, rotator_here: Rotator, config: Path, order: list[Any]
) -> None:
    """A box on a busy computer: the first look after the order still shows the command before."""
    earlier = counted(0, by="console#7")
    scripted(earlier, earlier, counted(0, turns=True), counted(0))
    said(rotator_here(*order, "--config", config))


@pytest.mark.parametrize("who_told", [("gs232b#1", "gs232b moves the antenna now"), ("", "the antenna was stopped")])
@pytest.mark.parametrize("order", [["home", "azimuth", "--yes"], ["point", 0, 0], ["park"], ["jog", "ccw", 3]])
def test_somebody_else_takes_or_stops_it(
    scripted: Any, rotator_here: Rotator, config: Path, who_told: tuple[str, str], order: list[Any]
) -> None:
    who, told = who_told
    console = scripted(counted(25), counted(20, turns=True), counted(15, turns=True), counted(10, turns=True, by=who))
    done = rotator_here(*order, "--config", config)
    assert why(done).endswith(f" was ended: {told}\n")
    assert len(console.heard) == 1, "the antenna is not this command's to stop any more"


@pytest.mark.parametrize("order", ["point 0 0", "park", "jog ccw 3"])
def test_ctrl_c_stops_what_turns(scripted: Any, start_in_terminal: StartInTerminal, config: Path, order: str) -> None:
    console = scripted(counted(123), counted(123, turns=True))
    moving = start_in_terminal(*order.split(), "--config", config)
    moving.until("azimuth 123")
    moving.press("\x03")
    assert moving.ends() == 1
    assert console.heard[1:] == ["stop"]
    assert re.search(r"rotator: Ctrl-C\. Stopped\. Nothing moves until `rotator resume`\.\r\n$", moving.rest)


def on_its_way(angle_deg: float, *, moving: bool = True) -> Status:
    return pointed(AxisStatus(0.0, 450.0, angle_deg, target_deg=180.0, tolerance_deg=4.0, moving=moving))


def test_pointing_ends_when_the_antenna_is_there(scripted: Any, rotator_here: Rotator, config: Path) -> None:
    rests = on_its_way(120, moving=False)  # a relay waits, and the motor with it
    console = scripted(on_its_way(100), *[rests] * 9, on_its_way(150), on_its_way(178.2, moving=False))
    assert said(rotator_here("point", "180", "45", "--config", config)) == (
        "Arrived: azimuth 178.2° measured, elevation 45.0° measured.\n"
    )
    assert console.heard == ["point 180 45"]


def test_an_antenna_above_the_trees_is_told_so(scripted: Any, rotator_here: Rotator, config: Path) -> None:
    azimuth, elevation = AxisStatus(0.0, 450.0, 180.0), AxisStatus(0.0, 180.0, 14.7, target_deg=15.0, tolerance_deg=4.0)
    scripted(Status(0.0, azimuth, elevation, controlled_by=COMMAND))
    assert said(rotator_here("point", "180", "3", "--config", config)).splitlines()[1] == (
        "It points no lower than 15.0° there: its range, [mount] horizon, or a forbidden sector."
    )


def test_a_fault_on_the_way_is_named(scripted: Any, rotator_here: Rotator, config: Path) -> None:
    fault = Fault(FaultKind.POT_OPEN, Axis.AZIMUTH, "reads 0.000", "0.02 to 0.98")
    scripted(on_its_way(100), pointed(AxisStatus(0.0, 450.0, 120.0, fault=fault, seen=False)))
    done = rotator_here("point", "180", "45", "--config", config)
    assert done.stdout == "azimuth 120.0° when last seen, no reading now, elevation 45.0° measured.\n"
    assert why(done, 3) == f"rotator: {fault}\n"


def test_an_axis_that_may_not_be_aimed_has_not_arrived(scripted: Any, rotator_here: Rotator, config: Path) -> None:
    scripted(pointed(AxisStatus(0.0, 450.0, 120.0, missing=(Missing.CALIBRATION, Missing.LIMITS))))
    done = rotator_here("point", "180", "45", "--config", config)
    assert why(done) == "rotator: azimuth did not move: it needs calibration, limits\n"


def test_a_stop_on_the_way_ends_it(scripted: Any, rotator_here: Rotator, config: Path) -> None:
    scripted(on_its_way(100), pointed(AxisStatus(0.0, 450.0, 120.0), by="", latched="panel"))
    done = rotator_here("point", "180", "45", "--config", config)
    assert why(done) == "rotator: point was ended: stopped by the panel; nothing moves until `rotator resume`\n"


def test_the_storm_park_is_no_stop(scripted: Any, rotator_here: Rotator, config: Path) -> None:
    there = pointed(AxisStatus(0.0, 450.0, 0.0), latched="console#1", storm=True)
    scripted(on_its_way(100), there)
    assert said(rotator_here("park", "--config", config)).startswith("Arrived: azimuth 0.0° measured")


def test_a_jog_says_how_far_it_went(scripted: Any, rotator_here: Rotator, config: Path) -> None:
    console = scripted(counted(20), counted(30, turns=True), counted(32.5))
    assert said(rotator_here("jog", "cw", "1,5", "--config", config)) == "azimuth 32.5° counted: +12.5° from before.\n"
    assert console.heard == ["jog cw 1.5"]


def test_a_jog_that_waits_for_its_relay_is_waited_for(scripted: Any, rotator_here: Rotator, config: Path) -> None:
    """The box watches a counted axis stand before it closes the first relay."""
    scripted(counted(20), *[counted(20)] * 10, counted(30, turns=True), counted(32.5))
    assert said(rotator_here("jog", "cw", "1.5", "--config", config)) == "azimuth 32.5° counted: +12.5° from before.\n"


@pytest.mark.parametrize("order", [["point", 180, 45], ["park"], ["jog", "up", 1]])
def test_without_waiting(scripted: Any, rotator_here: Rotator, config: Path, order: list[Any]) -> None:
    console = scripted(on_its_way(100))
    assert said(rotator_here(*order, "--no-wait", "--config", config)).startswith("The box has the order.")
    assert len(console.heard) == 1
