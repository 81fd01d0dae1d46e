"""Builds the kind stepper: two steppers on TMC5160 or TMC5130 chips, real or simulated.

Part of the composition root: names drivers and simulated parts, and passes them the keys of [stepper]. Decides nothing.
"""

from __future__ import annotations

from firmware_sim.parts.stepper import StepperMotorSpec
from firmware_sim.rotors.stepper import SimStepperRotor, StepperAxisSpec
from hw.chips.tmc5160 import Model
from hw.drives.stepper import ENABLE, StepperDrive
from hw.drives.stepper_axis import Home, StepperSpec
from hw.ports import Axis, OutputLines
from rotator.assembly.rotors import Assembly
from rotator.assembly.simulated_axes import STOP_BEYOND_DEG, SimulatedAxes
from rotator.config.chips import KERNEL_SELECTS
from rotator.config.model import Config
from rotator.rotors.stepper import StepperRotor


def build(parts: Assembly, lines: OutputLines | None) -> StepperRotor:
    config, board = parts.config, parts.board
    tables = config.stepper
    if lines is None and tables.enable is not None:
        lines = board.outputs("rotator-stepper", {ENABLE: tables.enable}, active_low=True)
    specs = {axis: _spec(config, axis) for axis in config.fitted}
    (use,) = config.kind.spi_uses()
    drive = StepperDrive(board.spi(use), specs, board.clock, lines, parts.watch if tables.enable is not None else None)
    writer, kept = parts.kept_counts(config.fitted)
    return StepperRotor(
        drive,
        parts.sensors({axis: drive.sensor(axis) for axis in config.fitted}),
        parts.shift,
        parts.ends,
        kept=kept,
        homes=[axis for axis in config.fitted if config.kind.homes(axis)],
        clock=board.clock,
        writer=writer,
    )


def _spec(config: Config, axis: Axis) -> StepperSpec:
    tables, table, limits = config.stepper, config.stepper.of(axis), config.axis(axis)
    return StepperSpec(
        select=f"{axis.value}.select",
        model=Model[tables.chip.upper()],
        gear=table.gear,
        speed_dps=limits.speed_dps,
        accel_dps2=table.accel_dps2,
        run_a=table.run_a,
        rest_share=table.rest_share,
        sense_ohm=table.sense_ohm,
        middle_deg=(limits.min_deg + limits.max_deg) / 2.0,
        span_deg=limits.max_deg - min(limits.min_deg, table.home_deg),
        steps_per_turn=table.steps_per_turn,
        clock_hz=tables.clock_hz,
        encoder=table.encoder,
        home=Home(table.home),
        home_deg=table.home_deg,
        home_dps=table.home_dps,
        stall=table.stall,
        self_locking=tables.self_locking,
    )


def simulate(axes: SimulatedAxes) -> SimStepperRotor:
    tables = axes.config.stepper

    def spec(axis: Axis) -> StepperAxisSpec:
        table, limits = tables.of(axis), axes.config.axis(axis)
        low_deg = limits.min_deg - STOP_BEYOND_DEG if table.home == "none" else table.home_deg
        motor = StepperMotorSpec(
            axes.start_deg(axis),
            table.gear,
            table.steps_per_turn,
            low_deg - (STOP_BEYOND_DEG if table.home == "switch" else 0.0),
            limits.max_deg + STOP_BEYOND_DEG,
            table.encoder,
            tables.self_locking,
        )
        switch_deg = table.home_deg if table.home == "switch" else None
        return StepperAxisSpec(KERNEL_SELECTS[table.select], tables.chip, tables.clock_hz, switch_deg, motor)

    return SimStepperRotor(
        spec(Axis.AZIMUTH), spec(Axis.ELEVATION), axes.clock, axes.bus_sleep, enable_pin=tables.enable
    )
