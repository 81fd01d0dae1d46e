"""What the box reports while nothing is wrong: moves, jogs, reversals and passes with noise on the pots.

Each function returns the names of all faults and the texts of all notices that it has seen. There should be none.
"""

from __future__ import annotations

from benchmarks.faults import Mast
from firmware_sim.clock import SimClock
from hw.ports import Axis, Direction
from rotator.config.load import parse
from rotator.exchange.orders import Aim, Jog
from rotator.rehearsal.flight import fly
from rotator.rehearsal.passes import SHIPPED, Pass, read_pass
from rotator.rehearsal.plants import BoxPlant

NOISY = "[sim.azimuth]\npot_noise_deg = 0.4\n[sim.elevation]\npot_noise_deg = 0.4\n"
FARTHEST_DEG, NEAR_DEG = 450.0, 70.0


def reported_in_moves(said_dps: float, real_dps: float, lag_s: float, noise_deg: float) -> set[str]:
    """Both axes to six places, and jogs to and fro, with motors that turn at `real_dps` and are said to at another."""
    axis = f"speed_dps = {said_dps}\nlongest_run_s = 0\n"
    sim = f"speed_dps = {real_dps}\nlag_s = {lag_s}\npot_noise_deg = {noise_deg}\n"
    mast = Mast(f"[azimuth]\n{axis}[elevation]\n{axis}[sim.azimuth]\n{sim}[sim.elevation]\n{sim}")
    seen = _reported(mast, 1.0)
    for azimuth_deg, elevation_deg in ((60, 30), (20, 10), (90, 60), (45, 45), (450, 180), (0, 0)):
        mast.order(Aim(azimuth_deg, elevation_deg))
        seen |= _reported(mast, (FARTHEST_DEG if azimuth_deg % 450 == 0 else NEAR_DEG) / real_dps + 5.0)
    reversals = [(way, 1.5) for way in (Direction.PLUS, Direction.MINUS) * 2]
    ends = [(way, min(460.0 / real_dps + 5.0, 200.0)) for way in (Direction.PLUS, Direction.MINUS)]
    for way, seconds in (*reversals, *ends):
        for each in Axis:
            mast.order(Jog(each, way))
        seen |= _reported(mast, seconds)
    mast.close()
    return seen


def reported_in_flight(name: str) -> set[str]:
    """A real pass with four times the usual noise."""
    config = parse(NOISY, "a noisy station")
    seen: set[str] = set()

    def make(clock: SimClock, flown: Pass) -> BoxPlant:
        plant = BoxPlant(config, clock, (flown.rows[0][1], 0.0), "gs232")

        def look(_now_s: float) -> None:
            seen.update(notice.text for axis in Axis for notice in plant.status.axis(axis).notices)
            seen.update(fault.name for fault in plant.status.faults)

        clock.every(1.0, look)
        return plant

    fly(read_pass(SHIPPED / f"{name}.csv"), make)
    return seen


def _reported(mast: Mast, seconds: float) -> set[str]:
    seen: set[str] = set()
    for _ in range(round(seconds / 0.5)):
        mast.run(0.5)
        seen |= {notice.text for axis in Axis for notice in mast.status.axis(axis).notices}
        seen |= {fault.name for fault in mast.status.faults}
    return seen
