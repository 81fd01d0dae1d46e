"""Power cuts in a pass of the shipped U-100: run `python -m benchmarks.cuts [PASSES [SEED]]`.

Passes drawn at random, sent as whole degrees each second. At a hundred random moments of each the power goes: what the
file of the counts then says decides whether a person has to home the box. Prints how many moments need one, whether any
count on the file was wrong, and what eight hours of such passes on each day write to the card in a year.
"""

from __future__ import annotations

import random
import tempfile
import tomllib
from itertools import islice
from pathlib import Path

import tomlkit

from benchmarks.numbers import numbers
from benchmarks.zenith import drawn
from firmware_sim.clock import SimClock
from hw.ports import Axis
from rotator.assembly.settings import build_controller
from rotator.assembly.station import Station
from rotator.config.load import parse, shipped
from rotator.config.model import Config
from rotator.exchange.orders import Aim
from rotator.exchange.sources import Source
from rotator.rehearsal.passes import Pass
from rotator.runtime.loop import ControlLoop
from rotator.store import counts
from rotator.store.counts import CountsFile, Standing
from rotator.store.whole import BLOCK

PASSES, CUTS = 6, 100
HOURS_A_DAY, LEAST_DEG = 8.0, 10.0
SPACING_DEG = 5.0
"""A count that is further off than this would be an index off."""


def configured(folder: Path) -> Config:
    values = tomllib.loads(shipped("u100"))
    values.pop("panel", None)
    values["rotor"]["hardware"] = "sim"
    values["state"] = {"path": str(folder / "state.json")}
    values["sim"] = {"world": str(folder / "world"), "bus_takes_time": False}
    for axis in Axis:
        values[axis.value]["direction_checked"] = True
    return parse(tomlkit.dumps(values), "u100")


def flown(each: Pass, folder: Path, dice: random.Random) -> tuple[int, int, int]:
    """The moments of a cut that need a person, those at which the file is wrong, and the writes."""
    config = configured(folder)
    path = folder / counts.FILE_NAME
    path.unlink(missing_ok=True)
    start_deg = {Axis.AZIMUTH: each.rows[0][1], Axis.ELEVATION: 2.0}
    file = CountsFile(path, config.kind.cams(tuple(Axis)))
    for axis, angle_deg in start_deg.items():
        file.home(axis, angle_deg)
    clock = SimClock(1000.0)
    places = start_deg[Axis.AZIMUTH], start_deg[Axis.ELEVATION]
    station = Station(config, clock, clock.sleep, places, add_alarm=clock.add_alarm, counts=path)
    assert station.world is not None
    period_s = 1 / config.control.rate_hz
    loop = ControlLoop(build_controller(config), station.rotor, clock, period_s)
    cycles = round(each.end_s / period_s)
    cuts = set(dice.sample(range(cycles), CUTS))
    lost = wrong = writes = 0
    before = path.stat().st_mtime_ns
    for cycle in range(cycles):
        if cycle % round(1 / period_s) == 0:
            azimuth_deg, elevation_deg = each.at(cycle * period_s)
            loop.post(Source("gs232b", 1), Aim(round(azimuth_deg) % 360, max(0, round(elevation_deg))))
        clock.sleep(period_s)
        loop.cycle()
        now = path.stat().st_mtime_ns
        writes, before = writes + (now != before), now
        if cycle in cuts:
            kept = CountsFile(path, config.kind.cams(tuple(Axis))).load()
            lost += any(place.standing is not Standing.KNOWN for place in kept.values())
            rests = dict(zip(Axis, station.world.rests(), strict=True))
            known = [axis for axis in Axis if kept[axis].standing is Standing.KNOWN]
            wrong += any(abs(kept[axis].angle_deg - rests[axis]) >= SPACING_DEG / 2 for axis in known)
    station.close()
    return lost, wrong, writes


def main(count: int, seed: int) -> None:
    dice = random.Random(seed)
    lost = wrong = writes = 0
    seconds = 0.0
    with tempfile.TemporaryDirectory() as folder:
        for each in islice(drawn(random.Random(seed), LEAST_DEG), count):
            found = flown(each, Path(folder), dice)
            lost, wrong, writes = lost + found[0], wrong + found[1], writes + found[2]
            seconds += each.end_s
    per_s = writes / seconds
    year_s = HOURS_A_DAY * 3600 * 365
    print(f"seed {seed}: {count} passes, {seconds / 60:.0f} minutes, {CUTS} cuts in each")
    print(f"a person is needed after {lost / count:.0f} of {CUTS} cuts; a wrong count is believed after {wrong} of all")
    print(
        f"{per_s * 60:.1f} writes a minute; {HOURS_A_DAY:g} hours of passes a day: {per_s * year_s / 1e6:.1f} million "
        f"writes of {BLOCK} bytes, {per_s * year_s * BLOCK / 1e9:.0f} GB a year"
    )


if __name__ == "__main__":
    main(*numbers(__doc__, passes=PASSES, seed=random.SystemRandom().randrange(10**6)))
