"""A simulated rotor behind ready-made controllers: one for both axes, or one for each; and its faults by name.

Knows which controller turns which axis. Knows no driver: it offers a line for each controller, with `read` and `write`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from firmware_sim.controllers.brain import SimBrain
from firmware_sim.controllers.dialects import DIALECTS
from firmware_sim.controllers.line import SimLine
from firmware_sim.faults import SimFault
from firmware_sim.parts.motor import MotorSpec, SimMotor
from firmware_sim.rotors.geared import GearedRotor
from firmware_sim.rotors.rotor import AXES

SLOW_S = 0.6
"""Fault `controller-slow`: the time before each answer."""
AZIMUTH_ONLY = ("dcu1", "rot1prog")
JUMP_DEG = 60.0
"""Fault `jumps`: how far its sensor is off."""


@dataclass(frozen=True, slots=True)
class SimControllerSpec:
    """A controller: its protocol, and the names of the axes that it turns."""

    protocol: str
    axes: Sequence[str] = AXES
    baud: int = 9600
    wraps_deg: float | None = None
    """It tells azimuths of one turn, from this angle up."""


class SimControllerRotor(GearedRotor):
    """`clock` gives seconds; `motors`: each axis by name, with the angle at which it begins."""

    azimuth: SimBrain
    elevation: SimBrain

    def __init__(
        self,
        controllers: Sequence[SimControllerSpec],
        motors: dict[str, tuple[MotorSpec, float]],
        clock: Callable[[], float],
        sleep: Callable[[float], None] | None = None,
    ) -> None:
        super().__init__(clock, sleep)
        steps_deg = {name: DIALECTS[each.protocol].step_deg for each in controllers for name in each.axes}
        brains = {
            name: SimBrain(SimMotor(motor, start_deg, clock()), steps_deg.get(name, 1.0), clock())
            for name, (motor, start_deg) in motors.items()
        }
        self.azimuth, self.elevation = (brains[name] for name in AXES)
        self.lines = [
            SimLine(
                each.protocol,
                _both(each, brains, clock()),
                clock,
                self._lock,
                baud=each.baud,
                wraps=each.wraps_deg,
            )
            for each in controllers
        ]
        self.faults |= self._fault_table()

    def _advance(self) -> None:
        now_s = self._clock()
        for line in self.lines:
            line.advance(now_s)

    def _fault_table(self) -> dict[str, SimFault]:
        table: dict[str, SimFault] = {}
        for name, line in zip(("controller", "second-controller"), self.lines, strict=False):
            table |= {
                f"{name}-deaf": self._fault_of(line, "deaf", True, False),
                f"{name}-garbled": self._fault_of(line, "garbled", True, False),
                f"{name}-slow": self._fault_of(line, "delay_s", SLOW_S, line.delay_s),
                f"{name}-unplugged": self._fault_of(line, "unplugged", True, False),
                f"{name}-ignores-stop": self._fault_of(line, "ignores_stop", True, False),
            }
        for name, brain in zip(AXES, (self.azimuth, self.elevation), strict=True):
            table |= {
                f"{name}-knob-turned": self._fault_of(brain, "knob", 1, 0),
                f"{name}-jumps": self._fault_of(brain, "jump_deg", JUMP_DEG, 0.0),
            }
        return table | self._motor_faults()


def _both(spec: SimControllerSpec, brains: dict[str, SimBrain], now_s: float) -> list[SimBrain]:
    """What is at its azimuth and at its elevation. One that can turn an azimuth only has any axis there."""
    unused = SimBrain(SimMotor(MotorSpec(6.0, 0.15, 0.015, 0.0, 0.0, 360.0), 0.0, now_s), 1.0, now_s)
    if len(spec.axes) == 1 and spec.protocol in AZIMUTH_ONLY:
        return [brains[spec.axes[0]], unused]
    return [brains[name] if name in spec.axes else unused for name in AXES]
