"""How well a scan by a receiver's strength finds its target: run `python -m benchmarks.scan [WORLDS]`, 40 by default.

Worlds by chance, the same on every machine: beams of 3° to 40°, mounts that stand up to 5° askew, relays with play in
their gears or moteus, signals of 8 to 25 dB that fade by up to 3 dB within 1 to 20 s, targets that stand or move. Each
is scanned in simulated time by the whole box; what it finds is judged by where the simulated boom truly points. Then
worlds in which nothing is to be heard but noise and fading: none may give a point.
"""

from __future__ import annotations

import argparse
import math
import random
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass
from typing import Any

from firmware_sim.clock import SimClock
from firmware_sim.parts.mount import MountSpec
from firmware_sim.parts.receiver import ReceiverSpec, SimReceiver
from rotator.assembly.simulation import simulated_boom
from rotator.assembly.station import Station
from rotator.calibrating.entries import Entry, Word
from rotator.calibrating.sky_rig import SkyRig
from rotator.calibrating.strength import Strength
from rotator.config.model import Config
from rotator.control.sky.angles import great_circle_deg
from rotator.orbits.sight import Sight

PERIOD_S = 0.05
LONGEST_S = 1800.0
WORLDS = 40
NOTHING_DB = -40.0


@dataclass(frozen=True, slots=True)
class World:
    kind: str
    place_deg: tuple[float, float]
    moves_dps: float
    mount: MountSpec
    play_deg: float
    receiver: ReceiverSpec
    seed: int

    def config(self) -> Config:
        play = {"backlash_deg": self.play_deg}
        tables: dict[str, Any] = {
            "rotor": {"type": self.kind},
            "elevation": {"max_deg": 180},
            "station": {"beam_deg": self.receiver.beam_deg},
            "sim": {"mount": asdict(self.mount), "bus_takes_time": False, "azimuth": play, "elevation": play},
        }
        return Config.model_validate(tables)


@dataclass(frozen=True, slots=True)
class Outcome:
    world: World
    off_deg: float | None
    """None: no point was taken."""
    seconds: float
    said: str


def world(seed: int, *, heard: bool) -> World:
    chance = random.Random(seed)
    beam_deg = math.exp(chance.uniform(math.log(3), math.log(40)))
    askew_deg = min(5.0, 0.35 * beam_deg)
    ia_deg, ie_deg = (chance.uniform(-askew_deg, askew_deg) for _ in range(2))
    others = (chance.uniform(-askew_deg / 3, askew_deg / 3) for _ in range(4))
    return World(
        chance.choice(("relay-pot", "relay-pot", "moteus")),
        (chance.uniform(0, 360), chance.uniform(15, 65)),
        chance.choice((0.0, 0.004, 0.05)),
        MountSpec(ia_deg, ie_deg, *others),
        chance.uniform(0, min(2.0, 0.1 * beam_deg)),
        ReceiverSpec(
            beam_deg,
            signal_db=chance.uniform(8, 25) if heard else NOTHING_DB,
            noise_db=chance.uniform(0.3, 1.5),
            fading_db=chance.uniform(0, 3),
            fading_s=chance.uniform(1, 20),
        ),
        seed,
    )


class _Moving:
    name = "the beacon"

    def __init__(self, found: World, clock: Callable[[], float]) -> None:
        self._found, self._clock = found, clock

    def sight(self, _utc_s: float) -> Sight:
        azimuth_deg, elevation_deg = self._found.place_deg
        return Sight((azimuth_deg + self._found.moves_dps * self._clock()) % 360.0, elevation_deg, 1000.0)

    def late_s(self, _utc_s: float) -> float:
        return 0.0


class _Ear:
    """The simulated receiver, without a socket."""

    def __init__(self, receiver: SimReceiver, clock: Callable[[], float]) -> None:
        self._receiver, self._clock = receiver, clock

    def latest(self) -> Strength:
        return Strength(self._clock(), self._receiver.strength_db())

    def start(self) -> None:
        """It always tells."""

    def stop(self) -> None:
        """It needs no end."""


def scan(found: World) -> Outcome:
    clock, config = SimClock(), found.config()
    station = Station(config, clock, clock.sleep, found.place_deg, add_alarm=clock.add_alarm)
    assert station.world is not None, "the configuration is simulated"
    simulated, boom, target = station.world, simulated_boom(config), _Moving(found, clock)

    def off_deg() -> float:
        seen = target.sight(0.0)
        return great_circle_deg(*boom(*simulated.antenna()), seen.azimuth_deg, seen.elevation_deg)

    ear = _Ear(SimReceiver(found.receiver, clock, off_deg, found.seed), clock)
    rig = SkyRig(config, station, clock, target, clock, receiver=ear)
    said: list[str] = []
    answers: list[Entry] = [Word.YES, Word.YES, Word.ENTER]
    while clock() < LONGEST_S:
        clock.sleep(PERIOD_S)
        rig.loop.cycle()
        entry = answers.pop(0) if rig.guide.ready(answers[0]) else None
        if not answers:
            break
        said += rig.step(entry)
    if not rig.guide.points:
        return Outcome(found, None, clock(), said[-1])
    point = rig.guide.points[0]
    there = boom(point.axis_azimuth_deg, point.axis_elevation_deg)
    return Outcome(found, great_circle_deg(*there, point.azimuth_deg, point.elevation_deg), clock(), said[-1])


def _heard(seed: int) -> Outcome:
    return scan(world(seed, heard=True))


def _unheard(seed: int) -> Outcome:
    return scan(world(seed, heard=False))


def main(worlds: int) -> None:
    with ProcessPoolExecutor() as pool:
        heard = list(pool.map(_heard, range(worlds)))
        unheard = list(pool.map(_unheard, range(worlds, worlds + worlds // 2)))
    offs = sorted((each.off_deg or 0.0) / each.world.receiver.beam_deg for each in heard if each.off_deg is not None)
    for each in heard:
        if each.off_deg is None:
            print(f"world {each.world.seed}, beam {each.world.receiver.beam_deg:.1f}°: {each.said}")
    middle, most = offs[len(offs) // 2], offs[min(len(offs) - 1, math.ceil(0.95 * len(offs)) - 1)]
    took_s = sorted(each.seconds for each in heard)[len(heard) // 2]
    print(
        f"{len(offs)} of {worlds} found: off by {middle:.3f} beams (median), {most:.3f} (95 %), {offs[-1]:.3f} (worst)"
    )
    print(f"a scan takes {took_s:.0f} s (median)")
    print(f"nothing to be heard: {sum(each.off_deg is not None for each in unheard)} of {len(unheard)} gave a point")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("worlds", type=int, nargs="?", default=WORLDS)
    main(parser.parse_args().worlds)
