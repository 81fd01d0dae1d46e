"""What recognition gains: run `python -m benchmarks.recognised [PASSES [SEED]]`.

Passes at random stations and moments, of real satellites and of orbits like theirs, all of them in the catalogue. Each
is flown three times from the rotor's place at its beginning: known beforehand (`--via track`), as a stream of whole
degrees from a program whose clock is up to 5 s off, and as the same stream to a box that knows no satellites. The
stream begins as the program sees the satellite rise. Errors are those to the true satellite; those of the last flight
are to the stream itself. `--flip`: a rotor of 360° that goes over the top; `--single`: one of 360° that does not.
`--early S`: the program sends so long before the rise, with elevation 0. `--turning`: only passes that the rotor has to
unwind for, from where it stands as they begin. `--anywhere`: the antenna does not stand where the stream begins.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from benchmarks.random_passes import Job, flown_pass, jobs
from firmware_sim.clock import SimClock
from rotator.config.load import parse
from rotator.config.model import Config
from rotator.rehearsal.flight import fly
from rotator.rehearsal.overhearing import Named
from rotator.rehearsal.passes import Pass
from rotator.rehearsal.plants import BoxPlant, Plant
from rotator.rehearsal.summary import SAMPLE_S, Summary

PASSES = 40
LOST_DEG = 10.0
FLIP = "[azimuth]\nmax_deg = 360\n[elevation]\nmax_deg = 180\n[mount]\nflip = 'over-top'\n"
SINGLE = "[azimuth]\nmax_deg = 360\n[elevation]\nmax_deg = 90\n"
WORSE_DEG, WORSE_S = 0.05, 1.0


@dataclass(frozen=True, slots=True)
class Flight:
    """`lost_s`: for so long the antenna was more than 10° off while the satellite was up."""

    summary: Summary
    lost_s: float

    @property
    def rms_deg(self) -> float:
        return self.summary.rms_deg

    @property
    def starts(self) -> int:
        return self.summary.relay_starts or 1


@dataclass(frozen=True, slots=True)
class Flights:
    job: Job
    known: Flight
    recognised: Flight
    stream: Flight

    @property
    def ratio(self) -> float:
        """Of error times starts, to those of the known pass: the least error is nearly as one over the starts."""
        each = [flown.rms_deg * flown.starts for flown in (self.recognised, self.known)]
        return each[0] / each[1]

    @property
    def named(self) -> Named | None:
        return self.recognised.summary.recognised

    @property
    def worse(self) -> bool:
        """Than the stream alone: in seconds; where they are equal, in degrees."""
        lost_s = self.recognised.lost_s - self.stream.lost_s
        return lost_s > WORSE_S or (lost_s > -WORSE_S and self.recognised.rms_deg > self.stream.rms_deg + WORSE_DEG)


def flights(job: Job) -> Flights:
    config: Config = parse(job.config, "benchmark")
    flown = flown_pass(job)
    begin_utc_s = job.aos_s - job.early_s - job.ahead_s
    stands_deg = (flown.rows[0][1] if job.stands_deg is None else job.stands_deg), 0.0

    def maker(via: str = "gs232", utc_s: float | None = None) -> Callable[[SimClock, Pass], Plant]:
        return lambda clock, _flown: BoxPlant(config, clock, stands_deg, via, utc_s=utc_s)

    makers = maker("track"), maker(utc_s=begin_utc_s), maker()
    return Flights(job, *(_flight(flown, make) for make in makers))


def _flight(flown: Pass, make: Callable[[SimClock, Pass], Plant]) -> Flight:
    trace, summary = fly(flown, make)
    off = sum(sample.error_deg > LOST_DEG and sample.target_el > 0 and sample.t >= 0 for sample in trace)
    return Flight(summary, off * SAMPLE_S)


def line(each: Flights) -> str:
    named = each.named
    recognised = f"{named.name} after {named.after_s - each.job.early_s:5.1f} s" if named else "none"
    shown = "; ".join(
        f"{one.rms_deg:6.2f}° {one.starts:3} starts {one.lost_s:5.1f} s"
        for one in (each.known, each.recognised, each.stream)
    )
    wrong = " WRONG" if named and named.name != each.job.name else ""
    worse = " WORSE" if each.worse else ""
    return f"{each.job.name:8} {each.job.ahead_s:+.1f} s: {shown}; {each.ratio:.2f}; {recognised}{wrong}{worse}"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("passes", type=int, nargs="?", default=PASSES)
    parser.add_argument("seed", type=int, nargs="?", default=15)
    parser.add_argument("--flip", dest="rotor", action="store_const", const=FLIP, default="")
    parser.add_argument("--single", dest="rotor", action="store_const", const=SINGLE)
    parser.add_argument("--turning", action="store_true")
    parser.add_argument("--anywhere", action="store_true")
    parser.add_argument("--early", type=float, default=0.0)
    parser.add_argument("--each", action="store_true", help="print every pass")
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder, ProcessPoolExecutor() as pool:
        kinds = {"turning": asked.turning, "anywhere": asked.anywhere}
        wanted = jobs(asked.passes, asked.seed, asked.rotor, asked.early, Path(folder), **kinds)
        done = []
        for each in pool.map(flights, wanted):
            done.append(each)
            if asked.each:
                print(line(each), flush=True)
            else:
                print(f"{len(done)} of {len(wanted)} passes flown", file=sys.stderr, flush=True)
    after_s = [each.named.after_s - each.job.early_s for each in done if each.named]
    print(f"{len(done)} passes, {len(after_s)} recognised, at most {max(after_s, default=0.0):.1f} s after the rise")
    for name in ("known", "recognised", "stream"):
        flown: list[Flight] = [getattr(each, name) for each in done]
        print(
            f"{name:10} {sum(f.rms_deg for f in flown) / len(flown):6.3f}° rms, "
            f"{sum(f.starts for f in flown) / len(flown):5.1f} starts, "
            f"p95 {sum(f.summary.p95_deg for f in flown) / len(flown):.2f}°, "
            f"beyond 10° for {sum(f.lost_s for f in flown) / len(flown):.1f} s"
        )
    plain = [each for each in done if max(each.known.rms_deg, each.recognised.rms_deg) < LOST_DEG / 2]
    mean = sum(each.ratio for each in plain) / max(1, len(plain))
    print(f"error x starts, recognised to known: {mean:.3f} on the {len(plain)} passes with no turn round")
    worse = [each for each in done if each.worse]
    most_s = max((each.recognised.lost_s - each.stream.lost_s for each in worse), default=0.0)
    most_deg = max((each.recognised.rms_deg - each.stream.rms_deg for each in worse), default=0.0)
    print(f"worse than the stream alone: {len(worse)} passes, by {most_s:.1f} s and {most_deg:.2f}° at most")


if __name__ == "__main__":
    main()
