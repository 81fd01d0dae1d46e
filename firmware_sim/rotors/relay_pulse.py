"""A simulated rotor of the Alliance U-100 kind: two motors behind relays, and a cam contact on each shaft.

Knows which relay feeds which motor, which line each contact is on, and the rotor's faults by name. The contacts come
through opto-isolators: a closed contact pulls its line low, or high with `contacts_active_low=False`. Knows no driver:
it offers lines in the shape of gpiod. The physics is in `parts`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from firmware_sim.faults import SimFault
from firmware_sim.parts.contact import FAULTY_EACH, ContactFault, ContactSpec, SimContact
from firmware_sim.parts.motor import MotorSpec, SimMotor
from firmware_sim.parts.relays import RelayPins
from firmware_sim.rotors.geared import RelayedRotor

U100_MOTOR = MotorSpec(
    speed_dps=6.0, lag_s=0.1, relay_delay_s=0.015, backlash_deg=0.5, stop_low_deg=0.0, stop_high_deg=360.0
)
"""One turn a minute. The motor stands still half a second after its relay has opened."""


@dataclass(frozen=True, slots=True)
class RelayPulseAxisSpec:
    """One axis: its parts, and the GPIO numbers of its relays and its contact."""

    plus_pin: int
    minus_pin: int
    contact_pin: int
    motor: MotorSpec = U100_MOTOR
    contact: ContactSpec = field(default_factory=ContactSpec)
    start_deg: float = 0.0
    seed: int = 0
    """Seed of the contact's bouncing."""
    brake_pin: int | None = None


class RelayPulseAxis:
    """A motor with its contact. Only the rotor uses it, under the rotor's lock."""

    def __init__(self, spec: RelayPulseAxisSpec, now_s: float) -> None:
        self.spec = spec
        self.motor = SimMotor(spec.motor, spec.start_deg, now_s)
        self.contact = SimContact(spec.contact, spec.start_deg, spec.seed)
        self.motor.on_turn.append(self.contact.turned)


class SimRelayPulseRotor(RelayedRotor):
    """`clock` gives seconds; `sleep` lets time pass on the bus (None: transfers take no time)."""

    azimuth: RelayPulseAxis
    elevation: RelayPulseAxis

    def __init__(
        self,
        azimuth: RelayPulseAxisSpec,
        elevation: RelayPulseAxisSpec,
        clock: Callable[[], float],
        sleep: Callable[[float], None] | None = None,
        *,
        relays_active_low: bool = False,
        contacts_active_low: bool = True,
        master_pin: int | None = None,
    ) -> None:
        super().__init__(clock, sleep)
        self._closed_level = not contacts_active_low
        self.azimuth = RelayPulseAxis(azimuth, clock())
        self.elevation = RelayPulseAxis(elevation, clock())
        self._axes = (self.azimuth, self.elevation)
        for axis in self._axes:
            self.gpio.drive_input(axis.spec.contact_pin, axis.contact.closed is self._closed_level)
        pins = RelayPins(
            azimuth.plus_pin,
            azimuth.minus_pin,
            elevation.plus_pin,
            elevation.minus_pin,
            master_pin,
            azimuth.brake_pin,
            elevation.brake_pin,
        )
        self._wire_relays(pins, active_low=relays_active_low)
        self.gpio.on_look.append(self._catch_up)
        self.faults = self._fault_table()

    def _catch_up(self, now_s: float) -> None:
        """Put the contacts' changes up to now on their lines.

        The caller holds the lock of the lines. Order of locks: first the lines, then the rotor.
        """
        with self._lock:
            self._advance()
            changes = [(*change, axis) for axis in self._axes for change in axis.contact.take(now_s)]
        for at_s, closed, axis in sorted(changes, key=lambda change: change[0]):
            self.gpio.drive_input(axis.spec.contact_pin, closed is self._closed_level, at_s)

    def _fault_table(self) -> dict[str, SimFault]:
        """Of one axis, the two `contact-stuck` faults and the two of the pulses exclude each other."""
        table: dict[str, SimFault] = {}
        for name, axis in (("azimuth", self.azimuth), ("elevation", self.elevation)):
            table |= {
                f"{name}-contact-stuck-open": self._contact_fault(axis, ContactFault.STUCK_OPEN),
                f"{name}-contact-stuck-closed": self._contact_fault(axis, ContactFault.STUCK_CLOSED),
                f"{name}-pulses-missed": self._pulse_fault(axis, ContactFault.MISSES),
                f"{name}-pulses-doubled": self._pulse_fault(axis, ContactFault.DOUBLES),
            }
        return table | self._motor_faults()

    def _contact_fault(self, axis: RelayPulseAxis, fault: ContactFault) -> SimFault:
        def become(wanted: ContactFault) -> None:
            axis.contact.break_down(wanted, self._clock())

        return self._fault_by(lambda: become(fault), lambda: become(ContactFault.NONE))

    def _pulse_fault(self, axis: RelayPulseAxis, fault: ContactFault) -> SimFault:
        """A fault of each n-th closure."""
        plain = self._contact_fault(axis, fault)

        def begin(each: int) -> None:
            axis.contact.faulty_each = each
            plain.inject()

        return SimFault(lambda: begin(FAULTY_EACH), plain.clear, begin)
