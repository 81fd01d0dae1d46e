"""How the box turns through north and over the top: run `python -m benchmarks.mount`.

The north-crossing passes and their mirror images (azimuth to 360 - azimuth), on a 450-degree rotor started on every
turn of its overlap, and on a 360 x 180 rotor that may go over the top. Counts unwinds, flips and the seconds in which
the antenna is more than ten degrees off. Every figure is the same on every machine.
"""

from __future__ import annotations

from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from itertools import pairwise

from rotator.config.load import parse
from rotator.rehearsal.flight import fly, plant_maker
from rotator.rehearsal.passes import SHIPPED, Pass, read_pass
from rotator.rehearsal.summary import SAMPLE_S
from rotator.views.trace import Sample

OFF_DEG = 10.0
LONG_SWING_DEG = 200.0
"""No step along a pass is this long: it is an unwind."""


@dataclass(frozen=True, slots=True)
class Case:
    name: str
    mirrored: bool
    configuration: str
    start_deg: float | None = None


@dataclass(frozen=True, slots=True)
class Outcome:
    case: Case
    unwinds: int
    flips: int
    first_s: float | None
    """When the first of them began."""
    off_s: float
    rms_deg: float


def mirror(flown: Pass) -> Pass:
    return replace(flown, rows=tuple((t, (360.0 - azimuth) % 360.0, elevation) for t, azimuth, elevation in flown.rows))


def unwinds(trace: list[Sample]) -> list[float]:
    """The moments at which a long swing of azimuth began."""
    begun: list[float] = []
    start: Sample | None = None
    for before, after in pairwise(trace):
        if after.az_drive != before.az_drive:
            if start is not None and abs(after.antenna_az - start.antenna_az) > LONG_SWING_DEG:
                begun.append(start.t)
            start = after if after.az_drive else None
    return begun


def flips(trace: list[Sample]) -> list[float]:
    """The moments at which the antenna passed the zenith."""
    return [after.t for before, after in pairwise(trace) if (before.antenna_el > 90.0) != (after.antenna_el > 90.0)]


def fly_case(case: Case) -> Outcome:
    flown = read_pass(SHIPPED / f"{case.name}.csv")
    if case.mirrored:
        flown = mirror(flown)
    start = "" if case.start_deg is None else f"[sim.azimuth]\nstart_deg = {case.start_deg}\n"
    trace, summary = fly(flown, plant_maker(parse(case.configuration + start, "benchmark")))
    unwound, flipped = unwinds(trace), flips(trace)
    off_s = sum(SAMPLE_S for sample in trace if sample.t > 5 and sample.error_deg > OFF_DEG)
    first_s = min((*unwound, *flipped), default=None)
    return Outcome(case, len(unwound), len(flipped), first_s, off_s, summary.rms_deg)


def cases() -> list[Case]:
    some = []
    flips = '[azimuth]\nmax_deg = 360\n[mount]\nflip = "over-top"\n'
    for path in sorted(SHIPPED.glob("north-*.csv")):
        for mirrored in (False, True):
            flown = mirror(read_pass(path)) if mirrored else read_pass(path)
            first_deg = flown.rows[0][1]
            for start_deg in (first_deg, first_deg + 360.0):
                if start_deg <= 450.0:
                    some.append(Case(path.stem, mirrored, "", start_deg))
            some.append(Case(path.stem, mirrored, flips))
    return some


def main() -> None:
    print("| pass | rotor | starts at | unwinds | flips | first at | more than 10° off | rms |")
    print("|---|---|---|---|---|---|---|---|")
    with ProcessPoolExecutor() as pool:
        for outcome in pool.map(fly_case, cases()):
            case = outcome.case
            rotor = "450°" if case.start_deg is not None else "360° x 180°, flip on"
            print(
                f"| {case.name}{' mirrored' if case.mirrored else ''} | {rotor} "
                f"| {'' if case.start_deg is None else f'{case.start_deg:.0f}°'} | {outcome.unwinds} | {outcome.flips} "
                f"| {'' if outcome.first_s is None else f'{outcome.first_s:.0f} s'} "
                f"| {outcome.off_s:.0f} s | {outcome.rms_deg:.2f}° |",
                flush=True,
            )


if __name__ == "__main__":
    main()
