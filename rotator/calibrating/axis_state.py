"""What the guides need to know about an axis from its status: is its angle known, did it turn the wrong way.

The only place in this package that compares kinds of faults.
"""

from __future__ import annotations

from rotator.exchange.faults import FaultKind, Missing
from rotator.exchange.status import AxisStatus


def position_unknown(axis: AxisStatus) -> bool:
    """A controller behind a gear does not know its angle after power-on."""
    return axis.fault is not None and axis.fault.kind is FaultKind.POSITION_UNKNOWN


def turned_the_wrong_way(axis: AxisStatus) -> bool:
    """The reading moved against the motor. This fault stops the axis before the press is over."""
    return axis.fault is not None and axis.fault.kind is FaultKind.WRONG_WAY


def needs_homing(axis: AxisStatus) -> bool:
    """The axis counts pulses and its count is not known."""
    return Missing.HOMING in axis.missing
