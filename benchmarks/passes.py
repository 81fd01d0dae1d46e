"""How well the box points: run `python -m benchmarks.passes`.

Twelve real passes flown in simulated time by the emulated sketch and by the box at 4, 2 and 1 degrees, beside the least
error that any relay controller could reach with as many starts, knowing the future (tests/passes/optimum.json).
Then by the box that knows the pass beforehand, as it does when it tracks by itself (`--known`: these alone). Prints a
Markdown table; `--svg FILE` keeps the means and draws them. Every figure is the same on every machine.
"""

from __future__ import annotations

import argparse
import json
import math
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

from benchmarks.picture import FIGURES, kept
from rotator.config.load import parse
from rotator.rehearsal.flight import Summary, fly, plant_maker
from rotator.rehearsal.passes import SHIPPED, read_pass

OPTIMUM = Path(__file__).parent.parent / "tests" / "passes" / "optimum.json"
TOLERANCES_DEG = (4.0, 2.0, 1.0)
AXES = ("azimuth", "elevation")


@dataclass(frozen=True, slots=True)
class Flight:
    """One pass flown by one controller. `tolerance_deg` None: the emulated sketch."""

    pass_name: str
    tolerance_deg: float | None
    summary: Summary

    @property
    def starts(self) -> int:
        return self.summary.relay_starts or 0

    @property
    def ratio(self) -> float:
        """Error against the least possible with as many starts."""
        return self.summary.rms_deg / optimum_deg(self.pass_name, self.starts)


def optimum_points() -> dict[str, list[tuple[float, float]]]:
    """For each pass the points (starts, rms in degrees), fewest starts first."""
    table = json.loads(OPTIMUM.read_text())
    return {name.removesuffix(".csv"): sorted((s, r) for s, r in points) for name, points in table.items()}


def optimum_deg(pass_name: str, starts: float) -> float:
    """Interpolated: log of the error over log of the starts; fewer starts than the first point count as that point."""
    points = optimum_points()[pass_name]
    starts = max(starts, points[0][0])
    for (few, more_deg), (many, less_deg) in pairwise(points):
        if starts <= many:
            share = math.log(starts / few) / math.log(many / few)
            return float(more_deg * (less_deg / more_deg) ** share)
    return points[-1][1]


def fly_one(job: tuple[str, float | None, str, str]) -> Flight:
    pass_name, tolerance_deg, extra, via = job
    config = parse(extra, "benchmark")
    if tolerance_deg is not None:
        axes = {axis: getattr(config, axis).model_copy(update={"tolerance_deg": tolerance_deg}) for axis in AXES}
        config = config.model_copy(update=axes)
    make = plant_maker(config, via=via, arduino=tolerance_deg is None)
    _, summary = fly(read_pass(SHIPPED / f"{pass_name}.csv"), make)
    return Flight(pass_name, tolerance_deg, summary)


def fly_all(tolerances: tuple[float | None, ...], extra: str = "", via: str = "gs232") -> list[Flight]:
    names = [path.stem for path in sorted(SHIPPED.glob("*.csv"))]
    jobs = [(name, tolerance, extra, via) for tolerance in tolerances for name in names]
    with ProcessPoolExecutor() as pool:
        return list(pool.map(fly_one, jobs))


def mean(values: list[float]) -> float:
    return sum(values) / len(values)


def means_line(name: str, flights: list[Flight]) -> str:
    each = [flight.summary for flight in flights]
    return (
        f"{name:22} {mean([f.starts for f in flights]):6.1f} starts (most {max(f.starts for f in flights)}), "
        f"{mean([s.rms_deg for s in each]):5.2f}° rms, p95 {mean([s.p95_deg for s in each]):.2f}° "
        f"(most {max(s.p95_deg for s in each):.2f}°), worst {max(s.max_deg for s in each):.1f}°, "
        f"{mean([f.ratio for f in flights]):.3f} x the optimum"
    )


def markdown(flights: list[Flight]) -> str:
    rows = ["| pass | emulated sketch | box at 4° | box at 2° | box at 1° |", "|---|---|---|---|---|"]
    by_key = {(flight.pass_name, flight.tolerance_deg): flight for flight in flights}
    for name in sorted({flight.pass_name for flight in flights}):
        cells = []
        for tolerance in (None, *TOLERANCES_DEG):
            flight = by_key[name, tolerance]
            cells.append(f"{flight.starts} starts, {flight.summary.rms_deg:.2f}°")
        rows.append(f"| {name} | " + " | ".join(cells) + " |")
    return "\n".join(rows)


def known() -> None:
    """The box knows each pass from two minutes before its rise on."""
    for tolerance in TOLERANCES_DEG:
        print(means_line(f"known, box at {tolerance:g}°", fly_all((tolerance,), via="track")))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--known", action="store_true", help="only passes that the box knows beforehand")
    parser.add_argument("--svg", type=Path, metavar="FILE", help="keep the means, and draw them")
    asked = parser.parse_args()
    if asked.known:
        known()
        return
    flights = fly_all((None, *TOLERANCES_DEG))
    print(markdown(flights))
    print()
    series = {}
    for tolerance in (None, *TOLERANCES_DEG):
        chosen = [flight for flight in flights if flight.tolerance_deg == tolerance]
        name = "emulated sketch" if tolerance is None else f"box at {tolerance:g}°"
        if tolerance is None:
            # The sketch knows no overlap: where a pass crosses north it turns right round, and a mean would hide that.
            chosen = [flight for flight in chosen if not flight.pass_name.startswith("north")]
            name += ", nine passes"
        print(means_line(name, chosen))
        series[name] = (mean([f.starts for f in chosen]), mean([f.summary.rms_deg for f in chosen]))
    noisy = "[sim.azimuth]\npot_noise_deg = 0.4\n[sim.elevation]\npot_noise_deg = 0.4\n"
    chosen = fly_all((4.0,), noisy)
    quiet = series["box at 4°"][0]
    print(means_line("box at 4°, noise x 4", chosen) + f", {mean([f.starts for f in chosen]) / quiet:.2f} x the starts")
    known()
    if asked.svg is not None:
        FIGURES.write_text(json.dumps(series, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
        asked.svg.write_text(kept(), encoding="utf-8")


if __name__ == "__main__":
    main()
