"""One axis on the bench: the control loop with its guard but without links, and the guide that leads through it.

Part of the composition root. Knows how the parts fit together; what is asked and what is believed is the guide's.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from hw.ports import Axis
from rotator.building import build_controller
from rotator.calibrating.answers import Answer
from rotator.calibrating.asking import Known
from rotator.calibrating.guide import Commissioned, Guide
from rotator.config.model import Config
from rotator.config.save import changed, save_axis
from rotator.loop import ControlLoop
from rotator.orders import Source
from rotator.station import Station

SCALES_DEG = {Axis.AZIMUTH: (-360.0, 720.0), Axis.ELEVATION: (-90.0, 210.0)}
"""What the file accepts as an angle of the axis."""


class Bench:
    """The axis, taken for one that nobody has set up: it obeys jog only, 2 s a press."""

    def __init__(self, config: Config, axis: Axis, station: Station, clock: Callable[[], float]) -> None:
        controller = build_controller(config, commissioning=axis)
        self.loop = ControlLoop(
            controller,
            station.rotor,
            clock,
            1 / config.control.rate_hz,
            after_good_step=station.beat,
        )
        table = config.azimuth if axis is Axis.AZIMUTH else config.elevation
        self.guide = Guide(
            Known(
                axis,
                table.min_deg,
                table.max_deg,
                table.lowest_reading,
                table.highest_reading,
                config.adc.supply_v,
                *SCALES_DEG[axis],
            )
        )

    def step(self, answer: Answer | None = None) -> tuple[str, ...]:
        """Show the guide how things stand, and what the person said; returns what it says to that."""
        turn = self.guide.step(self.loop.status, answer)
        for order in turn.orders:
            self.loop.post(Source("calibrate"), order)
        return turn.lines


def keep(done: Commissioned, path: Path) -> None:
    """Into the file, whole or not at all. Raises OSError or ConfigError."""
    save_axis(
        path,
        done.axis.value,
        calibration=done.points,
        min_deg=done.min_deg,
        max_deg=done.max_deg,
        direction_checked=True,
    )


def as_toml(done: Commissioned) -> str:
    """The same as text, for a person without a file."""
    return changed(
        "",
        done.axis.value,
        calibration=done.points,
        min_deg=done.min_deg,
        max_deg=done.max_deg,
        direction_checked=True,
    )
