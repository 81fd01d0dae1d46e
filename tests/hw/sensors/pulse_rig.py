"""A simulated U-100 with the real drivers on it: relay bank, kernel-debounced contact, counter.

Knows how it is wired. Does not know what a test checks.
"""

from __future__ import annotations

import math

from firmware_sim.clock import SimClock
from firmware_sim.parts.contact import ContactSpec
from firmware_sim.parts.motor import MotorSpec
from firmware_sim.rotors.relay_pulse import U100_MOTOR, RelayPulseAxisSpec, SimRelayPulseRotor
from hw.buses.gpio import GpioContact, GpioOutputs
from hw.drives.relays import RelayBank
from hw.ports import Axis, Direction
from hw.sensors.cam import Cam
from hw.sensors.pulses import PulseCounter, TappedLines

PATH = "/dev/gpiochip0"
RELAYS = {"azimuth_cw": 22, "azimuth_ccw": 23, "elevation_up": 24, "elevation_down": 25}
CONTACT_PIN, OTHER_CONTACT_PIN = 17, 27
AZ = Axis.AZIMUTH
CYCLE_S = 0.05
STANDS_S = 1.2
"""So long after the relay opened nothing moves any more: twelve lags of the motor."""
CAM = Cam(spacing_deg=5.0, closed_deg=1.0, closes_at_deg=0.3, speed_dps=6.0, low_deg=0.0, high_deg=360.0)


class PulseRig:
    """The azimuth axis of a U-100; `cam` is what the configuration says of it, the rest what it really is."""

    def __init__(
        self,
        start_deg: float = 180.0,
        *,
        cam: Cam = CAM,
        motor: MotorSpec = U100_MOTOR,
        pace: float = 1.0,
        bounce_s: float = 0.005,
        seed: int = 1,
    ) -> None:
        self.clock = SimClock(1000.0)
        contact = ContactSpec(cam.spacing_deg, cam.closed_deg, cam.closes_at_deg, cam.play_deg, bounce_s)
        self.rotor = SimRelayPulseRotor(
            RelayPulseAxisSpec(22, 23, CONTACT_PIN, motor, contact, start_deg, seed),
            RelayPulseAxisSpec(24, 25, OTHER_CONTACT_PIN, motor),
            self.clock,
        )
        self.rotor.azimuth.motor.pace = pace
        self.cam = cam
        self.switch_deg = -math.inf
        """Where its low limit switch opens."""
        self._lines = GpioOutputs(self.rotor.gpio, PATH, RELAYS, consumer="rotator-relays")
        self.tapped = TappedLines(self._lines, self.clock)
        self.bank = RelayBank(self.tapped, self.clock, dead_time_s=0.5)
        self.clock.add_alarm(self.bank.due_s, self.bank.enforce)
        self.contact = GpioContact(self.rotor.gpio, PATH, CONTACT_PIN, consumer="rotator-azimuth")
        self.counter = PulseCounter(AZ, self.contact, self.tapped, cam, self.clock)
        self.placed = self.counter.place(start_deg)

    def ends(self) -> frozenset[Direction]:
        """The directions that a limit switch blocks: its shaft is below `switch_deg`."""
        return frozenset({Direction.MINUS}) if self.shaft_deg <= self.switch_deg else frozenset()

    @property
    def shaft_deg(self) -> float:
        return self.rotor.shafts()[0]

    @property
    def off_by(self) -> int:
        """How many zones the count is off by; a closure is two."""
        return self.counter.zone - self.rotor.azimuth.contact.zone

    def run(self, direction: Direction, seconds: float, cycle_s: float = CYCLE_S) -> None:
        """Drive for so long, then off."""
        self.drive(direction, seconds, cycle_s)
        self.bank.drive(AZ, Direction.OFF, 0.0)

    def drive(self, direction: Direction, seconds: float, cycle_s: float = CYCLE_S) -> None:
        """Drive for so long, as the control loop would: a short lease and a reading every cycle."""
        until_s = self.clock() + seconds
        while (left_s := until_s - self.clock()) > 1e-9:
            self.bank.drive(AZ, direction, min(until_s, self.clock() + 0.4))
            self.clock.sleep(min(cycle_s, left_s))
            self.counter.read()

    def wait(self, seconds: float, cycle_s: float = CYCLE_S) -> float:
        """Let time pass. Returns the last reading."""
        until_s = self.clock() + seconds
        while (left_s := until_s - self.clock()) > 1e-9:
            self.clock.sleep(min(cycle_s, left_s))
            self.counter.read()
        return self.counter.read()

    def move(self, direction: Direction, seconds: float) -> float:
        """Drive, and wait until it stands. Returns the reading."""
        self.run(direction, seconds)
        return self.wait(STANDS_S)
