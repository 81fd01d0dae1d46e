"""What a calibration needs of the configured rotor: its traits, its compass, a controller for an axis not yet set up.

Part of the composition root. How kinds of rotor differ during a calibration is in `rotator.config.kinds`. Does not know
the questions that the operator is asked.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from hw.ports import Axis, Compass, HardwareError
from rotator.assembly.buses import Board
from rotator.assembly.sensors import compass_chip
from rotator.assembly.settings import build_controller, build_offsets
from rotator.config.model import Config
from rotator.control.controller import Controller
from rotator.exchange.motor import Trusts
from rotator.exchange.status import Latch
from rotator.store.learnt import Motors

SCALES_DEG = {Axis.AZIMUTH: (-360.0, 720.0), Axis.ELEVATION: (-90.0, 210.0)}
"""The angles of an axis that the configuration file accepts."""
SETTLE_S = 2.0
"""A motor that goes to an angle by itself still moves for 1.5 s: it brakes from 30°/s at 20°/s²."""


@dataclass(frozen=True, slots=True)
class CalibrationTraits:
    """How this kind of rotor behaves while an axis is set up."""

    reach_deg: tuple[float, float]
    """Where the limits of the axis can be, on the rotor's own scale."""
    shift_deg: float
    """Added to the rotor's own scale this gives the angle that the box reports."""
    homes: bool
    """The axis counts from its end stop."""
    timed: bool
    """Nothing comes back: the times from stop to stop are what it is reckoned by."""
    settle_s: float
    first_press: str
    """What the operator must expect of the first press; empty: nothing unusual."""
    reversal: str
    """The repair for an antenna that turns the wrong way; empty: exchange the two relays."""
    endless: bool = False
    """The axis has no ends, and so no limits."""


def calibration_traits(config: Config, axis: Axis) -> CalibrationTraits:
    return CalibrationTraits(
        reach_deg=_reach_deg(config, axis),
        shift_deg=build_offsets(config).deg(axis),
        homes=config.end_stop(axis) is not None,
        timed=config.speeds_dps(axis) is not None,
        settle_s=0.0 if config.rotor.switched else SETTLE_S,
        first_press=config.kind.first_move(axis),
        reversal=config.kind.reversal(axis),
        endless=config.endless(axis),
    )


def calibration_controller(
    config: Config,
    axis: Axis,
    learnt: Mapping[Axis, Motors] | None = None,
    trusts: Mapping[Axis, Trusts] | None = None,
    latch: Latch | None = None,
) -> Controller:
    """A controller that treats `axis` as never set up: it obeys jog only, 2 s a press.

    The other arguments: as in `build_controller`.
    """
    return build_controller(_without_limits(config, axis), learnt, commissioning=axis, trusts=trusts, latch=latch)


def guided_controller(config: Config) -> Controller:
    """A controller of the whole box, which a guide leads: an idle antenna does not park meanwhile."""
    mount = config.mount.model_copy(update={"park_after_s": 0.0})
    return build_controller(config.model_copy(update={"mount": mount}))


def open_compass(config: Config, board: Board) -> Compass:
    """Raises HardwareError where the file has no compass. A chip that is missing shows only when it is read."""
    table = config.compass
    if table.kind == "none":
        raise HardwareError(
            'the file has no compass: fit a BNO055 to the boom and write [compass] kind = "bno055" '
            "(rotator help sensors)"
        )
    return compass_chip(table, board.bus(table.bus), board.clock, board.sleep)


def _reach_deg(config: Config, axis: Axis) -> tuple[float, float]:
    low_deg, high_deg = config.reach_deg(axis)
    lowest_deg, highest_deg = SCALES_DEG[axis]
    return lowest_deg if low_deg is None else low_deg, highest_deg if high_deg is None else high_deg


def _without_limits(config: Config, axis: Axis) -> Config:
    """A drive with its own angle control stops at its limits, and a calibration has yet to find the limits."""
    if config.rotor.switched:
        return config
    low_deg, high_deg = _reach_deg(config, axis)
    table = config.axis(axis).model_copy(update={"min_deg": low_deg, "max_deg": high_deg})
    return config.model_copy(update={axis.value: table})
