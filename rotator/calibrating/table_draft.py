"""The calibration table while it is made: points from reading to degrees, what is wrong with them, and their text.

Knows numbers. Does not know how a point was read, nor where the table is saved.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise

from hw.interpolation import PiecewiseLinear
from rotator.calibrating.readings import Measured, NotTrusted

LEAST_SPAN = 0.05
"""Two ends whose readings are closer than this are the same place."""
LEAST_SPAN_DEG = 10.0
LEAST_STEP = 0.002
"""The least difference of reading between two neighbouring points."""
LEAST_MARGIN = 0.01
"""A point nearer than this to lowest_reading or highest_reading: a small drift would look like a broken wire."""


@dataclass(frozen=True, slots=True)
class TablePoint:
    measured: Measured
    angle_deg: float

    @property
    def raw(self) -> float:
        return self.measured.raw


@dataclass(frozen=True, slots=True)
class TableDraft:
    """Points in order of their degrees."""

    points: tuple[TablePoint, ...] = ()
    rising: bool = True
    """The direction check has found that readings rise with the degrees."""

    def with_end(self, end: TablePoint) -> TableDraft:
        """With the low end, or with the high end above it. Raises NotTrusted."""
        if self.points:
            low = self.points[0]
            if end.angle_deg - low.angle_deg < LEAST_SPAN_DEG:
                raise NotTrusted(f"the ends are {low.angle_deg:g}° and {end.angle_deg:g}°: too close, or swapped")
            if abs(end.raw - low.raw) < LEAST_SPAN:
                raise NotTrusted(f"the ends read {low.raw:.4f} and {end.raw:.4f}: too close to be two ends")
            if (end.raw > low.raw) != self.rising:
                raise NotTrusted(
                    f"the ends read {low.raw:.4f} and {end.raw:.4f}, but the direction check saw the reading "
                    f"{'rise' if self.rising else 'fall'} with the degrees"
                )
        return replace(self, points=(*self.points, end))

    def with_point(self, point: TablePoint) -> TableDraft:
        """With a point between the ends. Raises NotTrusted where the table would not be monotonic."""
        points = tuple(sorted((*self.points, point), key=lambda at: at.angle_deg))
        if point in (points[0], points[-1]):
            low, high = self.points[0].angle_deg, self.points[-1].angle_deg
            raise NotTrusted(f"{point.angle_deg:g}° is not between the ends, {low:g}° and {high:g}°")
        for a, b in pairwise(points):
            if b.angle_deg <= a.angle_deg:
                raise NotTrusted(f"{point.angle_deg:g}° is in the table already")
            if (b.raw - a.raw if self.rising else a.raw - b.raw) < LEAST_STEP:
                raise NotTrusted(
                    f"not monotonic: {a.angle_deg:g}° reads {a.raw:.4f} and {b.angle_deg:g}° reads {b.raw:.4f}, "
                    f"but readings {'rise' if self.rising else 'fall'} with the degrees"
                )
        return replace(self, points=points)

    @property
    def deg_per_raw(self) -> float:
        low, high = self.points[0], self.points[-1]
        return (high.angle_deg - low.angle_deg) / abs(high.raw - low.raw)

    def off_line_deg(self, point: TablePoint) -> float:
        """How far a point lies off the straight line through the ends."""
        low, high = self.points[0], self.points[-1]
        line = PiecewiseLinear(((low.angle_deg, low.raw), (high.angle_deg, high.raw)))
        return point.angle_deg - line.inverse(point.raw)

    def off_others_deg(self, point: TablePoint) -> float:
        """How far a point lies off the line through its neighbours in the table, which does not have it yet."""
        line = PiecewiseLinear(tuple((at.angle_deg, at.raw) for at in self.points))
        return point.angle_deg - line.inverse(point.raw)

    def learnt(self, lowest: float, highest: float) -> tuple[str, ...]:
        """What the points say of the sensor, in sentences for a person."""
        low, high = self.points[0], self.points[-1]
        bent_deg = max(abs(self.off_line_deg(point)) for point in self.points)
        noise_deg = max(point.measured.noise for point in self.points) * self.deg_per_raw
        raws = [point.raw for point in self.points]
        told = [
            f"From {low.angle_deg:g}° to {high.angle_deg:g}° it reads {low.raw:.4f} to {high.raw:.4f}.",
            "It is taken for straight between its ends: nothing was read there."
            if len(self.points) == len((low, high))
            else f"It is up to {bent_deg:.1f}° off a straight line: the points between correct that.",
            f"One reading is sure to {noise_deg:.2f}° (rms).",
        ]
        if min(min(raws) - lowest, highest - max(raws)) < LEAST_MARGIN:
            told.append("It reads almost to the end of its scale: some drift would be taken for a broken wire.")
        return tuple(told)

    def lines(self, supply_v: float | None, lowest: float, highest: float) -> list[str]:
        """The table as text, with the distance of its ends from the readings that count as a fault.

        `supply_v`: the supply of a pot, to show volts; None: the sensor is no pot.
        """

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
                rows.append(f"  That is little: some drift would be taken for {drift}. See: rotator help wiring")
        return rows
