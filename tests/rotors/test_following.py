"""Behind another rotor: the box follows a rotctld whose dummy turns in ramps with corners, as Hamlib's does.

Judged by where the simulated boom really points, against where the dummy has been.
"""

from __future__ import annotations

import random
from collections import deque
from collections.abc import Iterator

import pytest

from rotator.protocols.rotctld_follow import RotctldFollower
from tests.rotors.rig import AZ, EL, KINDS, STARTED_S, Box, Kind, all_but

DUMMY_DPS = 6.0
POLL_S = 0.1
LATELY_S = 3.0
BEYOND_DEG = {
    "g5500": 1.5,
    "ham4": 2.0,
    "g1000": 1.5,
    "u100": 8.0,
    "isel": 0.2,
    "servos": 1.0,
    "orbit360": 4.0,
    "slew-drive": 0.5,
    "controller": 4.0,
    "tv-rotator": 8.0,
    "satnogs": 0.2,
}
"""How far each kind may go past a corner: its coast and the play of its gears; a counted axis stops at an edge."""
ISEL = next(kind for kind in KINDS if kind.profile == "isel")


class Dummy:
    """Hamlib's dummy rotor: each axis goes to its target at 6°/s, stops at once, and tells two decimals."""

    def __init__(self, azimuth_deg: float, elevation_deg: float) -> None:
        self.at_deg = [azimuth_deg, elevation_deg]
        self.to_deg = [azimuth_deg, elevation_deg]

    def run(self, seconds: float) -> None:
        for axis in range(2):
            gap_deg = self.to_deg[axis] - self.at_deg[axis]
            self.at_deg[axis] += max(-DUMMY_DPS * seconds, min(DUMMY_DPS * seconds, gap_deg))

    def stop(self) -> None:
        self.to_deg = list(self.at_deg)

    def answer(self) -> bytes:
        return b"%.2f\n%.2f\n" % (self.at_deg[0], self.at_deg[1])


class Bench:
    def __init__(self, kind: Kind) -> None:
        self.box = Box(kind)
        self.dummy = Dummy(*kind.start_deg)
        self.follower = RotctldFollower(self.box.client(), POLL_S)
        self.seen: deque[tuple[tuple[float, ...], tuple[float, float]]] = deque(maxlen=round(LATELY_S / POLL_S))
        self.beyond_deg = 0.0
        self.follow(1.0)

    def follow(self, seconds: float) -> None:
        for _ in range(round(seconds / POLL_S)):
            self.follower.ask()
            self.follower.receive(self.dummy.answer())
            self.box.run(POLL_S)
            self.dummy.run(POLL_S)
            booms_deg = self.box.boom_deg(AZ), self.box.boom_deg(EL)
            self.seen.append((tuple(self.dummy.at_deg), booms_deg))
            for axis in range(2):
                # Where the dummy has been of late, and the way from where the boom was.
                way_deg = [self.seen[0][1][axis], *(at_deg[axis] for at_deg, _ in self.seen)]
                off_deg = max(min(way_deg) - booms_deg[axis], booms_deg[axis] - max(way_deg))
                self.beyond_deg = max(self.beyond_deg, off_deg)

    def close(self) -> None:
        self.box.close()


@pytest.fixture
def bench(request: pytest.FixtureRequest) -> Iterator[Bench]:
    bench = Bench(request.param)
    yield bench
    bench.close()


def orders(dummy: Dummy, chance: random.Random, most_deg: float = 350.0) -> Iterator[float]:
    """Steps, slews, stops and the zenith, and the seconds until the next."""
    while True:
        match chance.choice(["step", "slew", "stop", "zenith", "rest"]):
            case "step":
                dummy.to_deg = [dummy.at_deg[0] + chance.uniform(-2, 2), dummy.at_deg[1] + chance.uniform(-2, 2)]
            case "slew":
                dummy.to_deg = [chance.uniform(5, most_deg), chance.uniform(2, 85)]
            case "zenith":
                dummy.to_deg = [chance.uniform(5, most_deg), 89.5]
            case "stop":
                dummy.stop()
            case _:
                yield 40.0
        dummy.to_deg = [min(max(dummy.to_deg[0], 5.0), most_deg), min(max(dummy.to_deg[1], 2.0), 89.5)]
        yield chance.choice([0.3, 1.0, 3.0, 10.0])


@all_but()
def test_slews_steps_and_stops_are_followed_and_no_corner_is_passed(kind: Kind) -> None:
    bench = Bench(kind)
    try:
        # Servos go over the top beyond 180°.
        seconds = orders(bench.dummy, random.Random(kind.profile), 175.0 if kind.profile == "servos" else 350.0)
        while bench.box.clock() < STARTED_S + 120.0:
            bench.follow(next(seconds))
            assert not bench.box.status.faults
            assert bench.beyond_deg <= BEYOND_DEG[kind.profile], bench.box.status
    finally:
        bench.close()


@pytest.mark.parametrize("bench", [ISEL], indirect=True)
def test_the_antenna_rests_exactly_where_the_other_rotor_rests(bench: Bench) -> None:
    for place in ([30.0, 20.0], [31.25, 20.4], [31.25, 89.5], [200.0, 2.0]):
        bench.dummy.to_deg = list(place)
        bench.follow(45.0)
        assert (bench.box.boom_deg(AZ), bench.box.boom_deg(EL)) == pytest.approx(place, abs=0.002)
    assert not bench.box.status.faults
    assert bench.beyond_deg <= BEYOND_DEG["isel"]
