"""From a configuration to the simulated rotor: the other half of the composition root.

Knows which key of the file is which property of the simulated rotor. Knows no driver.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from firmware_sim.arduino.station import ArduinoStation
from firmware_sim.panel import PanelSpec
from firmware_sim.parts.contact import ContactSpec
from firmware_sim.parts.motor import MotorSpec
from firmware_sim.parts.pot import PotSpec
from firmware_sim.parts.servo import SimServoSpec
from firmware_sim.rotors.digipot import DigipotAxisSpec, SimDigipotRotor
from firmware_sim.rotors.moteus import MoteusAxisSpec, SimMoteusRotor
from firmware_sim.rotors.relay_pot import RelayPotAxisSpec, RelayPotSpec, SimRelayPotRotor
from firmware_sim.rotors.relay_pulse import RelayPulseAxisSpec, SimRelayPulseRotor
from firmware_sim.rotors.rotor import LcdSpec, SimRotor
from firmware_sim.rotors.servo import ServoAxisSpec, SimServoRotor
from hw.chips.hd44780 import BACKLIGHT_ACTIVE_LOW, BACKPACKS
from hw.ports import Axis
from rotator.config.axes import AxisTable
from rotator.config.model import Config
from rotator.config.sim import SimAxisTable

SIM_CALIBRATION_RAW = (0.05, 0.95)
"""Where the simulated pot's wiper stands at the ends of the range: end resistors keep it off the rails."""
STOP_BEYOND_DEG = 2.0
"""The end stops stand a little beyond the range, as on a G-5500."""
LIMIT_BEYOND_DEG = 1.0
"""A limit switch opens between the end of the range and the stop."""
SIM_BOUNCE_S = 0.005
AUTO = 2
"""The simulated panel's mode switch, as it counts its bits."""


class Plan:
    """The simulated rotor that the file describes; `start_deg` holds where the file does not say."""

    def __init__(
        self,
        config: Config,
        clock: Callable[[], float],
        bus_sleep: Callable[[float], None] | None,
        start_deg: tuple[float, float],
    ) -> None:
        self._config = config
        self._clock = clock
        self._sleep = bus_sleep
        self._starts = {Axis.AZIMUTH: start_deg[0], Axis.ELEVATION: start_deg[1]}

    def build(self) -> SimRotor:
        config = self._config
        match config.rotor.type:
            case "relay-pot":
                rotor: SimRotor = self._relay_pot()
            case "relay-pulse":
                rotor = self._relay_pulse()
            case "moteus":
                rotor = self._moteus()
            case "servo":
                rotor = self._servo()
            case "digipot":
                rotor = self._digipot()
        if (lcd := _lcd(config)) is not None:
            rotor.wire_lcd(lcd)
        self._wire_sensors(rotor)
        self._wire_person(rotor)
        return rotor

    def start_deg(self, axis: Axis) -> float:
        """Where the axis stands at first, on the rotor's own scale."""
        table, said = self._config.axis(axis), self._sim(axis).start_deg
        return min(max(self._starts[axis] if said is None else said, table.min_deg), table.max_deg)

    def _sim(self, axis: Axis) -> SimAxisTable:
        return self._config.sim.azimuth if axis is Axis.AZIMUTH else self._config.sim.elevation

    def _motor(self, axis: Axis) -> MotorSpec:
        return motor_spec(self._config.axis(axis), self._sim(axis))

    def _pins(self, axis: Axis) -> tuple[int, int]:
        relays = self._config.relays
        if axis is Axis.AZIMUTH:
            return relays.azimuth_cw, relays.azimuth_ccw
        return relays.elevation_up, relays.elevation_down

    def _pot(self, axis: Axis) -> PotSpec:
        table, sim = self._config.axis(axis), self._sim(axis)
        return PotSpec(
            table.min_deg,
            table.max_deg,
            *SIM_CALIBRATION_RAW,
            noise_deg=sim.pot_noise_deg,
            bow_deg=sim.pot_bow_deg,
        )

    def _channel(self, axis: Axis) -> int:
        adc = self._config.adc
        return adc.azimuth_channel if axis is Axis.AZIMUTH else adc.elevation_channel

    def _relay_pot(self) -> SimRelayPotRotor:
        def axis(which: Axis) -> RelayPotAxisSpec:
            return RelayPotAxisSpec(
                self._motor(which), self._pot(which), self.start_deg(which), *self._pins(which), self._channel(which)
            )

        relays, adc = self._config.relays, self._config.adc
        return SimRelayPotRotor(
            RelayPotSpec(
                azimuth=axis(Axis.AZIMUTH),
                elevation=axis(Axis.ELEVATION),
                relays_active_low=relays.active == "low",
                master_pin=relays.master,
                adc_address=adc.address,
                reference_channel=adc.reference_channel,
                pot_supply_v=adc.supply_v,
            ),
            self._clock,
            self._sleep,
        )

    def _relay_pulse(self) -> SimRelayPulseRotor:
        def axis(which: Axis) -> RelayPulseAxisSpec:
            table, limits = getattr(self._config.pulses, which.value), self._config.axis(which)
            motor = motor_spec(limits, self._sim(which), stop_low_deg=table.home_deg)
            cam = ContactSpec(table.spacing_deg, table.closed_deg, table.closes_at_deg, table.play_deg, SIM_BOUNCE_S)
            return RelayPulseAxisSpec(*self._pins(which), table.contact, motor, cam, self.start_deg(which))

        return SimRelayPulseRotor(
            axis(Axis.AZIMUTH),
            axis(Axis.ELEVATION),
            self._clock,
            self._sleep,
            relays_active_low=self._config.relays.active == "low",
            contacts_active_low=self._config.pulses.active == "low",
            master_pin=self._config.relays.master,
        )

    def _moteus(self) -> SimMoteusRotor:
        def axis(which: Axis) -> MoteusAxisSpec:
            table = getattr(self._config.moteus, which.value)
            return MoteusAxisSpec(table.id, self.start_deg(which), table.rev_per_turn, table.zero_rev)

        return SimMoteusRotor(axis(Axis.AZIMUTH), axis(Axis.ELEVATION), self._clock, self._sleep)

    def _servo(self) -> SimServoRotor:
        def axis(which: Axis) -> ServoAxisSpec:
            table = getattr(self._config.servo, which.value)
            return ServoAxisSpec(table.channel, self.start_deg(which), _servo(table.pulses_us, self._sim(which)))

        servo = self._config.servo
        return SimServoRotor(
            axis(Axis.AZIMUTH),
            axis(Axis.ELEVATION),
            self._clock,
            self._sleep,
            address=servo.address,
            enable_pin=servo.enable,
            osc_hz=servo.osc_hz,
        )

    def _digipot(self) -> SimDigipotRotor:
        def axis(which: Axis) -> DigipotAxisSpec:
            table = getattr(self._config.digipot, which.value)
            (low_deg, low_step), (high_deg, high_step) = min(table.steps), max(table.steps)
            # The box compares with the end of its own pot, where the chip would be at its last step.
            full_deg = low_deg + (high_deg - low_deg) * (256 - low_step) / (high_step - low_step)
            return DigipotAxisSpec(
                table.select, self.start_deg(which), self._motor(which), full_deg, table.dead_band_deg
            )

        digipot = self._config.digipot
        return SimDigipotRotor(
            axis(Axis.AZIMUTH),
            axis(Axis.ELEVATION),
            self._clock,
            self._sleep,
            sck_pin=digipot.sck,
            si_pin=digipot.si,
            enable_pin=digipot.enable,
        )

    def _wire_sensors(self, rotor: SimRotor) -> None:
        config = self._config
        if config.uses_adc and config.rotor.type != "relay-pot":
            pots = {axis.value: (self._channel(axis), self._pot(axis)) for axis in Axis if config.has_pot(axis)}
            rotor.wire_pots(config.adc.address, pots, config.adc.supply_v)
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

    def _wire_person(self, rotor: SimRotor) -> None:
        """What a person has at hand: the panel, with its switch on AUTO; and the switches at the ends of the travel."""
        config, table = self._config, self._config.panel
        if table.fitted:
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
        for key, pin in config.limits.switches.items():
            name, end = key.split("_")
            limits = config.axis(Axis(name))
            at_deg = limits.min_deg - LIMIT_BEYOND_DEG if end == "low" else limits.max_deg + LIMIT_BEYOND_DEG
            rotor.wire_limit(key, pin, name, at_deg, high=end == "high")


def simulated_rotor(
    config: Config,
    clock: Callable[[], float],
    bus_sleep: Callable[[float], None] | None,
    start_deg: tuple[float, float],
) -> SimRotor:
    """The rotor that the file describes; `start_deg` holds where the file does not say."""
    return Plan(config, clock, bus_sleep, start_deg).build()


def motor_spec(table: AxisTable, sim: SimAxisTable, stop_low_deg: float | None = None) -> MotorSpec:
    return MotorSpec(
        speed_dps=sim.speed_dps,
        lag_s=sim.lag_s,
        relay_delay_s=sim.relay_delay_s,
        backlash_deg=sim.backlash_deg,
        stop_low_deg=table.min_deg - STOP_BEYOND_DEG if stop_low_deg is None else stop_low_deg,
        stop_high_deg=table.max_deg + STOP_BEYOND_DEG,
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


def _servo(pulses_us: list[tuple[float, float]], sim: SimAxisTable) -> SimServoSpec:
    """A servo that turns as its table says."""
    (low_deg, low_us), (high_deg, high_us) = min(pulses_us), max(pulses_us)
    return SimServoSpec(low_us, high_us, low_deg, high_deg - low_deg, sim.speed_dps)


def _mounted(forward: str, up: str) -> Callable[[float, float], tuple[float, float, float]]:
    """What a board feels on each of its arrows, mounted so, given gravity along the boom and across it."""

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
            return LcdSpec(lcd.model_dump(include={"rs", "e", "d4", "d5", "d6", "d7"}))
        case "pcf8574":
            active_high = lcd.backpack not in BACKLIGHT_ACTIVE_LOW
            return LcdSpec(BACKPACKS[lcd.backpack], lcd.address, active_high)
        case _:
            return None
