"""The two jog switches on one input of a converter: resistors, readings, bands.

Knows the resistors and the shares of the supply that they make. Does not know the converter, nor what a jog does.

Two resistors of 10 kΩ beside the converter hold its input at half the supply. Each switch is a centre-off toggle. Its
common contact goes to that input through its own resistor: azimuth 6.8 kΩ, elevation 12 kΩ. Thrown to CW or UP it
connects to the supply; thrown to CCW or DOWN it connects to ground. All resistors are of 1 %. Shares of the supply:

    CCW and DOWN  0.232    CCW  0.288    DOWN  0.353    CCW and UP  0.426
    neither       0.500
    CW and DOWN   0.574    UP   0.647    CW    0.712    CW and UP   0.768

A band reaches 0.026 to either side. That covers the tolerance of the resistors and a supply that is 3 % off, and no two
bands meet. A reading between bands, or at either end (a wire shorted to ground or to the supply), means nothing. The
broken wire of a switch reads as that switch released. With a larger error of the supply the centre itself is in no
band, and no press begins. A second input that measures the supply removes this error.
"""

from __future__ import annotations

from hw.ports import Axis, Direction

BIAS_OHM = 10_000.0
"""Each of the two resistors that hold the input at half the supply."""
SWITCH_OHM = {Axis.AZIMUTH: 6_800.0, Axis.ELEVATION: 12_000.0}
HALF_BAND = 0.026

Throw = tuple[Direction, Direction]
"""The positions of the azimuth switch and of the elevation switch."""

CENTRE: Throw = (Direction.OFF, Direction.OFF)


def level(throw: Throw) -> float:
    """The share of the supply, 0 to 1, at the converter's input."""
    to_supply = to_ground = 1.0 / BIAS_OHM
    for axis, direction in zip(SWITCH_OHM, throw, strict=True):
        if direction is Direction.PLUS:
            to_supply += 1.0 / SWITCH_OHM[axis]
        elif direction is Direction.MINUS:
            to_ground += 1.0 / SWITCH_OHM[axis]
    return to_supply / (to_supply + to_ground)


LEVELS: dict[Throw, float] = {
    (azimuth, elevation): level((azimuth, elevation)) for azimuth in Direction for elevation in Direction
}


def thrown(share: float) -> Throw | None:
    """The positions of the switches for this share of the supply; None: the share is in no band."""
    nearest = min(LEVELS, key=lambda throw: abs(LEVELS[throw] - share))
    return nearest if abs(LEVELS[nearest] - share) <= HALF_BAND else None
