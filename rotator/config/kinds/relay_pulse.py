"""`rotor.type = "relay-pulse"`: motors on relays, each with a contact that is counted. The Alliance U-100 is one.

Knows its table [pulses], the lines of [relays], and the answers of this kind to the questions in `kind.py`. Knows no
driver.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import ClassVar, Literal

from pydantic import Field

from hw.ports import AngleSource, Axis
from rotator.config.axes import AxisTable
from rotator.config.kinds.kind import EndStop, Usual
from rotator.config.kinds.relay_pot import RelayPot
from rotator.config.sensors import Angle
from rotator.config.table import Gpio, PerAxis, Table

CLEAR_DEG = 1.0
"""An axis that counts is brought to rest no nearer to the last edge of its contact before a stop."""


class PulseAxisTable(Table):
    contact: Gpio = 16
    """The input with the cam's contact."""
    spacing_deg: float = Field(5.0, gt=0, le=30)
    """The angle from one closure to the next: 5 on a modified Alliance U-100, else 6 or 10."""
    closed_deg: float = Field(1.0, gt=0, le=30)
    """The part of the spacing in which the contact is closed."""
    closes_at_deg: float = Field(0.0, ge=-360, le=720)
    """Any angle at which the contact closes on the way clockwise or up."""
    coast_s: float = Field(0.5, gt=0, le=5)
    """The time after its relay opens until the motor surely stands."""
    play_deg: float = Field(0.0, ge=0, le=10)
    """The play of the gear: after a reversal the contact changes this much later."""
    home_deg: float = Field(0.0, ge=-360, le=720)
    """Where homing ends: at the low end stop, or at rest after the low limit switch opened."""

    def edges_deg(self, near_deg: float) -> list[float]:
        """Angles at which the contact changes, a few on both sides of `near_deg`."""
        turn = math.floor((near_deg - self.closes_at_deg) / self.spacing_deg)
        closures_deg = [self.closes_at_deg + each * self.spacing_deg for each in range(turn - 2, turn + 5)]
        return [closes_deg + part_deg for closes_deg in closures_deg for part_deg in (0.0, self.closed_deg)]

    def faults(self) -> Iterator[str]:
        narrowest_deg = min(self.closed_deg, self.spacing_deg - self.closed_deg)
        if narrowest_deg <= 0:
            yield f"closed_deg ({self.closed_deg:g}) must be below spacing_deg ({self.spacing_deg:g})"
        elif self.play_deg >= narrowest_deg:
            # A shaft that came down stands anywhere in its play: with two closures in it, the contact names no place.
            yield (
                f"play_deg ({self.play_deg:g}) must be below {narrowest_deg:g}, the width of the cam's narrower part: "
                "with more play the contact shows the same at two places, and the axis cannot be homed; measure "
                "closed_deg, or take play out of the gear"
            )


class PulseElevation(PulseAxisTable):
    contact: Gpio = 20
    """The input with the cam's contact."""


class Pulses(PerAxis, Table):
    active: Literal["low", "high"] = "low"
    """A closed contact's level; low for an opto-isolator to ground."""
    pull: bool = True
    """The Pi's own resistor holds the line at the open level."""
    debounce_s: float = Field(0.02, ge=0, le=0.3)
    """A change of the contact counts after this time."""
    azimuth: PulseAxisTable = PulseAxisTable.model_construct()
    """The azimuth axis's cam."""
    elevation: PulseElevation = PulseElevation.model_construct()
    """The elevation axis's cam."""


@dataclass(frozen=True, slots=True)
class RelayPulse(RelayPot):
    pulses: Pulses

    own = Angle(AngleSource.COUNTED, sensor="contact", by="counted")
    usual: ClassVar[Usual] = {
        "azimuth": {"coast_s": 0.1},
        "elevation": {"speed_dps": 6.0, "coast_s": 0.1},
        "sim.azimuth": {"lag_s": 0.1},
        "sim.elevation": {"speed_dps": 6.0, "lag_s": 0.1},
    }

    def pins(self) -> list[tuple[int, str]]:
        outputs = RelayPot.pins(self)
        return outputs + [(self.pulses.of(axis).contact, f"pulses.{axis.value}.contact") for axis in Axis]

    def cams(self, axes: Iterable[Axis]) -> dict[Axis, dict[str, object]]:
        return {axis: self.pulses.of(axis).model_dump(exclude={"contact"}) for axis in axes}

    def faults(self, axes: Mapping[Axis, AxisTable]) -> list[str]:
        longest_coast_s = max(self.pulses.of(axis).coast_s for axis in axes)
        if self.relays.dead_time_s >= longest_coast_s:
            return []
        return [
            f"relays.dead_time_s = {self.relays.dead_time_s:g} is shorter than pulses coast_s "
            f"({longest_coast_s:g}): a motor that still coasts would be counted the wrong way"
        ]

    def end_stop(self, axis: Axis, max_deg: float) -> EndStop | None:
        cam = self.pulses.of(axis)
        mostly_closed = cam.closed_deg > cam.spacing_deg / 2
        lowest_deg = min(edge for edge in cam.edges_deg(cam.home_deg) if edge - cam.play_deg > cam.home_deg)
        highest_deg = max(edge for edge in cam.edges_deg(max_deg) if edge <= max_deg)
        rest_deg = (lowest_deg + CLEAR_DEG, highest_deg - CLEAR_DEG)
        return EndStop(cam.spacing_deg, cam.coast_s + self.pulses.debounce_s, cam.home_deg, mostly_closed, rest_deg)
