"""The table that commissioning makes: points from reading to degrees, what is wrong with them, how they look.

Knows numbers and their text. Knows nothing of how a point was found or of where the table goes.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise

from hw.interpolation import PiecewiseLinear
from rotator.calibrating.readings import Doubt, Measured

LEAST_SPAN = 0.05
"""Two ends that read closer than this are one place."""
LEAST_SPAN_DEG = 10.0
LEAST_STEP = 0.002
LEAST_MARGIN = 0.01
"""Nearer to lowest_reading or highest_reading than this, a little drift would be taken for a broken wire."""


@dataclass(frozen=True, slots=True)
class Point:
    measured: Measured
    angle_deg: float

    @property
    def raw(self) -> float:
        return self.measured.raw


@dataclass(frozen=True, slots=True)
class Table:
    """Points in order of their degrees."""

    points: tuple[Point, ...] = ()
    rising: bool = True
    """Readings grow with the degrees: what the direction check has found."""

    def with_end(self, end: Point) -> Table:
        """The first end, or the second above it. Raises Doubt."""
        if self.points:
            low = self.points[0]
            if end.angle_deg - low.angle_deg < LEAST_SPAN_DEG:
                raise Doubt(f"the ends are {low.angle_deg:g}° and {end.angle_deg:g}°: too close, or swapped")
            if abs(end.raw - low.raw) < LEAST_SPAN:
                raise Doubt(f"the ends read {low.raw:.4f} and {end.raw:.4f}: too close to be two ends")
            if (end.raw > low.raw) != self.rising:
                raise Doubt(
                    f"the ends read {low.raw:.4f} and {end.raw:.4f}, but the direction check saw the reading "
                    f"{'rise' if self.rising else 'fall'} with the degrees"
                )
        return replace(self, points=(*self.points, end))

    def with_point(self, point: Point) -> Table:
        """A point between the ends. Raises Doubt where the table would not be monotonic."""
        points = tuple(sorted((*self.points, point), key=lambda each: each.angle_deg))
        if point in (points[0], points[-1]):
            low, high = self.points[0].angle_deg, self.points[-1].angle_deg
            raise Doubt(f"{point.angle_deg:g}° is not between the ends, {low:g}° and {high:g}°")
        for a, b in pairwise(points):
            if b.angle_deg <= a.angle_deg:
                raise Doubt(f"{point.angle_deg:g}° is in the table already")
            if (b.raw - a.raw if self.rising else a.raw - b.raw) < LEAST_STEP:
                raise Doubt(
                    f"not monotonic: {a.angle_deg:g}° reads {a.raw:.4f} and {b.angle_deg:g}° reads {b.raw:.4f}, "
                    f"but readings {'rise' if self.rising else 'fall'} with the degrees"
                )
        return replace(self, points=points)

    @property
    def deg_per_raw(self) -> float:
        low, high = self.points[0], self.points[-1]
        return (high.angle_deg - low.angle_deg) / abs(high.raw - low.raw)

    def off_line_deg(self, point: Point) -> float:
        """How far a point lies off the straight line through the ends."""
        low, high = self.points[0], self.points[-1]
        line = PiecewiseLinear(((low.angle_deg, low.raw), (high.angle_deg, high.raw)))
        return point.angle_deg - line.inverse(point.raw)

    def lines(self, supply_v: float | None, lowest: float, highest: float) -> list[str]:
        """The table as text, with volts where it is a pot's, and how far its ends are from what counts as a fault."""

        def volts(share: float) -> str:
            return "" if supply_v is None else f"{share * supply_v:.3f} V"

        header, drift = ("volts", "a broken wire") if supply_v is not None else ("", "a fault")
        rows = [f"  reading  {header:>8}   degrees   off a straight line   noise"]
        for point in self.points:
            noise_deg = point.measured.noise * self.deg_per_raw
            rows.append(
                f"  {point.raw:7.4f}  {volts(point.raw):>8}  {point.angle_deg:7.1f}°  "
                f"{self.off_line_deg(point) + 0.0:+17.1f}°  {noise_deg:6.2f}°"
            )
        raws = [point.raw for point in self.points]
        for margin, where in (
            (min(raws) - lowest, f"above lowest_reading ({lowest:g})"),
            (highest - max(raws), f"below highest_reading ({highest:g})"),
        ):
            shown = ", ".join(filter(None, (f"{margin * self.deg_per_raw:.0f}°", volts(margin))))
            rows.append(f"  {margin:.4f} ({shown}) {where}")
            if margin < LEAST_MARGIN:
                rows.append(f"  That is little: some drift would be taken for {drift}. See docs/wiring.md.")
        return rows
