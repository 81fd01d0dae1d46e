"""`rotator point`, `park` and `jog`: when they are done, what they say then, and what ends them before."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

from rotator.exchange.status import AxisStatus, Status
from tests.cli.scripted import Rotator, StartInTerminal, counted, pointed, said, why


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


@pytest.mark.parametrize(("term", "rows"), [("xterm", 1), ("dumb", 0)])
def test_its_one_row_fits_into_a_narrow_terminal(
    scripted: Any, start_in_terminal: StartInTerminal, config: Path, term: str, rows: int
) -> None:
    scripted(on_its_way(100), on_its_way(150), on_its_way(178.2, moving=False))
    moving = start_in_terminal("point", 180, 45, "--config", config, term=term, columns=30)
    way = moving.until("Arrived").removesuffix("Arrived").split("\r\x1b[K")
    assert max(map(len, way)) == 30 * rows, way


@pytest.mark.parametrize("order", [["point", 180, 45], ["park"], ["jog", "up", 1]])
def test_without_waiting(scripted: Any, rotator_here: Rotator, config: Path, order: list[Any]) -> None:
    console = scripted(on_its_way(100))
    assert said(rotator_here(*order, "--no-wait", "--config", config)).startswith("The box has the order.")
    assert len(console.heard) == 1
