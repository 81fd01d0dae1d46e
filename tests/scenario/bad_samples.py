"""A station with a bad sensor, drawn from a seed, and what happens to its motor in truth.

Knows orders of a program that never gives up: it acknowledges and repeats itself. Judges by the simulated motor and its
relays alone, never by what the box says.
"""

from __future__ import annotations

import random
from dataclasses import dataclass, field

from benchmarks.faults import Mast
from hw.ports import Axis, Direction
from rotator.exchange.orders import Aim, Jog, Order, Stop

AZ = Axis.AZIMUTH
SENSORS = ("azimuth-pot-crackles", "azimuth-pot-spikes", "azimuth-pot-bursts", "adc-noisy", "adc-gaps")
STRIKES = ("", "azimuth-motor-stalled", "azimuth-motor-reversed", "azimuth-pot-stuck", "azimuth-stop-early")
PACES = (0.3, 0.5, 0.8, 1.0, 1.2, 1.5)
LOOKED_S = 0.05
STANDS_DPS = 0.05
STARTING_S = 0.15
"""A motor with current stands for so long at most while it starts, or turns back."""


@dataclass(frozen=True, slots=True)
class Case:
    """What a seed stands for."""

    sensor: str
    strike: str
    pace: float
    every_s: float
    """How often the program acknowledges and orders."""
    jog_s: float | None
    """It jogs for so long; None: it aims."""

    @classmethod
    def drawn(cls, seed: int) -> Case:
        chance = random.Random(seed)
        each = round(2 * 100 ** chance.random())
        return cls(
            sensor=f"{chance.choice(SENSORS)}:{each}",
            strike=chance.choice(STRIKES),
            pace=chance.choice(PACES),
            every_s=chance.choice((0.5, 1.0, 3.0, 10.0)),
            jog_s=chance.choice((None, None, 0.3, 1.0)),
        )

    def orders(self, count: int) -> tuple[Order, ...]:
        if self.jog_s is None:
            return Stop(), Aim((100.0, 446.0, 20.0)[count // 20 % 3], 20.0)
        return Stop(), Jog(AZ, Direction.PLUS if count // 20 % 3 < 2 else Direction.MINUS, self.jog_s)


@dataclass(slots=True)
class Truth:
    """What the motor of azimuth has gone through."""

    starts: int = 0
    stalls_s: list[tuple[float, float]] = field(default_factory=list)
    """Each time it had current and stood: when that began, and for how long."""
    away_s: float = 0.0
    """The longest time for which it ran against the relay's direction."""
    shorted_s: float = 0.0

    def tries(self, within_s: float) -> int:
        """The most stalls within that time."""
        moments_s = [at_s for at_s, _ in self.stalls_s]
        return max((sum(at_s <= each < at_s + within_s for each in moments_s) for at_s in moments_s), default=0)


def tried(case: Case, seconds: float, *, broken: bool = True) -> Truth:
    """So many seconds of orders, from the moment the sensor goes bad. `broken`: with the case's faults."""
    mast, truth = Mast(), Truth()
    motor = mast.world.azimuth.motor
    try:
        mast.run(2.0)
        mast.order(Aim(60.0, 20.0))
        mast.run(10.0)
        motor.pace = case.pace
        if broken:
            mast.world.inject(case.sensor)
        starts, began_s, count, struck = mast.world.relay_starts, mast.clock(), 0, False
        stands_s = away_s = 0.0
        while (passed_s := mast.clock() - began_s) < seconds:
            if passed_s >= count * case.every_s:
                for order in case.orders(count):
                    mast.order(order)
                count += 1
            if broken and case.strike and not struck and passed_s > seconds / 4:
                struck = True
                mast.world.inject(case.strike)
            mast.run(LOOKED_S)
            # Swapped wires feed the motor the other way round: the relay says where it was to go.
            wanted = mast.world.drives()[0]
            away_s = away_s + LOOKED_S if wanted and motor.speed_dps * wanted < -STANDS_DPS else 0.0
            truth.away_s = max(truth.away_s, away_s)
            if motor.drive and abs(motor.speed_dps) < STANDS_DPS:
                stands_s += LOOKED_S
                continue
            if stands_s > STARTING_S:
                truth.stalls_s.append((passed_s, stands_s))
            stands_s = 0.0
        truth.starts, truth.shorted_s = mast.world.relay_starts - starts, motor.shorted_s
        return truth
    finally:
        mast.close()
