"""`rotor.type = "relay-pot"`: motors on relays, a pot on a converter for each angle. The G-5500 is one.

Knows the lines of its table [relays], and the answers of this kind to the questions in `kind.py`. Knows no driver, and
not the converter: its table [adc] serves pots of every kind of rotor.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from hw.ports import AngleSource, Axis
from rotator.config.axes import AxisTable, BrakeTable, SpeedTable
from rotator.config.chips import I2CChip
from rotator.config.devices import Relays
from rotator.config.kinds.kind import Kind, OffLine
from rotator.config.sensors import Angle

CHANNEL_PINS_APART = 6
"""GPIO 12 and 18 are one channel of the hardware PWM, and so are 13 and 19."""


@dataclass(frozen=True, slots=True)
class RelayPot(Kind):
    relays: Relays
    brakes: Mapping[Axis, BrakeTable]
    """The brake of each axis that has one."""
    speeds: Mapping[Axis, SpeedTable]
    """The speed output of each axis that has one."""

    switched = True
    own = Angle(AngleSource.MEASURED, in_degrees=False, pot=True)

    def pins(self) -> list[tuple[int, str]]:
        outputs = [(pin, f"relays.{key}") for key, pin in self.relays.outputs.items()]
        speeds = [(each.pwm, f"{axis.value}.speed.pwm") for axis, each in self.speeds.items() if each.output == "pwm"]
        return outputs + [(line.pin, line.key) for line in self._brake_lines()] + speeds

    def chips(self) -> list[I2CChip]:
        return [chip for axis, speed in self.speeds.items() for chip in speed.chips(f"{axis.value}.speed.address")]

    def faults(self, axes: Mapping[Axis, AxisTable]) -> Iterable[str]:
        for axis, speed in self.speeds.items():
            if speed.lowest_dps >= axes[axis].speed_dps:
                yield (
                    f"{axis.value}.speed.lowest_dps ({speed.lowest_dps:g}) must be below the full speed, "
                    f"{axis.value}.speed_dps ({axes[axis].speed_dps:g})"
                )
        used = sorted(speed.pwm for speed in self.speeds.values() if speed.output == "pwm")
        if len(used) > 1 and used[1] - used[0] == CHANNEL_PINS_APART:
            yield f"GPIO {used[0]} and {used[1]} are one channel of the PWM: take 18 and 19, or 12 and 13"

    def off_lines(self) -> tuple[OffLine, ...]:
        """The relays, the master, the brakes, and the heartbeat, which is off when it stands still, at either level."""
        relays, off_high = self.relays, self.relays.active == "low"
        lines = [OffLine(key, f"relays.{key}", pin, off_high) for key, pin in relays.contacts.items()]
        lines += self._brake_lines()
        if relays.heartbeat is not None:
            lines.append(OffLine("heartbeat", "relays.heartbeat", relays.heartbeat, switches=False))
        return tuple(lines)

    def _brake_lines(self) -> list[OffLine]:
        off_high = self.relays.active == "low"
        return [
            OffLine(f"{axis.value}_brake", f"{axis.value}.brake.line", brake.line, off_high)
            for axis, brake in self.brakes.items()
            if brake.line is not None
        ]
