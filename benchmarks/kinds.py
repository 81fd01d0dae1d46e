"""How well each kind of rotor points: run `python -m benchmarks.kinds`.

The twelve passes flown in simulated time by each of the shipped configurations, on the simulated rotor of its kind,
from whole degrees once a second; the moteus from hundredths too. Prints a Markdown table; every figure is the same on
every machine. A rotor without overlap has to turn right round on the three passes that cross north: those have rows of
their own.
"""

from __future__ import annotations

import argparse
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from itertools import pairwise
from multiprocessing import get_context

from benchmarks.passes import mean
from rotator.cli.rehearse import simulated
from rotator.config.load import parse, shipped
from rotator.config.model import Config
from rotator.rehearsal.flight import Summary, fly, plant_maker
from rotator.rehearsal.passes import SHIPPED, read_pass
from rotator.views.trace import Sample

AWAY_DEG = 10.0
"""Off by this much, a second is lost."""
SETTLED_S = 5.0
OVER_DEG = 90.0
PASS_NAMES = sorted(path.stem for path in SHIPPED.glob("*.csv"))
FULL_TURN_DEG = 360.0


@dataclass(frozen=True, slots=True)
class Kind:
    """A row of the table: a shipped configuration, simulated, and how it is ordered about."""

    name: str
    profile: str
    via: str = "gs232"
    overlap: bool = False
    """With 450 degrees of azimuth in place of the profile's own range."""

    def config(self) -> Config:
        """The profile's, on a simulated rotor."""
        config = simulated(parse(shipped(self.profile), self.profile))
        update: dict[str, object] = {}
        if not config.elevation.fitted:  # with a second one, on its side
            update["elevation"] = type(config.elevation)()
        if self.overlap:
            update["azimuth"] = config.azimuth.model_copy(update={"max_deg": 450.0})
        return config.model_copy(update=update)


KINDS = (
    Kind("relays and pots (simulated G-5500)", "simulated"),
    Kind("the same with a speed input (g1000)", "g1000"),
    Kind("U-100, counting (u100)", "u100"),
    Kind("the same with 450° of azimuth", "u100", overlap=True),
    Kind("moteus (isel), `W` in whole degrees", "isel"),
    Kind("moteus (isel), `P %.2f`", "isel", via="rotctld"),
    Kind("H-bridges (slew-drive), `P %.2f`", "slew-drive", via="rotctld"),
    Kind("hobby servos (servos)", "servos"),
    Kind("digital pot (orbit360)", "orbit360"),
    Kind("a controller in whole degrees (controller), `P %.2f`", "controller", via="rotctld"),
    Kind("two from which nothing comes back (tv-rotator)", "tv-rotator"),
    Kind("steppers (satnogs), `W` in whole degrees", "satnogs"),
    Kind("steppers (satnogs), `P %.2f`", "satnogs", via="rotctld"),
)


@dataclass(frozen=True, slots=True)
class Flight:
    kind: Kind
    pass_name: str
    summary: Summary
    away_s: float
    """How long it was more than AWAY_DEG off."""
    swings: int
    """How often it went over the top."""

    @property
    def through_north(self) -> bool:
        return self.pass_name.startswith("north")


def fly_one(job: tuple[Kind, str]) -> Flight:
    kind, pass_name = job
    trace, summary = fly(read_pass(SHIPPED / f"{pass_name}.csv"), plant_maker(kind.config(), via=kind.via))
    return Flight(kind, pass_name, summary, away_s(trace), swings(trace))


def away_s(trace: list[Sample]) -> float:
    """Seconds, from when it had time to get going."""
    up = [sample for sample in trace if sample.t >= SETTLED_S and sample.target_el >= 0]
    step_s = (trace[-1].t - trace[0].t) / (len(trace) - 1)
    return step_s * sum(sample.error_deg > AWAY_DEG for sample in up)


def swings(trace: list[Sample]) -> int:
    """From one side of the zenith to the other, once it had time to get going."""
    sides = [sample.antenna_el > OVER_DEG for sample in trace if sample.t >= SETTLED_S]
    return sum(before is not after for before, after in pairwise(sides))


def fly_all(kinds: tuple[Kind, ...], names: list[str]) -> list[Flight]:
    jobs = [(kind, name) for kind in kinds for name in names]
    with ProcessPoolExecutor(mp_context=get_context("spawn")) as pool:
        return list(pool.map(fly_one, jobs))


def row(name: str, flights: list[Flight]) -> str:
    each = [flight.summary for flight in flights]
    starts = [summary.relay_starts for summary in each]
    told = "–" if None in starts else f"{mean([float(count or 0) for count in starts]):.1f}"
    return (
        f"{name} | {mean([s.rms_deg for s in each]):.3g}° ({max(s.rms_deg for s in each):.3g}°) "
        f"| {mean([s.p95_deg for s in each]):.3g}° ({max(s.p95_deg for s in each):.3g}°) "
        f"| {max(s.max_deg for s in each):.3g}° | {told} "
        f"| {max(flight.away_s for flight in flights):.1f} s | {max(flight.swings for flight in flights)}"
    )


def markdown(flights: list[Flight]) -> str:
    """A row for each kind; where north is an end of the range, the passes across it have one of their own."""
    rows = [
        "rotor | rms: mean (most) | 95 % within: mean (most) | worst | starts | longest beyond 10° | swings",
        "--|--|--|--|--|--|--",
    ]
    for kind in dict.fromkeys(flight.kind for flight in flights):
        mine = [flight for flight in flights if flight.kind == kind]
        config = kind.config()
        if config.azimuth.max_deg > FULL_TURN_DEG or config.mount.flip == "over-top":
            rows.append(row(kind.name, mine))
            continue
        rows.append(row(f"{kind.name}, nine passes", [flight for flight in mine if not flight.through_north]))
        rows.append(row(f"{kind.name}, three across north", [flight for flight in mine if flight.through_north]))
    return "\n".join(rows)


def main() -> None:
    argparse.ArgumentParser(description=__doc__).parse_args()
    print(markdown(fly_all(KINDS, PASS_NAMES)))


if __name__ == "__main__":
    main()
