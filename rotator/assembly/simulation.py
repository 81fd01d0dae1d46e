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

from firmware_sim import world_file
from firmware_sim.panel import PanelSpec
from firmware_sim.parts.mount import MountSpec
from firmware_sim.rotors.rotor import LcdSpec, SimRotor
from firmware_sim.world_file import WorldState
from hw.chips.hd44780 import BACKLIGHT_ACTIVE_LOW, BACKPACKS
from hw.ports import Axis, HardwareError
from rotator.assembly.adc import simulate_adc
from rotator.assembly.kinds import builder
from rotator.assembly.settings import build_offsets
from rotator.assembly.simulated_axes import SimulatedAxes
from rotator.config.model import Config
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


class SimulatedStation:
    """The simulated station that the file describes. `start_deg`: azimuth and elevation where the file names none."""

    def __init__(
        self,
        config: Config,
        clock: Callable[[], float],
        bus_sleep: Callable[[float], None] | None,
        start_deg: tuple[float, float],
    ) -> None:
        self._config = config
        self._kept = kept_world(config)
        rests_deg = self._kept.rests_deg if self._kept else None
        self._axes = SimulatedAxes(config, clock, bus_sleep, start_deg, rests_deg)

    def build(self) -> SimRotor:
        config = self._config
        rotor = builder(config.rotor.type).simulate(self._axes)
        if self._kept:
            rotor.put_back(self._kept.parts)
        if (lcd := _lcd(config)) is not None:
            rotor.wire_lcd(lcd)
        self._wire_sensors(rotor)
        self._wire_panel(rotor)
        self._wire_limits(rotor)
        return rotor

    def start_deg(self, axis: Axis) -> float:
        """The start angle, on the rotor's own scale."""
        return self._axes.start_deg(axis)

    def _wire_sensors(self, rotor: SimRotor) -> None:
        config = self._config
        if config.uses_adc:
            added = [axis for axis in Axis if config.has_pot(axis) and axis.value not in rotor.wipers]
            rotor.wire_pots({axis.value: self._axes.pot(axis) for axis in added}, config.adc.supply_v)
            simulate_adc(config, rotor, self._axes.clock)
        for axis in Axis:
            sensor = config.axis(axis).sensor
            match sensor.kind, sensor.i2c:
                case "as5600", (_, address):
                    rotor.wire_as5600(axis.value, address)
                case "mpu6050", (_, address):
                    rotor.wire_mpu6050(address, _mounted(sensor.forward, sensor.up))
        if config.compass.kind == "bno055":
            # The simulated mast stands where true and magnetic north are as far apart as the file says.
            turned_deg = config.azimuth.offset_deg - config.compass.offset_deg
            if config.mount.north == "true":
                turned_deg -= config.mount.declination_deg or 0.0
            rotor.wire_bno055(config.compass.address, lambda azimuth_deg: azimuth_deg + turned_deg)

    def _wire_panel(self, rotor: SimRotor) -> None:
        """The front panel, with its mode switch on AUTO."""
        table = self._config.panel
        if not table.fitted:
            return
        wires: dict[str, Any] = {**table.switches, **table.inputs}
        spec = PanelSpec(
            **wires,
            lamps=table.lamps,
            meters=table.meters,
            adc_address=table.adc_address,
            outputs_address=table.outputs_address,
            supply_v=table.supply_v,
            meter_full_share=table.meter_full_scale,
            reference=table.reference,
        )
        rotor.wire_panel(spec).turn_mode(AUTO)

    def _wire_limits(self, rotor: SimRotor) -> None:
        """The switches at the ends of the travel."""
        config = self._config
        for key, pin in config.limits.switches.items():
            name, end = key.split("_")
            limits = config.axis(Axis(name))
            at_deg = limits.min_deg - LIMIT_BEYOND_DEG if end == "low" else limits.max_deg + LIMIT_BEYOND_DEG
            if end == "low" and (stop := config.end_stop(Axis(name))):
                at_deg = stop.home_deg + LIMIT_BEYOND_DEG
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


def kept_world(config: Config) -> WorldState | None:
    """The simulated world as the last run left it; None: it begins anew. Raises HardwareError for a damaged file."""
    if config.rotor.hardware != "sim" or config.sim.world is None:
        return None
    try:
        return world_file.read(Path(config.sim.world))
    except (OSError, ValueError) as fault:
        raise HardwareError(f"sim.world: {fault}; remove the file, then the simulation begins anew") from fault


def kept_place(path: Path) -> tuple[float, float]:
    """Azimuth and elevation where the last run has left a simulated rotor; 0 and 0: not known."""
    try:
        azimuth, elevation = json_of(path.read_text(encoding="utf-8"))
        return number(azimuth, "azimuth", -360, 720), number(elevation, "elevation", -360, 720)
    except (OSError, ValueError, TypeError):
        return 0.0, 0.0


def keep_place(path: Path, rotor: SimRotor) -> None:
    with suppress(OSError):
        write_whole(path, json.dumps([round(angle_deg, 2) for angle_deg in rotor.rests()]))


def simulated_rotor(
    config: Config,
    clock: Callable[[], float],
    bus_sleep: Callable[[float], None] | None,
    start_deg: tuple[float, float],
) -> SimRotor:
    """The rotor that the file describes. `start_deg`: the start angles where the file has none."""
    return SimulatedStation(config, clock, bus_sleep, start_deg).build()


def _mounted(forward: str, up: str) -> Callable[[float, float], tuple[float, float, float]]:
    """The gravity on each of a board's axes, mounted so, from the gravity along the boom and across it."""

    def board_g(along_g: float, across_g: float) -> tuple[float, float, float]:
        felt = dict.fromkeys("xyz", 0.0)
        for arrow, part_g in ((forward, along_g), (up, across_g)):
            felt[arrow[1]] = part_g if arrow[0] == "+" else -part_g
        return felt["x"], felt["y"], felt["z"]

    return board_g


def _lcd(config: Config) -> LcdSpec | None:
    lcd = config.lcd
    match lcd.kind:
        case "gpio":
            return LcdSpec(lcd.lines)
        case "pcf8574":
            active_high = lcd.backpack not in BACKLIGHT_ACTIVE_LOW
            return LcdSpec(BACKPACKS[lcd.backpack], lcd.address, active_high)
        case _:
            return None
