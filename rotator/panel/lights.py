"""The panel's lamps and meters on the chip that drives them: what has changed is written, and a reset is noticed.

Knows the output of each lamp and meter, and what each shows now. Does not know why a lamp is lit.
"""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Protocol

from hw.ports import Axis, HardwareError
from rotator.panel.panel import PanelOutput

CHECK_S = 1.0
"""Seconds between two checks of the output chip for a reset."""
STEPS = 255
"""Steps of a meter. The needle shows no finer steps, and they would load the bus."""


class PanelOutputs(Protocol):
    """Outputs that are on for a share of the time, by number."""

    def start(self) -> None:
        """Set the outputs up from any state, all off. Raises HardwareError."""

    def check(self) -> None:
        """Raises HardwareError when the chip has lost its settings."""

    def duty(self, channel: int, share: float) -> None:
        """Switch one output on for this share of the time, 0 to 1. Raises HardwareError."""


@dataclass(frozen=True, slots=True)
class LightWiring:
    lamps: Mapping[str, int] = field(default_factory=dict)
    """The output of each lamp, by the lamp's name."""
    meters: Mapping[Axis, int] = field(default_factory=dict)
    meter_full_scale: float = 1.0
    """The share of the time that a meter's output is on at full scale."""


class Lights:
    def __init__(self, outputs: PanelOutputs, wiring: LightWiring) -> None:
        self._outputs = outputs
        self._wiring = wiring
        self._shown: dict[int, float] = {}
        self._started = False
        self._check_s = 0.0

    def show(self, now_s: float, wanted: PanelOutput) -> None:
        """Write what has changed. Raises HardwareError; then the next call sets the chip up again."""
        try:
            if not self._started:
                self._outputs.start()
                self._started, self._shown, self._check_s = True, {}, now_s + CHECK_S
            elif now_s >= self._check_s:
                self._outputs.check()
                self._check_s = now_s + CHECK_S
            for channel, share in self._shares(wanted).items():
                if self._shown.get(channel, 0.0) != share:
                    self._outputs.duty(channel, share)
                    self._shown[channel] = share
        except HardwareError:
            self._started = False
            raise

    def dark(self) -> None:
        """Switch each lamp and meter off. If the chip does not answer, they stay as they are."""
        if self._started or self._shown:
            with suppress(HardwareError):
                for channel in (*self._wiring.lamps.values(), *self._wiring.meters.values()):
                    self._outputs.duty(channel, 0.0)
            self._shown = {}

    def _shares(self, output: PanelOutput) -> dict[int, float]:
        """The share of each output channel."""
        meters, full = self._wiring.meters, self._wiring.meter_full_scale
        lamps = {channel: float(output.lamps[name]) for name, channel in self._wiring.lamps.items()}
        return lamps | {channel: round(output.meters[axis] * STEPS) / STEPS * full for axis, channel in meters.items()}
