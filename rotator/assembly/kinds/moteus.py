"""Builds the kind moteus: two moteus controllers on CAN-FD, real or simulated.

Part of the composition root: names drivers and simulated parts, and passes them the keys of [moteus]. Decides nothing.
"""

from __future__ import annotations

import math
import tempfile
from collections.abc import Callable
from pathlib import Path

from firmware_sim.moteus.motor import MoteusSettings
from firmware_sim.rotors.moteus import MoteusAxisSpec, SimMoteusRotor
from hw.moteus.bus import MoteusBus
from hw.moteus.drive import MoteusDrive
from hw.moteus.library import CanChannel, SerialPort
from hw.moteus.orders import MoteusSpec
from hw.moteus.wire import MoteusInStep
from hw.ports import Axis, OutputLines
from rotator.assembly.rotors import Assembly
from rotator.assembly.simulated_axes import SimulatedAxes
from rotator.config.kinds.moteus import Moteus
from rotator.config.model import Config
from rotator.rotors.moteus import MoteusRotor

SIMULATED_GEAR = 10.0
"""Turns of the simulated motor for one turn of the antenna."""


def moteus_drive(config: Config, clock: Callable[[], float], *, look_only: bool = False) -> MoteusDrive:
    def spec(axis: Axis) -> MoteusSpec:
        table, limits = config.moteus.of(axis), config.axis(axis)
        return MoteusSpec(
            can_id=table.id,
            rev_per_turn=table.rev_per_turn,
            zero_rev=table.zero_rev,
            velocity_limit_dps=table.velocity_limit_dps,
            accel_limit_dps2=table.accel_limit_dps2,
            max_torque_nm=math.nan if table.max_torque_nm is None else table.max_torque_nm,
            geared=table.geared,
            min_deg=limits.min_deg,
            max_deg=limits.max_deg,
            endless=config.endless(axis),
        )

    return MoteusDrive(*config.of_each(spec), clock, look_only=look_only)


def moteus_bus(tables: Moteus, drive: MoteusDrive) -> MoteusBus:
    """The adapter that the file names, in real time."""
    return MoteusBus(drive, CanChannel(tables.can) if tables.can else SerialPort(tables.port))


def build(parts: Assembly, lines: OutputLines | None) -> MoteusRotor:
    drive = moteus_drive(parts.config, parts.board.clock)
    sensors = parts.sensors({axis: drive.sensor(axis) for axis in parts.config.fitted})
    return MoteusRotor(drive, _served(parts, drive), sensors, parts.shift, parts.ends)


def _served(parts: Assembly, drive: MoteusDrive) -> MoteusBus | MoteusInStep:
    world, opened = parts.board.world, parts.board.opened
    if world is None:
        return moteus_bus(parts.config.moteus, drive)
    assert isinstance(world, SimMoteusRotor)
    if parts.in_step:
        return MoteusInStep(drive, world.transport())
    folder = opened.enter_context(tempfile.TemporaryDirectory(prefix="rotator-"))
    adapter = world.adapter(Path(folder) / "fdcanusb")
    adapter.plug()
    opened.callback(adapter.unplug)
    return MoteusBus(drive, SerialPort(str(adapter.path)))


def simulate(axes: SimulatedAxes) -> SimMoteusRotor:
    def spec(axis: Axis) -> MoteusAxisSpec:
        table = axes.config.moteus.of(axis)
        settings = MoteusSettings(rotor_turns=SIMULATED_GEAR / abs(table.rev_per_turn) if table.geared else 1.0)
        return MoteusAxisSpec(table.id, axes.start_deg(axis), table.rev_per_turn, table.zero_rev, settings)

    return SimMoteusRotor(spec(Axis.AZIMUTH), spec(Axis.ELEVATION), axes.clock, axes.bus_sleep)
