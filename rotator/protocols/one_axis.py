"""The box as a port for one axis has it: two controllers with one port each, such as a pair of Green Heron's RT-21.

Knows that the bearing on such a port is the angle of its axis, and that its stop is for this axis alone: the program
stops the other one on the other port. Knows no protocol.
"""

from __future__ import annotations

from dataclasses import replace

from hw.ports import Axis
from rotator.exchange.orders import Aim, Order, Stop
from rotator.exchange.sources import Refusal
from rotator.exchange.status import Status
from rotator.protocols.session import Box

BELOW_DEG = 270
"""A bearing from here on is an elevation below the horizon: 355 is -5. No elevation axis goes so far."""


class OneAxis:
    """`axis`: what the bearing of a protocol for one axis is the angle of."""

    def __init__(self, box: Box, axis: Axis) -> None:
        self._box = box
        self._axis = axis
        self.note_refused = box.note_refused

    def status(self) -> Status:
        """The status, with this axis in the place of the azimuth."""
        status = self._box.status()
        if self._axis is Axis.AZIMUTH:
            return status
        return replace(status, azimuth=status.elevation, wanted_azimuth_deg=status.wanted_elevation_deg)

    def order(self, order: Order) -> Refusal | None:
        """As of the box."""
        match order:
            case Aim(float() | int() as bearing_deg, None) if self._axis is Axis.ELEVATION:
                order = Aim(None, bearing_deg - 360 if bearing_deg >= BELOW_DEG else bearing_deg)
            case Stop():
                order = Stop((self._axis,))
        return self._box.order(order)
