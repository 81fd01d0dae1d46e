"""What a calibration needs of the configured rotor: how far an axis goes, its compass, a controller for one not set up.

Part of the composition root. How kinds of rotor differ during a calibration is in `rotator.config.kinds`. Does not know
the questions that the operator is asked.
"""

from __future__ import annotations

from collections.abc import Mapping

from hw.ports import Axis, Compass, HardwareError
from rotator.assembly.buses import Board
from rotator.assembly.sensors import compass_chip
from rotator.assembly.settings import build_controller
from rotator.config.model import Config
from rotator.control.controller import Controller
from rotator.exchange.motor import Trusts
from rotator.exchange.status import Latch
from rotator.store.learnt import Motors

SCALES_DEG = {Axis.AZIMUTH: (-360.0, 720.0), Axis.ELEVATION: (-90.0, 210.0)}
"""The angles of an axis that the configuration file accepts."""


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


def reach_deg(config: Config, axis: Axis) -> tuple[float, float]:
    """Where the limits of the axis can be, on the rotor's own scale."""
    low_deg, high_deg = config.reach_deg(axis)
    lowest_deg, highest_deg = SCALES_DEG[axis]
    return lowest_deg if low_deg is None else low_deg, highest_deg if high_deg is None else high_deg


def _without_limits(config: Config, axis: Axis) -> Config:
    """A drive with its own angle control stops at its limits, and a calibration has yet to find the limits."""
    if config.rotor.switched:
        return config
    low_deg, high_deg = reach_deg(config, axis)
    table = config.axis(axis).model_copy(update={"min_deg": low_deg, "max_deg": high_deg})
    return config.model_copy(update={axis.value: table})
