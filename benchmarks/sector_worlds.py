"""A random station beside forbidden sectors, with the real drivers on simulated chips, for `benchmarks.sectors`.

One to three sectors and often a horizon mask; motors at 0.3 to 1.5 of the configured speed; coast, play and noise.
The judge looks at the simulated shaft and boom alone. Does not know the orders that a run consists of.
"""

from __future__ import annotations

import math
import random
import tomllib
from collections import Counter
from dataclasses import dataclass, field

import tomlkit

from firmware_sim.clock import SimClock
from hw.ports import Axis
from rotator.assembly.settings import build_controller, build_mount, planned_motors
from rotator.assembly.station import Station
from rotator.cli.rehearse import simulated
from rotator.config.load import parse, shipped
from rotator.config.model import Config
from rotator.control.sky.angles import great_circle_deg
from rotator.control.sky.detour import Detours
from rotator.control.sky.flight_plan import Antenna, plan_flight
from rotator.control.sky.known_path import KnownPath
from rotator.control.sky.mount import Mount, Range, Sector
from rotator.control.sky.route import Speeds
from rotator.control.sky.sectors import box_at
from rotator.exchange.flight_order import Fly
from rotator.exchange.orders import Aim, Order
from rotator.exchange.sources import Source
from rotator.runtime.loop import ControlLoop

LINK = Source("gs232b", 1)
SLOWEST, FASTEST = 0.3, 1.5
SLOWEST_COUNTED = 0.7
"""A slower motor reaches no place: its contact changes so late that the box takes a pulse for missed."""
CLEAR_DEG = 14.0
"""A target or a start this far from every sector is free for certain, on every kind of rotor."""
NEAR_DEG = 6.0
"""Nearer than this to its target, on the sky, the antenna counts as there."""
PATIENCE_S = 60.0
MASKS_SHARE, MASK_DEG = 0.5, 15.0
"""The share of worlds that have a horizon of trees and roofs, and its greatest height."""
SERVO_START = (90.0, 90.0)
START_S = 1000.0

Place = tuple[float, float]


@dataclass
class Outcome:
    """The result of one world."""

    seed: int
    inside: str = ""
    """The first time that shaft or boom was inside a sector, coming from outside; empty: never."""
    missed: list[str] = field(default_factory=list)
    """Free places that were ordered and can be reached, but were not reached."""
    moves: Counter[str] = field(default_factory=Counter)
    """The kinds of orders that it had, and how often."""
    reached: int = 0


class World:
    """One random station, and the box on it."""

    def __init__(self, profile: str, seed: int) -> None:
        self.random = random.Random(f"{profile} {seed}")
        self.masks = random.Random(f"{profile} {seed} mask")
        self.outcome = Outcome(seed)
        self.config = self._drawn(profile)
        self.mount: Mount = build_mount(self.config)
        self.paces = {
            axis: getattr(self.config.sim, axis.value).speed_dps / self.config.axis(axis).speed_dps for axis in Axis
        }
        self.clock = SimClock(START_S)
        # A servo reports nothing: the box knows its place only after the first pulse.
        start = SERVO_START if self.config.rotor.type == "servo" else self.place()
        self.station = Station(self.config, self.clock, self.clock.sleep, start, add_alarm=self.clock.add_alarm)
        assert self.station.world is not None
        self.world = self.station.world
        self._period_s = 1 / self.config.control.rate_hz
        self._next_s = self.clock()
        self._connections = 1
        self.restart()

    def restart(self) -> None:
        """The program begins anew, and the world goes on."""
        self.station.rotor.off()
        self.loop = ControlLoop(build_controller(self.config), self.station.rotor, self.clock, self._period_s)

    def _drawn(self, profile: str) -> Config:
        values = tomllib.loads(shipped(profile))
        values.pop("panel", None)
        values.setdefault("rotor", {})["hardware"] = "sim"
        plain = simulated(parse(tomlkit.dumps(values), profile))
        draw = self.random
        values["mount"] = {**values.get("mount", {}), "forbidden": self._sectors(plain)}
        if self.masks.random() < MASKS_SHARE:
            values["mount"]["horizon"] = [
                [float(azimuth_deg), round(self.masks.uniform(0.0, MASK_DEG), 1)] for azimuth_deg in range(0, 360, 45)
            ]
        if plain.rotor.type != "moteus":
            # A moteus has a controller of its own, which obeys speeds.
            slowest = SLOWEST_COUNTED if plain.rotor.type == "relay-pulse" else SLOWEST
            for axis in Axis:
                sim = values.setdefault("sim", {}).setdefault(axis.value, {})
                sim["speed_dps"] = plain.axis(axis).speed_dps * draw.uniform(slowest, FASTEST)
                sim["lag_s"], sim["backlash_deg"] = draw.uniform(0.05, 0.17), draw.choice([0.0, 0.5, 1.0])
                sim["pot_noise_deg"] = draw.choice([0.0, 0.1, 0.4])
        return simulated(parse(tomlkit.dumps(values), profile))

    def _sectors(self, config: Config) -> list[dict[str, object]]:
        draw, limits = self.random, build_mount(config)
        park = limits.park_azimuth_deg, limits.park_elevation_deg
        found: list[dict[str, object]] = []
        while not found:
            for number in range(draw.randint(1, 3)):
                west_deg = draw.uniform(limits.azimuth.min_deg, limits.azimuth.max_deg - 3)
                east_deg = min(west_deg + draw.uniform(2, 80), limits.azimuth.max_deg)
                low_deg = limits.elevation.min_deg
                if draw.random() < 0.4:
                    low_deg = draw.uniform(low_deg, limits.elevation.max_deg - 5)
                high_deg = min(low_deg + draw.uniform(3, 60), limits.elevation.max_deg)
                sector = Sector("", Range(west_deg, east_deg), Range(low_deg, high_deg), 2.0)
                if not near(sector, park, 2.0) and not near(sector, SERVO_START, CLEAR_DEG):
                    span = {"azimuth_deg": [west_deg, east_deg], "elevation_deg": [low_deg, high_deg]}
                    found.append({"name": f"sector {number}", **span})
        return found

    def place(self) -> Place:
        """A place that is free for certain."""
        azimuth, elevation = self.mount.azimuth, self.mount.elevation
        roofs_deg = max((height_deg for _, height_deg in self.mount.horizon), default=0.0)
        for _ in range(500):
            place = (
                self.random.uniform(azimuth.min_deg, azimuth.max_deg),
                self.random.uniform(max(elevation.min_deg, roofs_deg), min(elevation.max_deg, 180.0 - roofs_deg)),
            )
            if not any(near(sector, place, CLEAR_DEG) for sector in self.mount.sectors):
                return place
        raise LookupError("no free place")

    def anywhere(self) -> Place:
        return self.random.uniform(0, 360), self.random.uniform(0, min(90.0, self.mount.elevation.max_deg))

    def known_pass(self) -> Fly:
        """A target that goes straight over the sky, planned whole: it begins now, or the antenna waits for it."""
        draw, now_s = self.random, self.clock()
        begin_s, lasts_s = now_s + draw.choice([0.0, draw.uniform(0.0, 60.0)]), draw.uniform(30.0, 300.0)
        (az_a, el_a), (az_b, el_b) = self.anywhere(), self.anywhere()
        across_deg = az_b - az_a + draw.choice([-360.0, 0.0, 0.0, 360.0])
        count = int(lasts_s)
        rows = tuple(
            (begin_s + t, (az_a + across_deg * t / count) % 360.0, el_a + (el_b - el_a) * t / count)
            for t in range(count + 1)
        )
        stands_deg = [self.loop.status.axis(axis).angle_deg or 0.0 for axis in Axis]
        antenna = Antenna(self.mount, *planned_motors(self.config), (stands_deg[0], stands_deg[1]))
        return plan_flight("known", KnownPath(rows), antenna, now_s).order

    def run(self, seconds: float) -> None:
        end_s = self.clock() + seconds
        while self._next_s < end_s and not self.outcome.inside:
            while self.clock() < self._next_s:
                self.clock.sleep_until(min(self.clock() + 0.01, self._next_s))
                self._judge()
            self.loop.cycle()
            self._next_s += self._period_s

    def _judge(self) -> None:
        for what, place in (("shaft", self.world.shafts()), ("boom", self.world.antenna())):
            for sector in self.mount.sectors:
                if near(sector, place, 0.0):
                    self.outcome.inside = f"{what} at {place[0]:.2f} {place[1]:.2f} in {sector} at {self.clock():.2f} s"

    def order(self, order: Order, by: Source = LINK) -> None:
        self.loop.post(by, order)

    def reach(self, place: Place) -> None:
        """Order a free place, and wait until the antenna stands there."""
        began_s, began = self.clock(), self.world.shafts()
        # The panel may have taken the antenna from this link: a new connection may move it again.
        self._connections += 1
        self.order(Aim(*place, place=True), Source("gs232b", self._connections))
        slowest = min(self.paces.values())
        end_s = began_s + PATIENCE_S + 8.0 * self._straight_s(began, (720.0, 360.0)) / max(slowest, 0.3)
        while self.clock() < end_s and not self.outcome.inside:
            self.run(0.5)
            if self.off_deg(place) < NEAR_DEG:
                self.outcome.reached += 1
                return
        status = self.loop.status
        if not self._can_reach(began, place):
            return
        notices = (notice.text for axis in (status.azimuth, status.elevation) for notice in axis.notices)
        said = "; ".join([*map(str, status.faults), *status.notices, *notices])
        (to, came_from, at) = (f"{az_deg:.1f} {el_deg:.1f}" for az_deg, el_deg in (place, began, self.world.shafts()))
        self.outcome.missed.append(f"to {to} from {came_from}: stands at {at}; {said or 'the box says nothing'}")

    def _can_reach(self, began: Place, place: Place) -> bool:
        """Whether there is a way with much room to every sector, on any turn and with no flip."""
        azimuth, elevation = self.config.azimuth, self.config.elevation
        room_deg = CLEAR_DEG - 4.0, CLEAR_DEG - 4.0
        wide = Detours(self.mount, room_deg, (0.0, 0.0), Speeds(azimuth.speed_dps, elevation.speed_dps))
        return any(
            math.isfinite(wide.seconds(box_at(began), (azimuth_deg, elevation_deg)))
            for azimuth_deg, elevation_deg, over in self.mount.places(*place)
            if not over
        )

    def off_deg(self, place: Place) -> float:
        """On the sky: over the top the antenna looks the same way as from the front."""
        return great_circle_deg(*self.world.antenna(), *place)

    def _straight_s(self, a: Place, b: Place) -> float:
        each_s: list[float] = [
            abs(to_deg - from_deg) / (self.config.axis(axis).speed_dps * self.paces[axis])
            for axis, from_deg, to_deg in zip(Axis, a, b, strict=True)
        ]
        return max(each_s)


def near(sector: Sector, place: Place, by_deg: float) -> bool:
    spans = sector.azimuth.widened(by_deg), sector.elevation.widened(by_deg)
    return all(span.min_deg < angle_deg < span.max_deg for span, angle_deg in zip(spans, place, strict=True))
