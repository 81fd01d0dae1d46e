"""Whatever moves the antenna ends before a forbidden sector, by its name; without the sector each would enter it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest

from benchmarks.drills.box import Box
from benchmarks.drills.boxes import PANEL as PARTS
from benchmarks.drills.card import Card
from benchmarks.drills.configured import configured
from benchmarks.drills.script import PAGE, PANEL, Drill, Event
from benchmarks.drills.speech import said
from firmware_sim.clock import SimClock

CHIMNEY = {"name": "the chimney", "azimuth_deg": [120.0, 150.0], "elevation_deg": [0.0, 45.0]}
BEHIND = {"name": "the mast", "azimuth_deg": [300.0, 330.0], "elevation_deg": [100.0, 150.0]}
STEP_S = 0.05


@dataclass(frozen=True)
class Mover:
    """What moves it, from azimuth 90 and elevation 30 unless told."""

    events: tuple[tuple[Any, ...], ...]
    seconds: float = 40.0
    kind: tuple[str, str] = ("relay-pot", "g5500")
    start_deg: tuple[float, float] = (90.0, 30.0)
    tables: dict[str, Any] = field(default_factory=dict)
    sector: dict[str, Any] = field(default_factory=lambda: CHIMNEY)


AUTO, FITTED = (0.5, PANEL, "mode", "auto"), {"panel": PARTS}
TABLE = "table 0,90,30;20,110,25;40,135,20;60,160,20"
MOVERS = {
    "aim": Mover(((1.0, "gs232b", "aim", 135.0, 30.0),)),
    "aim beyond": Mover(((1.0, "rotctld", "aim", 200.0, 20.0),), 60.0),
    "jog": Mover(((1.0, "gs232b", "jog", "cw"),)),
    "park": Mover(((1.0, "rotctld", "park"),), 60.0),
    "storm park": Mover(((1.0, "console", "storm"),), 60.0),
    "idle park": Mover(((1.0, "gs232b", "aim", 90.0, 30.0),), 120.0, tables={"mount": {"park_after_s": 60.0}}),
    "home": Mover(
        (
            (0.2, "console", "confirm", "azimuth", 170.0),
            (0.2, "console", "confirm", "elevation", 30.0),
            (3.0, "console", "home", "azimuth"),
        ),
        60.0,
        ("relay-pulse", "u100"),
        (170.0, 30.0),
    ),
    "flip": Mover(
        ((1.0, "console", "track", "arc 20 120 600 315 1 88"),),
        140.0,
        start_deg=(315.0, 10.0),
        tables={"mount": {"flip": "over-top"}},
        sector=BEHIND,
    ),
    "panel knob": Mover((AUTO, (3.0, PANEL, "mode", "manual"), (6.0, PANEL, "knob", "azimuth", 0.3)), tables=FITTED),
    "held page button": Mover(tuple((1.0 + 0.1 * turn, PAGE, "hold", "cw") for turn in range(300))),
    "calibration jogs": Mover(tuple((1.0 + 2.5 * turn, "console", "jog", "cw", 2.0) for turn in range(12))),
    "nudge": Mover(
        (
            AUTO,
            (3.0, "gs232b", "aim", 110.0, 30.0),
            *((12.0 + 2.0 * turn, PANEL, "jog", "cw", 0.5) for turn in range(8)),
        ),
        tables={"panel": PARTS | {"azimuth_nudge_deg": 5.0}},
    ),
    "mode JOG": Mover((AUTO, (3.0, PANEL, "mode", "jog"), (6.0, PANEL, "jog", "cw", 30.0)), 40.0, tables=FITTED),
    "planned pass": Mover(((1.0, "console", "track", "arc 5 120 600 90 1 20"),), 100.0),
    "program file": Mover(((1.0, "console", "track", TABLE),), 80.0),
}


def booms(mover: Mover, folder: Path, *, fenced: bool) -> Iterator[tuple[float, float]]:
    """Where the boom is at each cycle."""
    mount = {**mover.tables.get("mount", {}), **({"forbidden": [mover.sector]} if fenced else {})}
    kind, profile = mover.kind
    drill = Drill(kind, profile, mover.seconds, mover.start_deg, mover.tables | {"mount": mount}, seed="sector")
    clock = SimClock(1000.0)
    begun_s = clock()
    card = Card(folder, folder.with_name("memory"))
    box = Box(drill, configured(drill, folder), card, clock, None, begun_s=begun_s)
    events = [Event(each[0], each[1], each[2], tuple(each[3:])) for each in mover.events]
    for cycle in range(round(mover.seconds / STEP_S)):
        clock.sleep_until(begun_s + cycle * STEP_S)
        while events and events[0].at_s <= cycle * STEP_S:
            event = events.pop(0)
            if event.who == PANEL:
                box.hand([str(word) for word in (event.what, *event.args)])
            else:
                box.hear(event.who, said(event))
        box.events.tick()
        box.tracking.turn()
        box.cycle()
        yield box.world.antenna()
    box.end()


def enters(mover: Mover, folder: Path, *, fenced: bool) -> bool:
    (west, east), (low, high) = mover.sector["azimuth_deg"], mover.sector["elevation_deg"]
    folder.mkdir()
    inside = [
        west < azimuth < east and low < elevation < high for azimuth, elevation in booms(mover, folder, fenced=fenced)
    ]
    return any(inside)


@pytest.mark.parametrize("name", list(MOVERS))
def test_it_ends_before_a_forbidden_sector(name: str, tmp_path: Path) -> None:
    assert enters(MOVERS[name], tmp_path / "free", fenced=False), "it would go there"
    assert not enters(MOVERS[name], tmp_path / "fenced", fenced=True)
