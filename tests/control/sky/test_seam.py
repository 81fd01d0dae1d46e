"""A stream that is no known satellite's crosses the end of the azimuth range: there the turn begins.

Neither 20° later, nor before the target is there: it may still turn back, and then nothing turns.
"""

from __future__ import annotations

import random
from dataclasses import dataclass

import pytest

from rotator.assembly.settings import build_mount
from rotator.config.load import parse, shipped
from rotator.control.sky.pointing import Pointing
from rotator.control.sky.route import Speeds
from rotator.exchange.orders import Aim
from tests.search import SEED, some

TURNS_DEG = 90.0
FROM_SEAM_DEG = 1.5
"""Rounding to whole degrees, and half a degree of prediction."""
NOTICED_S = 5.0
"""The way is looked at every 3 s, an order comes each second, and the path is known a second later."""


@dataclass(frozen=True, slots=True)
class Machine:
    """A shipped configuration, the ends of its range on the sky, and whether its tolerance is on the sky."""

    name: str
    seams_deg: tuple[float, ...]
    speeds: Speeds
    on_sky: bool

    def pointing(self) -> Pointing:
        config = parse(shipped(self.name), self.name)
        tolerances_deg = config.azimuth.tolerance_deg, config.elevation.tolerance_deg
        return Pointing(build_mount(config), *tolerances_deg, on_sky=self.on_sky)


MACHINES = (
    Machine("servos", (0.0, 180.0), Speeds(50.0, 50.0), on_sky=True),
    Machine("f1efw", (0.0,), Speeds(6.0, 2.7), on_sky=False),
)


@dataclass(frozen=True, slots=True)
class Stream:
    """Past the seam at `speed_dps`, begun `early_s` before it; `back_deg`: it turns back so far before the seam."""

    seam_deg: float
    speed_dps: float
    elevation_deg: float
    early_s: float
    digits: int
    back_deg: float | None = None

    def past_deg(self, at_s: float) -> float:
        past_deg = abs(self.speed_dps) * (at_s - self.early_s)
        return past_deg if self.back_deg is None else -abs(past_deg + self.back_deg) - self.back_deg

    def azimuth_deg(self, at_s: float) -> float:
        return (self.seam_deg + (self.past_deg(at_s) if self.speed_dps > 0 else -self.past_deg(at_s))) % 360.0


def drawn(dice: random.Random, machine: Machine, *, back: bool) -> Stream:
    return Stream(
        seam_deg=dice.choice(machine.seams_deg),
        speed_dps=dice.choice((-1, 1)) * dice.uniform(0.2, 2.0),
        elevation_deg=dice.uniform(3.0, 60.0),
        early_s=dice.uniform(10.0, 80.0),
        digits=dice.choice((0, 2)),
        back_deg=dice.uniform(1.5, 10.0) if back else None,
    )


def turns_at_s(machine: Machine, stream: Stream) -> list[float]:
    """The moments at which the azimuth is sent to the other end of its range."""
    pointing, had_path = machine.pointing(), False
    found: list[float] = []
    first = Aim(stream.azimuth_deg(0.0), stream.elevation_deg)
    antenna_deg = before_deg = machine.pointing().aim(0.0, first, 90.0, stream.elevation_deg)[0].target_deg
    lasts_s = stream.early_s * 2 if stream.back_deg is not None else stream.early_s + 60.0
    for half in range(int(2 * lasts_s)):
        now_s = half / 2
        goal = None
        if half % 2 == 0:
            aim = Aim(round(stream.azimuth_deg(now_s), stream.digits) % 360.0, round(stream.elevation_deg))
            goal = pointing.aim(now_s, aim, antenna_deg, stream.elevation_deg)[0]
        ahead = pointing.look_ahead(now_s, machine.speeds, had_path=had_path)
        goal = ahead[0] if ahead else goal
        if goal is None:
            continue
        had_path = goal.path is not None
        if abs(goal.target_deg - before_deg) > TURNS_DEG:
            found.append(now_s)
        antenna_deg = before_deg = goal.target_deg
    return found


def check(machine: Machine, seed: str, *, back: bool) -> None:
    stream = drawn(random.Random(seed), machine, back=back)
    told = f"{machine.name} {seed}: {stream}"
    turns = turns_at_s(machine, stream)
    assert len(turns) == (0 if back else 1), told
    reach_deg = FROM_SEAM_DEG + NOTICED_S * abs(stream.speed_dps)
    assert all(-reach_deg <= stream.past_deg(at_s) <= reach_deg for at_s in turns), told


@pytest.mark.long
@pytest.mark.parametrize("back", [False, True])
@pytest.mark.parametrize("machine", MACHINES, ids=lambda machine: machine.name)
def test_the_turn_begins_at_the_seam_and_only_if_the_stream_crosses_it(machine: Machine, back: bool) -> None:
    for number in range(12):
        check(machine, f"44 {number}", back=back)


@pytest.mark.search
@pytest.mark.parametrize("back", [False, True])
@pytest.mark.parametrize("machine", MACHINES, ids=lambda machine: machine.name)
def test_from_a_fresh_seed(machine: Machine, back: bool) -> None:
    for number in some(range(80)):
        check(machine, f"{SEED} {number}", back=back)


@pytest.mark.parametrize("machine", MACHINES, ids=lambda machine: machine.name)
def test_a_stream_as_slow_as_the_moon_turns_once(machine: Machine) -> None:
    assert len(turns_at_s(machine, Stream(machine.seams_deg[-1], 0.02, 30.0, 150.0, 0))) <= 1
