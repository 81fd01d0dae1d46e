"""Two moteus controllers in simulated time: the drive, and the codec of mjbots' own library, on simulated controllers.

The rotor is the ISEL build: azimuth one revolution a turn, elevation upside down, 0° at -0.25 and 90° at -0.5.
"""

from __future__ import annotations

import contextlib

import pytest

pytest.importorskip("moteus", reason="moteus is missing: pip install --no-deps moteus")

from firmware_sim.clock import SimClock
from firmware_sim.moteus.motor import Mode, MoteusSettings
from firmware_sim.rotors.moteus import MoteusAxisSpec, SimMoteusRotor
from hw.moteus.drive import MoteusDrive
from hw.moteus.orders import MoteusSpec
from hw.moteus.wire import MoteusInStep
from hw.ports import Axis, HardwareError

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
AZIMUTH = MoteusSpec(can_id=1)
ELEVATION = MoteusSpec(can_id=2, rev_per_turn=-1.0, zero_rev=-0.25)
CYCLE_S = 0.05
"""The control loop's."""


class Bench:
    def __init__(
        self,
        start_deg: tuple[float, float] = (0.0, 0.0),
        *,
        geared: bool = True,
        rotor_turns: float = 50,
        output_encoder: bool = False,
        range_deg: tuple[float, float] = (0.0, 450.0),
    ):
        self.clock = SimClock(100.0)
        settings = MoteusSettings(rotor_turns=rotor_turns, timeout_mode=Mode.POSITION, output_encoder=output_encoder)
        self.world = SimMoteusRotor(
            MoteusAxisSpec(1, start_deg[0], settings=settings),
            MoteusAxisSpec(
                2, start_deg[1], rev_per_turn=-1.0, zero_rev=-0.25, settings=MoteusSettings(rotor_turns=rotor_turns)
            ),
            self.clock,
        )
        self.specs = MoteusSpec(can_id=1, geared=geared, min_deg=range_deg[0], max_deg=range_deg[1]), ELEVATION
        self.start_program()

    def start_program(self) -> None:
        self.drive = MoteusDrive(*self.specs, self.clock)
        self.alive = True
        wire = MoteusInStep(self.drive, self.world.transport())
        drive = self.drive
        self.clock.add_alarm(lambda: wire.due_s() if self.drive is drive and self.alive else None, wire.serve)
        self.clock.sleep(0.1)

    def follow(self, axis: Axis, angle_deg: float, seconds: float, rate_dps: float = 0.0) -> None:
        """Aim as the control loop does: at an angle that moves on, renewed every cycle."""
        for at in range(round(seconds / CYCLE_S)):
            self.drive.aim(axis, angle_deg + rate_dps * at * CYCLE_S, rate_dps, self.clock() + 0.25)
            self.clock.sleep(CYCLE_S)

    def follow_if_it_may(self, axis: Axis, angle_deg: float, seconds: float) -> None:
        """Aim all that time, refused or not."""
        for _ in range(round(seconds / CYCLE_S)):
            with contextlib.suppress(HardwareError):
                self.drive.aim(axis, angle_deg, 0.0, self.clock() + 0.25)
            self.clock.sleep(CYCLE_S)

    def antenna(self, axis: Axis) -> float:
        return self.world.antenna()[list(Axis).index(axis)]

    def mode(self, axis: Axis) -> Mode:
        motor = self.world.controller(axis.value).motor
        motor.advance()
        return motor.mode
