"""A table that names its turn, or goes over the top, is flown literally; what the rotor cannot do is refused before."""

from __future__ import annotations

import random
from itertools import pairwise

import pytest

from rotator.protocols.table_text import read_table
from tests.search import examples
from tests.tracking.tracked_box import FEBRUARY_S, Box

MAST = '[[mount.forbidden]]\nname = "mast"\nazimuth_deg = [400, 410]\nelevation_deg = [0, 60]\n'


def handed_in(box: Box, rows: list[tuple[float, float, float]]) -> None:
    text = "t,az,el\n" + "".join(f"{at_s:.1f},{az_deg:.2f},{el_deg:.2f}\n" for at_s, az_deg, el_deg in rows)
    assert box.tracker.program(read_table(text, "turns", "turns.csv", turns=True)) == ""


def angles_deg(box: Box) -> tuple[float, float]:
    azimuth_deg, elevation_deg = box.loop.status.azimuth.angle_deg, box.loop.status.elevation.angle_deg
    assert azimuth_deg is not None
    assert elevation_deg is not None
    return azimuth_deg, elevation_deg


@pytest.mark.search
def test_each_axis_goes_where_the_table_says() -> None:
    dice = random.Random(5)
    for _ in range(examples(8)):
        box = Box(FEBRUARY_S)
        azimuth_deg, elevation_deg = dice.uniform(200.0, 440.0), dice.uniform(0.0, 170.0)
        rows = [(90.0, azimuth_deg, elevation_deg)]
        for step in range(1, 5):
            azimuth_deg = min(450.0, max(0.0, azimuth_deg + dice.uniform(-30.0, 30.0)))
            elevation_deg = min(180.0, max(0.0, elevation_deg + dice.uniform(-15.0, 15.0)))
            rows.append((90.0 + 30.0 * step, azimuth_deg, elevation_deg))
        rows.append((rows[-1][0] + 60.0, 440.0 if azimuth_deg > 300.0 else azimuth_deg, max(91.0, elevation_deg)))
        if max(abs(a[1] - b[1]) + abs(a[2] - b[2]) for a, b in pairwise(rows)) > 44.0:
            continue
        handed_in(box, rows)
        for before, row in zip([(0.0, 0.0, 0.0), *rows], rows, strict=False):
            box.wait(row[0] - before[0])
            assert box.tracker.state in ("tracking", "ended: turns is over")
            azimuth_deg, elevation_deg = angles_deg(box)
            assert abs(azimuth_deg - row[1]) < 8.0, "its tolerance is 4 degrees, and never another turn"
            assert abs(elevation_deg - row[2]) < 8.0


@pytest.mark.parametrize(
    ("rows", "said"),
    [
        ([(30.0, 430.0, 10.0), (60.0, 460.0, 20.0)], "outside the rotor's azimuth range of 0° to 450°, on the turn"),
        ([(30.0, 390.0, 10.0), (60.0, 420.0, 20.0)], "line 2: azimuth 39"),
        ([(30.0, -20.0, 100.0), (60.0, 10.0, 95.0)], "outside the rotor's azimuth range of 0° to 450°, on the turn"),
    ],
)
def test_what_the_rotor_cannot_do_is_refused_before_anything_turns(
    rows: list[tuple[float, float, float]], said: str
) -> None:
    box = Box(FEBRUARY_S, follow=MAST)
    handed_in(box, rows)
    box.wait(3.0)
    assert box.tracker.state.startswith("ended: turns, line 2")
    assert said in box.tracker.state
    assert not box.loop.status.moving


def test_elevation_beyond_the_range_is_refused() -> None:
    box = Box(FEBRUARY_S, follow="[elevation]\nmax_deg = 90\n")
    handed_in(box, [(30.0, 100.0, 80.0), (60.0, 100.0, 100.0)])
    box.wait(3.0)
    assert "above the rotor's elevation range, which ends at 90°" in box.tracker.state
