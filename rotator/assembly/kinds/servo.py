"""Builds the kind servo: two hobby servos on a PCA9685, real or simulated.

Part of the composition root: names drivers and simulated parts, and passes them the keys of [servo]. Decides nothing.
"""

from __future__ import annotations

from firmware_sim.parts.servo import SimServoSpec
from firmware_sim.rotors.servo import ServoAxisSpec, SimServoRotor
from hw.chips.pca9685 import Pca9685
from hw.drives.servo import ENABLE, ServoDrive
from hw.drives.servo_axis import ServoSpec
from hw.ports import Axis, OutputLines
from rotator.assembly.rotors import Assembly
from rotator.assembly.simulated_axes import SimulatedAxes
from rotator.rotors.servos import ServoRotor


def build(parts: Assembly, lines: OutputLines | None) -> ServoRotor:
    tables, board = parts.config.servo, parts.board

    def spec(axis: Axis) -> ServoSpec:
        table = tables.of(axis)
        # Where no file keeps the last angle, the first pulse is the file's: also in a simulation, wherever it began.
        first_deg = parts.first_deg(axis, table.start_deg) if parts.config.keeps_files else table.start_deg
        return ServoSpec(table.channel, tuple(table.pulses_us), first_deg, table.slew_dps)

    enable = None
    if tables.enable is not None:
        enable = board.outputs("rotator-servo", {ENABLE: tables.enable}, active_low=True)
    drive = ServoDrive(
        Pca9685(board.bus(tables.bus), tables.address, board.sleep, osc_hz=tables.osc_hz),
        *parts.config.of_each(spec),
        board.clock,
        enable=enable,
        idle_off_s=tables.idle_off_s or None,
    )
    sensors = parts.sensors({axis: drive.sensor(axis) for axis in parts.config.fitted})
    return ServoRotor(drive, sensors, parts.shift, parts.ends)


def simulate(axes: SimulatedAxes) -> SimServoRotor:
    tables = axes.config.servo

    def spec(axis: Axis) -> ServoAxisSpec:
        table = tables.of(axis)
        (low_deg, low_us), (high_deg, high_us) = min(table.pulses_us), max(table.pulses_us)
        servo = SimServoSpec(low_us, high_us, low_deg, high_deg - low_deg, axes.sim(axis).speed_dps)
        return ServoAxisSpec(table.channel, axes.start_deg(axis), servo)

    return SimServoRotor(
        spec(Axis.AZIMUTH),
        spec(Axis.ELEVATION),
        axes.clock,
        axes.bus_sleep,
        place=(tables.bus, tables.address),
        enable_pin=tables.enable,
        osc_hz=tables.osc_hz,
    )
