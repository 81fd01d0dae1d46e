"""Nothing is wrong, and nothing is reported: motors slow and fast, as configured or not, with noise on the pots."""

from __future__ import annotations

import pytest

from tests.scenario.false_alarms import reported_in_flight, reported_in_moves


@pytest.mark.parametrize(
    ("motor", "noise_deg"),
    [
        ((6, 6, 0.0), 0.1),
        ((6, 6, 0.15), 0.4),
        ((6, 6, 0.3), 0.4),
        ((6, 3, 0.15), 0.4),
        ((6, 12, 0.15), 0.1),
        ((0.5, 0.5, 0.15), 0.4),
        ((60, 60, 0.15), 0.4),
    ],
    ids=str,
)
def test_moves_jogs_and_reversals(motor: tuple[float, float, float], noise_deg: float) -> None:
    assert reported_in_moves(*motor, noise_deg) == set()


@pytest.mark.parametrize("name", ["north-2-so-50", "overhead-2-rs-44"])
def test_passes_with_four_times_the_noise(name: str) -> None:
    assert reported_in_flight(name) == set()
