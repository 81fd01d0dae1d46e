"""What docs/pointing.md promises of each kind of rotor, on a pass of each sort: low, half high, overhead, across north.

Every figure is the same on every machine. The table of the page has twelve passes: `python -m benchmarks.kinds`.
"""

from __future__ import annotations

import pytest

from benchmarks.kinds import KINDS, Flight, fly_all

PASS_NAMES = ["low-1-iss", "mid-1-iss", "overhead-1-iss", "north-1-iss"]
MOTEUS_W, MOTEUS_P = "moteus (isel), `W` in whole degrees", "moteus (isel), `P %.2f`"
SERVOS, POT = "hobby servos (servos)", "digital pot (orbit360)"
CONTROLLER = "a controller in whole degrees (controller), `P %.2f`"
U100, U100_OVERLAP = "U-100, counting (u100)", "the same with 450° of azimuth"
NOT_NORTH = [name for name in PASS_NAMES if not name.startswith("north")]


@pytest.fixture(scope="session")
def flown() -> dict[tuple[str, str], Flight]:
    return {(flight.kind.name, flight.pass_name): flight for flight in fly_all(KINDS[1:], PASS_NAMES)}


@pytest.mark.parametrize("name", NOT_NORTH)
def test_moteus_from_whole_degrees(flown: dict[tuple[str, str], Flight], name: str) -> None:
    assert flown[MOTEUS_W, name].summary.rms_deg <= 0.25


@pytest.mark.parametrize("name", NOT_NORTH)
def test_moteus_from_hundredths(flown: dict[tuple[str, str], Flight], name: str) -> None:
    assert flown[MOTEUS_P, name].summary.rms_deg <= 0.05


@pytest.mark.parametrize("name", PASS_NAMES)
def test_servos_reach_the_whole_sky(flown: dict[tuple[str, str], Flight], name: str) -> None:
    flight = flown[SERVOS, name]
    assert flight.summary.p95_deg <= 1.5
    assert flight.swings <= 1
    assert flight.away_s <= 4.0


@pytest.mark.parametrize("name", PASS_NAMES)
def test_u100_with_overlap(flown: dict[tuple[str, str], Flight], name: str) -> None:
    assert flown[U100_OVERLAP, name].summary.rms_deg <= 4.0


@pytest.mark.parametrize("name", NOT_NORTH)
def test_u100_without(flown: dict[tuple[str, str], Flight], name: str) -> None:
    assert flown[U100, name].summary.rms_deg <= 4.0


def test_the_relays_of_a_u100_start_seldom(flown: dict[tuple[str, str], Flight]) -> None:
    starts = flown[U100, "mid-1-iss"].summary.relay_starts
    assert starts is not None
    assert 0 < starts < 100


@pytest.mark.parametrize(("kind", "p95_deg"), [(MOTEUS_W, 0.5), (SERVOS, 1.0), (POT, 4.0)])
def test_motors_that_go_to_an_angle_fly_without_relays(
    flown: dict[tuple[str, str], Flight], kind: str, p95_deg: float
) -> None:
    summary = flown[kind, "mid-1-iss"].summary
    assert summary.relay_starts is None
    assert summary.p95_deg < p95_deg


@pytest.mark.parametrize("name", NOT_NORTH)
def test_digital_pot(flown: dict[tuple[str, str], Flight], name: str) -> None:
    assert flown[POT, name].summary.rms_deg <= 3.0


@pytest.mark.parametrize("name", NOT_NORTH)
def test_a_controller_in_whole_degrees(flown: dict[tuple[str, str], Flight], name: str) -> None:
    assert flown[CONTROLLER, name].summary.rms_deg <= 1.0
