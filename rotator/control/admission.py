"""Which orders are refused outright, so that the protocol can answer in its own words.

Knows the mount and the latest status. An admitted order may still have no effect, because a stop is latched or its
stream is silenced; it is answered like any other. The controller checks again, for the status may change meanwhile.
"""

from __future__ import annotations

from hw.ports import Axis, Direction
from rotator.control.refused import (
    is_not_fitted,
    measures_its_angle,
    no_homing,
    no_relay_in_doubt,
    turns_while_calibrated,
)
from rotator.control.sky.joining import joined, places
from rotator.control.sky.mount import Mount, Unreachable
from rotator.exchange.faults import Missing
from rotator.exchange.flight_order import Fly
from rotator.exchange.orders import (
    Aim,
    Calibrate,
    Confirm,
    Home,
    Jog,
    LoadTimed,
    Nudge,
    Order,
    Park,
    RelaysChecked,
    RunTimed,
)
from rotator.exchange.sources import Refusal
from rotator.exchange.status import Status

SENT_DEG = {Axis.AZIMUTH: (-180.0, 540.0), Axis.ELEVATION: (-90.0, 180.0)}
"""The angles that a program may send to any rotor, as in Hamlib; and those that the axis of its rotor has. The mount
knows which of them the rotor can reach."""
WIDEST_DEG = {Axis.AZIMUTH: (-360.0, 720.0), Axis.ELEVATION: (-90.0, 210.0)}
"""The widest ranges that a file may give the axes."""


def refusal(order: Order, status: Status, mount: Mount) -> Refusal | None:
    """Why `order` will not be obeyed, or None."""
    match order:
        case (
            Jog(axis, Direction.PLUS | Direction.MINUS)
            | Home(axis)
            | Calibrate(axis)
            | Confirm(axis)
            | RelaysChecked(axis)
            | Nudge(axis)
        ) if not status.axis(axis).fitted:
            return Refusal(is_not_fitted(axis.value))
        case Aim():
            stands = places(*((axis.target_deg, axis.angle_deg) for axis in (status.azimuth, status.elevation)))
            aim = joined(mount, order, (status.wanted_azimuth_deg, status.wanted_elevation_deg), stands)
            return _unable(order, status) or _unreachable(((aim.azimuth_deg, aim.elevation_deg),), mount)
        case LoadTimed(_, points):
            return _unable(order, status) or _unreachable(points, mount)
        case Park():
            return _unable(order, status) or _no_park(mount)
        case Fly():
            return _unable(order, status)
        case Jog(direction=Direction.PLUS | Direction.MINUS) | RunTimed():
            return _faulty(order, status)
        case Calibrate(axis) if status.moving:
            return Refusal(turns_while_calibrated(axis.value))
        case Home(axis) if not status.axis(axis).homeable:
            return Refusal(no_homing(axis.value, lost=Missing.HOMING in status.axis(axis).missing))
        case Confirm(axis) if not status.axis(axis).confirmable:
            return Refusal(measures_its_angle(axis.value))
        case Confirm(axis) if status.axis(axis).moving:
            return Refusal(f"{axis.value} turns: stop it (`rotator stop`), and look where it points when it stands")
        case RelaysChecked(axis) if status.axis(axis).moving:
            return Refusal(f"{axis.value} turns: its relays can be looked at when it stands; `rotator stop` stops it")
        case RelaysChecked(axis) if not status.axis(axis).relays_in_doubt:
            return Refusal(no_relay_in_doubt(axis.value))
        case _:
            return None


def _unable(order: Order, status: Status) -> Refusal | None:
    """The refusal of an order that needs an axis which cannot obey now: after `RPRT 0` a program would believe that the
    antenna follows. What stops is never refused, nor a storm park: what can go down goes down. A flight goes on where
    its fault ends."""
    match order:
        case Aim(engaged=False) | Park(storm=True) | Fly():
            return _uncalibrated(order, status, ())
        case Aim(_, elevation_deg) if elevation_deg:
            needed = _axes_of(order)
        case _:
            # A program that knows no elevation sends 0.
            needed = tuple(axis for axis in _axes_of(order) if axis is Axis.AZIMUTH)
    return _faulty(order, status) or _uncalibrated(order, status, needed)


def _faulty(order: Order, status: Status) -> Refusal | None:
    """The refusal of an order for an axis that a fault has stopped."""
    faults = [
        f"{axis.value} is stopped by a fault: {fault.name}"
        for axis in _axes_of(order)
        if (fault := status.axis(axis).fault)
    ]
    return Refusal("; ".join(faults), faulty=True) if faults else None


def _uncalibrated(order: Order, status: Status, needed: tuple[Axis, ...]) -> Refusal | None:
    """The refusal of an order where an axis that it needs, or each that it moves, is uncalibrated, or one has to be
    homed again. None: it is admitted."""
    axes = _axes_of(order)
    missing = {
        axis: f"{axis.value} needs {status.axis(axis).uncalibrated}"
        for axis in axes
        if status.axis(axis).missing and not status.axis(axis).homes_first
    }
    lacks = any(axis in needed or Missing.HOMING in status.axis(axis).missing for axis in missing)
    return Refusal("UNCALIBRATED: " + "; ".join(missing.values())) if lacks or len(missing) == len(axes) else None


def _axes_of(order: Order) -> tuple[Axis, ...]:
    """The axes that the order moves."""
    match order:
        case Aim(_, None) | RunTimed():
            return (Axis.AZIMUTH,)
        case Aim(None, _):
            return (Axis.ELEVATION,)
        case LoadTimed(_, points) if all(elevation_deg is None for _, elevation_deg in points):
            return (Axis.AZIMUTH,)
        case Aim() | Fly() | LoadTimed() | Park():
            return (Axis.AZIMUTH, Axis.ELEVATION)
        case Jog(axis):
            return (axis,)
        case _:
            return ()


def _no_park(mount: Mount) -> Refusal | None:
    try:
        mount.parked()
    except Unreachable as reason:
        return Refusal(f"the park position cannot be reached: {reason}", out_of_range=True)
    return None


def _unreachable(points: tuple[tuple[float | None, float | None], ...], mount: Mount) -> Refusal | None:
    try:
        for azimuth_deg, elevation_deg in points:
            for axis, angle_deg in ((Axis.AZIMUTH, azimuth_deg), (Axis.ELEVATION, elevation_deg)):
                own = mount.azimuth if axis is Axis.AZIMUTH else mount.elevation
                low_deg, high_deg = min(SENT_DEG[axis][0], own.min_deg), max(SENT_DEG[axis][1], own.max_deg)
                if angle_deg is not None and not low_deg <= angle_deg <= high_deg:
                    raise Unreachable(f"{axis.value} {angle_deg:g} is outside {low_deg:g} to {high_deg:g} degrees")
            if azimuth_deg is not None:
                mount.axis_angles(azimuth_deg, elevation_deg, azimuth_deg)
    except Unreachable as reason:
        return Refusal(str(reason), out_of_range=True)
    return None
