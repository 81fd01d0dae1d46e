"""A mast made by hand for the judges of the drills: the truth of two motors, and the orders to them.

Knows how the coil, the supply and the speed of azimuth are set, step by step. Knows no box: it obeys no order.
"""

from __future__ import annotations

from benchmarks.drills.axis_case import AxisCase
from benchmarks.drills.goals import Ranges
from benchmarks.drills.judges import Judges
from benchmarks.drills.orders import Orders
from benchmarks.drills.script import Event
from benchmarks.drills.world import AxisTruth

STEP_S = 0.05


class Mast:
    """Two motors of 6°/s on relays, range 0° to 360°, stops 2° beyond; azimuth is moved by hand."""

    def __init__(
        self,
        *,
        master: bool = False,
        at_deg: float = 100.0,
        top_deg: float = 360.0,
        lacking: str = "",
        idle: bool = False,
    ) -> None:
        self.azimuth = AxisTruth("azimuth", 6.0, 0.5, -2.0, 362.0, shaft_deg=at_deg, relayed=True)
        self.elevation = AxisTruth("elevation", 6.0, 0.5, -2.0, 182.0, relayed=True)
        self.orders = Orders(
            (Ranges(0.0, top_deg, False), Ranges(0.0, 180.0, False)),
            (0.0, 0.0),
            lacking=lacking,
            parks_idle=idle,
            over_top=lambda: self.elevation.shaft_deg > 90.0,
        )
        self.case = AxisCase(0.0, 360.0, 4.0)
        self.judges = Judges((self.case, AxisCase(0.0, 180.0, 4.0)), self.orders, master=master)
        self.now_s = 0.0

    def order(self, who: str, what: str, *args: float | str) -> None:
        self.orders.note(Event(self.now_s, who, what, args))

    def run(self, seconds: float, *, coil: int = 0, power: int | None = None, dps: float | None = None) -> list[str]:
        """`coil`: what the box commands; `power`: what feeds the motor, `dps`: how it turns, where those differ."""
        truth = self.azimuth
        truth.coil, truth.power = coil, coil if power is None else power
        truth.speed_dps = 6.0 * truth.power if dps is None else dps
        for _ in range(round(seconds / STEP_S)):
            self.now_s += STEP_S
            truth.shaft_deg = min(
                max(truth.shaft_deg + truth.speed_dps * STEP_S, truth.stop_low_deg), truth.stop_high_deg
            )
            self.orders.expire(self.now_s)
            self.judges.look(self.now_s, [truth, self.elevation])
        return [violation.judge for violation in self.judges.found]
