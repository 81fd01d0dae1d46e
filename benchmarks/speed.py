"""What a speed output is good for: run `python -m benchmarks.speed`.

The twelve passes, and moves from one standing target to the next, flown in simulated time by the shipped g1000, with
its speed output and without. The antenna is heavier than the file says: its motor takes half a second to lose its
speed. The tolerance is 1°, so that the errors are the motor's. Prints two Markdown tables; every figure is the same on
every machine.
"""

from __future__ import annotations

import argparse
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from multiprocessing import get_context

from benchmarks.kinds import PASS_NAMES
from benchmarks.passes import mean
from rotator.cli.rehearse import simulated
from rotator.config.axes import SpeedTable
from rotator.config.load import parse, shipped
from rotator.config.model import Config
from rotator.rehearsal.flight import Summary, fly, plant_maker
from rotator.rehearsal.passes import SHIPPED, Pass, read_pass

TOLERANCE_DEG, TRUE_LAG_S = 1.0, 0.5
TARGETS_DEG = (90.0, 150.0, 120.0, 135.0, 300.0, 292.0, 200.0)
LASTS_S, ARRIVED_S = 60.0, 50.0
"""Each target is held for so long; after the second time the antenna stands."""


@dataclass(frozen=True, slots=True)
class Move:
    from_deg: float
    to_deg: float
    beyond_deg: float
    """How far the antenna went past its target."""
    off_deg: float
    """How far from it the antenna stands in the end."""


def config(*, speed: bool) -> Config:
    own = simulated(parse(shipped("g1000"), "g1000"))
    azimuth = own.azimuth.model_copy(
        update={"tolerance_deg": TOLERANCE_DEG} | ({} if speed else {"speed": SpeedTable()})
    )
    motor = own.sim.azimuth.model_copy(update={"speed_dps": azimuth.speed_dps, "lag_s": TRUE_LAG_S})
    sim = own.sim.model_copy(update={"azimuth": motor})
    return own.model_copy(update={"azimuth": azimuth, "sim": sim})


def fly_pass(job: tuple[str, bool]) -> Summary:
    name, speed = job
    return fly(read_pass(SHIPPED / f"{name}.csv"), plant_maker(config(speed=speed)))[1]


def moves(speed: bool) -> list[Move]:
    rows = []
    for place, target_deg in enumerate(TARGETS_DEG):
        rows += [(place * LASTS_S, target_deg, 10.0), ((place + 1) * LASTS_S - 0.01, target_deg, 10.0)]
    trace, _ = fly(Pass("moves", tuple(rows)), plant_maker(config(speed=speed), via="rotctld"))
    found = []
    for place in range(1, len(TARGETS_DEG)):
        from_deg, to_deg = TARGETS_DEG[place - 1], TARGETS_DEG[place]
        began_s = place * LASTS_S
        way = 1.0 if to_deg > from_deg else -1.0
        here = [sample for sample in trace if began_s <= sample.t < began_s + LASTS_S - 0.1]
        beyond_deg = max((sample.antenna_az - to_deg) * way for sample in here)
        rest_deg = [sample.antenna_az for sample in here if sample.t >= began_s + ARRIVED_S]
        found.append(Move(from_deg, to_deg, max(0.0, beyond_deg), abs(mean(rest_deg) - to_deg)))
    return found


def markdown() -> str:
    jobs = [(name, speed) for name in PASS_NAMES for speed in (False, True)]
    with ProcessPoolExecutor(mp_context=get_context("spawn")) as pool:
        without, within = pool.map(moves, (False, True))
        flown = dict(zip(jobs, pool.map(fly_pass, jobs), strict=True))
    rows = ["pass | rms without | rms with | worst without | with | starts without | with", "--|--|--|--|--|--|--"]
    for name in PASS_NAMES:
        plain, paced = flown[name, False], flown[name, True]
        rows.append(
            f"{name} | {plain.rms_deg:.2f}° | {paced.rms_deg:.2f}° | {plain.max_deg:.1f}° | {paced.max_deg:.1f}° "
            f"| {plain.relay_starts} | {paced.relay_starts}"
        )
    rms = [mean([flown[name, speed].rms_deg for name in PASS_NAMES]) for speed in (False, True)]
    starts = [mean([float(flown[name, speed].relay_starts or 0) for name in PASS_NAMES]) for speed in (False, True)]
    rows.append(f"all, mean | {rms[0]:.2f}° | {rms[1]:.2f}° | | | {starts[0]:.1f} | {starts[1]:.1f}")
    rows += ["", "move | past it without | with | stands off without | with", "--|--|--|--|--"]
    for plain_move, paced_move in zip(without, within, strict=True):
        rows.append(
            f"{plain_move.from_deg:.0f}° to {plain_move.to_deg:.0f}° | {plain_move.beyond_deg:.2f}° "
            f"| {paced_move.beyond_deg:.2f}° | {plain_move.off_deg:.2f}° | {paced_move.off_deg:.2f}°"
        )
    return "\n".join(rows)


def main() -> None:
    argparse.ArgumentParser(description=__doc__).parse_args()
    print(markdown())


if __name__ == "__main__":
    main()
