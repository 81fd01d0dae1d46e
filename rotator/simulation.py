"""From a configuration to the simulated station: the other half of the composition root.

Knows which key of the file is which property of the simulated rotor. Knows no driver.
"""

from __future__ import annotations

from collections.abc import Callable

from firmware_sim.arduino.station import ArduinoStation
from firmware_sim.motor import MotorSpec
from firmware_sim.pot import PotSpec
from firmware_sim.world import AxisSpec, LcdSpec, World, WorldSpec
from hw.hd44780 import BACKLIGHT_ACTIVE_LOW, BACKPACKS
from rotator.config.model import AxisTable, Config, SimAxisTable

SIM_CALIBRATION_RAW = (0.05, 0.95)
"""Where the simulated pot's wiper stands at the ends of the range: end resistors keep it off the rails."""
STOP_BEYOND_DEG = 2.0
"""The end stops stand a little beyond the range, as on a G-5500."""


def motor_spec(table: AxisTable, sim: SimAxisTable) -> MotorSpec:
    return MotorSpec(
        speed_dps=sim.speed_dps,
        lag_s=sim.lag_s,
        relay_delay_s=sim.relay_delay_s,
        backlash_deg=sim.backlash_deg,
        stop_low_deg=table.min_deg - STOP_BEYOND_DEG,
        stop_high_deg=table.max_deg + STOP_BEYOND_DEG,
    )


def simulated_world(
    config: Config,
    clock: Callable[[], float],
    bus_sleep: Callable[[float], None] | None,
    start_deg: tuple[float, float],
) -> World:
    """The station that the file describes; `start_deg` holds where the file does not say."""
    low_ratio, high_ratio = SIM_CALIBRATION_RAW

    def axis(table: AxisTable, sim: SimAxisTable, start_deg: float, pins: tuple[int, int], channel: int) -> AxisSpec:
        pot = PotSpec(
            table.min_deg, table.max_deg, low_ratio, high_ratio, noise_deg=sim.pot_noise_deg, bow_deg=sim.pot_bow_deg
        )
        start_deg = start_deg if sim.start_deg is None else sim.start_deg
        start_deg = min(max(start_deg, table.min_deg), table.max_deg)
        return AxisSpec(motor_spec(table, sim), pot, start_deg, *pins, channel)

    relays, adc = config.relays, config.adc
    cw_ccw, up_down = (relays.azimuth_cw, relays.azimuth_ccw), (relays.elevation_up, relays.elevation_down)
    return World(
        WorldSpec(
            azimuth=axis(config.azimuth, config.sim.azimuth, start_deg[0], cw_ccw, adc.azimuth_channel),
            elevation=axis(config.elevation, config.sim.elevation, start_deg[1], up_down, adc.elevation_channel),
            relays_active_low=relays.active == "low",
            master_pin=relays.master,
            adc_address=adc.address,
            reference_channel=adc.reference_channel,
            pot_supply_v=adc.supply_v,
            lcd=_lcd(config),
        ),
        clock,
        bus_sleep,
    )


def arduino_station(
    config: Config, clock: Callable[[], float], sleep: Callable[[float], None], start_deg: tuple[float, float]
) -> ArduinoStation:
    """The Arduino that the box replaces, with motors and ranges from the same file; its pots have no end resistors."""

    def pot(table: AxisTable, sim: SimAxisTable) -> PotSpec:
        return PotSpec(table.min_deg, table.max_deg, 0.0, 1.0, noise_deg=sim.pot_noise_deg, bow_deg=sim.pot_bow_deg)

    azimuth, elevation, sim = config.azimuth, config.elevation, config.sim
    return ArduinoStation(
        clock,
        sleep,
        motor_spec(azimuth, sim.azimuth),
        motor_spec(elevation, sim.elevation),
        azimuth_pot=pot(azimuth, sim.azimuth),
        elevation_pot=pot(elevation, sim.elevation),
        azimuth_start_deg=start_deg[0],
        elevation_start_deg=start_deg[1],
    )


def _lcd(config: Config) -> LcdSpec | None:
    lcd = config.lcd
    match lcd.kind:
        case "gpio":
            return LcdSpec(lcd.model_dump(include={"rs", "e", "d4", "d5", "d6", "d7"}))
        case "pcf8574":
            active_high = lcd.backpack not in BACKLIGHT_ACTIVE_LOW
            return LcdSpec(BACKPACKS[lcd.backpack], lcd.address, active_high)
        case _:
            return None
