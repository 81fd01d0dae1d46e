"""One real pass, or the beginning of one, on every kind of rotor: the twelve on each are `make test-flights`."""

from __future__ import annotations

import pytest

from benchmarks.kinds import KINDS, PASSES, Kind, swings
from rotator.passes import Pass, read_pass
from rotator.rehearsal import fly, plant_maker

BY_NAME = {kind.name: kind for kind in KINDS}
MOST_RMS_DEG = {"simulated": 3.0, "u100": 4.0, "isel": 0.25, "servos": 3.0, "orbit360": 3.0}
HUNDREDTHS_DEG = 0.05
BEGINNING_S = 200.0
"""Of the moteus, whose two controllers are talked to fifty times a second, a part is enough here."""


def part_of(flown: Pass, end_s: float) -> Pass:
    return Pass(flown.name, tuple(row for row in flown.rows if row[0] <= end_s))


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.name)
def test_a_pass_is_followed(kind: Kind) -> None:
    flown = read_pass(PASSES / "low-2-so-50.csv")
    if kind.profile == "isel":
        flown = part_of(flown, BEGINNING_S)
    trace, summary = fly(flown, plant_maker(kind.config(), via=kind.via))
    most_deg = HUNDREDTHS_DEG if kind.via == "rotctld" else MOST_RMS_DEG[kind.profile]
    assert summary.rms_deg <= most_deg
    assert summary.p95_deg <= 4.0
    assert (summary.relay_starts is None) is not kind.config().rotor.switched
    assert summary.motor_s > 0
    assert swings(trace) <= 1
