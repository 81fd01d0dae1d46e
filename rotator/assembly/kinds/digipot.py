"""Builds the kind digipot: control boxes with an MCP41010 in place of each knob, real or simulated.

Part of the composition root: names drivers and simulated parts, and passes them the keys of [digipot]. Decides nothing.
"""

from __future__ import annotations

from firmware_sim.rotors.digipot import DigipotAxisSpec, SimDigipotRotor
from hw.chips.mcp41010 import STEPS, Mcp41010
from hw.drives.control_box import BoxSpec
from hw.drives.digipot import DigipotDrive
from hw.drives.positioned import DriveAngle
from hw.ports import AngleSensor, Axis, OutputLines
from rotator.assembly.rotors import Assembly
from rotator.assembly.settings import own_points
from rotator.assembly.simulated_axes import SimulatedAxes
from rotator.control.axis.calibration_table import Calibration
from rotator.control.axis.readings import ANYTHING, Window
from rotator.rotors.boxes import BoxRotor, FollowedBox


def build(parts: Assembly, lines: OutputLines | None) -> BoxRotor:
    config = parts.config
    (use,) = config.kind.spi_uses()
    spi = parts.board.spi(use)

    def box(axis: Axis) -> tuple[Mcp41010, BoxSpec]:
        table, limits = config.digipot.of(axis), config.axis(axis)
        spec = BoxSpec(
            tuple(table.steps),
            parts.first_deg(axis, table.start_deg),
            start_known=not config.keeps_files,
            speed_dps=limits.speed_dps,
            dead_band_deg=table.dead_band_deg,
            coast_deg=limits.speed_dps * limits.coast_s,
            range_deg=(limits.min_deg, limits.max_deg),
        )
        return Mcp41010(spi, f"{axis.value}.select"), spec

    drive = DigipotDrive(*config.of_each(box), parts.board.clock, enable=lines)
    sensors: dict[Axis, AngleSensor] = {}
    for axis, sensor in parts.sensors({axis: drive.sensor(axis) for axis in parts.config.fitted}).items():
        points = None if isinstance(sensor, DriveAngle) else own_points(config, axis)
        table = config.axis(axis)
        healthy = ANYTHING if config.in_degrees(axis) else Window(table.lowest_reading, table.highest_reading)
        sensors[axis] = FollowedBox(drive, axis, sensor, Calibration(points), healthy) if points else sensor
    return BoxRotor(drive, sensors, parts.shift, parts.ends)


def simulate(axes: SimulatedAxes) -> SimDigipotRotor:
    tables = axes.config.digipot

    def spec(axis: Axis) -> DigipotAxisSpec:
        table = tables.of(axis)
        (low_deg, low_step), (high_deg, high_step) = min(table.steps), max(table.steps)
        # The box compares with the end of its own pot, where the chip would be at its last step.
        full_deg = low_deg + (high_deg - low_deg) * (STEPS - low_step) / (high_step - low_step)
        full_deg *= axes.config.axis(axis).fitted
        return DigipotAxisSpec(table.select, axes.start_deg(axis), axes.motor(axis), full_deg, table.dead_band_deg)

    return SimDigipotRotor(
        spec(Axis.AZIMUTH),
        spec(Axis.ELEVATION),
        axes.clock,
        axes.bus_sleep,
        sck_pin=tables.sck,
        si_pin=tables.si,
        enable_pin=tables.enable,
    )
