"""Builds the simulated station that a file describes: rotor, display, sensors, panel and limit switches.

Part of the composition root. Knows which key of the file is which property of a simulated part. Knows no driver. The
rotors themselves are in `rotator.assembly.kinds`.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

from firmware_sim.panel import PanelSpec
from firmware_sim.parts.mount import MountSpec
from firmware_sim.rotors.rotor import ENCODERS, LcdSpec, SimRotor
from hw.chips.hd44780 import BACKLIGHT_ACTIVE_LOW, BACKPACKS
from hw.ports import Axis
from rotator.assembly.adc import simulate_adc
from rotator.assembly.kinds import builder
from rotator.assembly.settings import build_offsets
from rotator.assembly.simulated_axes import SimulatedAxes
from rotator.config.chips import KERNEL_SELECTS
from rotator.config.model import Config
from rotator.config.sensors import COMPASSES, TILTS
from rotator.exchange.foreign import json_of
from rotator.store.json_file import number
from rotator.store.whole import write_whole

LIMIT_BEYOND_DEG = 1.0
"""Degrees beyond the end of the range: there a limit switch opens, before the stop. The low one of an axis that counts
opens this far above `home_deg`."""
PLACE_FILE = "simulated-rotor.json"
"""Beside the state file."""
AUTO = 2
"""The position AUTO of the simulated mode switch: 2 × MSB + LSB."""


class SimulatedStation(SimulatedAxes):
    """The simulated station that the file describes."""

    def build(self) -> SimRotor:
        config = self.config
        rotor = builder(config.rotor.type).simulate(self)
        if self.kept:
            rotor.put_back(self.kept.parts)
        if (lcd := _lcd(config)) is not None:
            rotor.wire_lcd(lcd)
        self._wire_sensors(rotor)
        self._wire_panel(rotor)
        self._wire_limits(rotor)
        return rotor

    def _wire_sensors(self, rotor: SimRotor) -> None:
        config = self.config
        if config.uses_adc:
            added = [axis for axis in config.fitted if config.has_pot(axis) and axis.value not in rotor.wipers]
            rotor.wire_pots({axis.value: self.pot(axis) for axis in added}, config.adc.supply_v)
            simulate_adc(config, rotor, self.clock)
        for axis in config.fitted:
            sensor = config.axis(axis).sensor
            match sensor.kind, sensor.i2c:
                case kind, (number, address) if kind in TILTS:
                    rotor.wire_tilt(kind, (number, address), _mounted(sensor.forward, sensor.up))
                case kind, (number, address) if kind in COMPASSES:
                    rotor.wire_compass(kind, (number, address), _mounted(sensor.forward, sensor.up))
                case kind, i2c if kind in ENCODERS:
                    rotor.wire_encoder(axis.value, kind, i2c or (0, KERNEL_SELECTS[sensor.select]))
        if config.compass.kind == "bno055":
            # The simulated mast stands where true and magnetic north are as far apart as the file says.
            turned_deg = config.azimuth.offset_deg - config.compass.offset_deg
            if config.mount.north == "true":
                turned_deg -= config.mount.declination_deg or 0.0
            compass = config.compass.bus, config.compass.address
            rotor.wire_bno055(compass, lambda azimuth_deg: azimuth_deg + turned_deg)

    def _wire_panel(self, rotor: SimRotor) -> None:
        """The front panel, with its mode switch on AUTO."""
        table = self.config.panel
        if not table.fitted:
            return
        wires: dict[str, Any] = {**table.switches, **table.inputs}
        spec = PanelSpec(
            **wires,
            lamps=table.lamps,
            meters=table.meters,
            adc_bus=table.adc_bus,
            adc_address=table.adc_address,
            outputs_bus=table.outputs_bus,
            outputs_address=table.outputs_address,
            supply_v=table.supply_v,
            meter_full_share=table.meter_full_scale,
            reference=table.reference,
        )
        rotor.wire_panel(spec).turn_mode(AUTO)

    def _wire_limits(self, rotor: SimRotor) -> None:
        """The switches at the ends of the travel."""
        config = self.config
        for key, pin in config.limits.switches.items():
            name, end = key.split("_")
            limits = config.axis(Axis(name))
            at_deg = limits.min_deg - LIMIT_BEYOND_DEG if end == "low" else limits.max_deg + LIMIT_BEYOND_DEG
            if end == "low" and (stop := config.end_stop(Axis(name))):
                at_deg = stop.home_deg + LIMIT_BEYOND_DEG
            elif end == "low" and config.rotor.type == "h-bridge" and config.kind.homes(Axis(name)):
                at_deg = config.bridge.of(Axis(name)).home_deg
            rotor.wire_limit(key, pin, name, at_deg, high=end == "high")


def simulated_boom(config: Config) -> Callable[[float, float], tuple[float, float]]:
    """Where the simulated boom truly points, with the axes at these angles on the rotor's own scale.

    On a mount without errors it is the axes' own angles, with the file's offsets: on their turn, and over the top.
    """
    shift, terms = build_offsets(config), config.sim.mount.model_dump()
    spec = MountSpec(**terms)

    def direction(azimuth_deg: float, elevation_deg: float) -> tuple[float, float]:
        azimuth_deg, elevation_deg = azimuth_deg + shift.azimuth_deg, elevation_deg + shift.elevation_deg
        return spec.direction(azimuth_deg, elevation_deg) if any(terms.values()) else (azimuth_deg, elevation_deg)

    return direction


def kept_place(path: Path) -> tuple[float, float]:
    """Azimuth and elevation where the last run has left a simulated rotor; 0 and 0: not known."""
    try:
        azimuth, elevation = json_of(path.read_text(encoding="utf-8"))
        return number(azimuth, "azimuth", -3.6e9, 3.6e9), number(elevation, "elevation", -360, 720)
    except (OSError, ValueError, TypeError):
        return 0.0, 0.0


def keep_place(path: Path, rotor: SimRotor) -> None:
    with suppress(OSError):
        write_whole(path, json.dumps([round(angle_deg, 2) for angle_deg in rotor.rests()]))


def _mounted(forward: str, up: str) -> Callable[..., tuple[float, float, float]]:
    """What each of a board's axes feels, mounted so, from what there is along the boom, across it, and to its left."""

    def arrow(name: str) -> tuple[float, float, float]:
        x, y, z = (((name[1] == axis) * (1.0 if name[0] == "+" else -1.0)) for axis in "xyz")
        return x, y, z

    (ax, ay, az), (ux, uy, uz) = arrow(forward), arrow(up)
    left = uy * az - uz * ay, uz * ax - ux * az, ux * ay - uy * ax

    def board(along: float, across: float, to_left: float = 0.0) -> tuple[float, float, float]:
        parts = zip((ax, ay, az), (ux, uy, uz), left, strict=True)
        x, y, z = (ahead * along + upward * across + leftward * to_left for ahead, upward, leftward in parts)
        return x, y, z

    return board


def _lcd(config: Config) -> LcdSpec | None:
    lcd = config.lcd
    match lcd.kind:
        case "gpio":
            return LcdSpec(lcd.lines)
        case "pcf8574":
            active_high = lcd.backpack not in BACKLIGHT_ACTIVE_LOW
            return LcdSpec(BACKPACKS[lcd.backpack], lcd.address, active_high, lcd.bus)
        case _:
            return None
