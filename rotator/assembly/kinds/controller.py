"""Builds the kind controller: ready-made controllers on serial ports or TCP, real or simulated.

Part of the composition root: names drivers and simulated parts, and passes them the keys of [controller]. Decides
nothing.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from firmware_sim.controllers.line import SimLine
from firmware_sim.rotors.controller import SimControllerRotor, SimControllerSpec
from hw.controllers.codecs import codec
from hw.controllers.course import Course, CourseSpec
from hw.controllers.drive import Connection, ControllerDrive
from hw.controllers.port import Port, SerialPort, TcpPort
from hw.controllers.unit import Pace, Unit
from hw.ports import Axis, OutputLines
from rotator.assembly.rotors import Assembly
from rotator.assembly.simulated_axes import SimulatedAxes
from rotator.config.kinds.controller import ControllerBox
from rotator.config.links import address
from rotator.config.model import Config
from rotator.control.axis.settings import NEAR_DEG
from rotator.rotors.controllers import ControllerRotor

SIM_BAUD = 9600


def build(parts: Assembly, lines: OutputLines | None) -> ControllerRotor:
    config, world = parts.config, parts.board.world
    assert world is None or isinstance(world, SimControllerRotor)
    connections = []
    for number, (axes, box) in enumerate(config.controller.boxes(config.fitted).items()):
        line = world.lines[number] if world else None
        connections.append(_connection(config, axes, box, line))
    drive = ControllerDrive(connections, parts.board.clock, in_step=parts.in_step)
    sensors = parts.sensors({axis: drive.sensor(axis) for axis in config.fitted})
    return ControllerRotor(drive, sensors, parts.shift, parts.ends, sleep=parts.board.sleep)


def controller_drive(config: Config, clock: Callable[[], float]) -> ControllerDrive:
    """The drive over the ports that the file names, in real time; nothing is open yet."""
    return ControllerDrive(
        [_connection(config, axes, box, None) for axes, box in config.controller.boxes(config.fitted).items()], clock
    )


def _connection(config: Config, axes: tuple[Axis, ...], box: ControllerBox, line: SimLine | None) -> Connection:
    table = config.controller
    pace = Pace(table.target_every_s, table.ask_every_s, table.answer_s)
    courses = {axis: Course(_course(config, axis, box)) for axis in axes}
    opens: Callable[[], Port]
    if line is not None:
        opens, place = line.open, "the simulated line"
    elif box.tcp:
        opens, place = partial(TcpPort, *address(box.tcp)), box.tcp
    else:
        assert box.serial is not None, "the file says where it is"
        opens, place = partial(SerialPort, box.serial, box.rate), f"{box.serial} at {box.rate} baud"
    unit = Unit(f"{box.protocol} at {place}", codec(box.protocol, axes), courses, pace)
    return Connection(unit, opens, line.due_s if line else lambda: None)


def _course(config: Config, axis: Axis, box: ControllerBox) -> CourseSpec:
    limits = config.axis(axis)
    return CourseSpec(
        box.language.step_deg,
        box.language.order_deg,
        limits.tolerance_deg,
        limits.min_deg,
        limits.max_deg,
        limits.speed_dps,
        NEAR_DEG + config.kind.slack_deg(axis),
        box.counts_from_deg if axis is Axis.AZIMUTH else None,
    )


def simulate(axes: SimulatedAxes) -> SimControllerRotor:
    specs = [
        SimControllerSpec(box.protocol, [axis.value for axis in turned], SIM_BAUD, box.counts_from_deg)
        for turned, box in axes.config.controller.boxes(axes.config.fitted).items()
    ]
    motors = {axis.value: (axes.motor(axis), axes.start_deg(axis)) for axis in Axis}
    return SimControllerRotor(specs, motors, axes.clock, axes.bus_sleep)
