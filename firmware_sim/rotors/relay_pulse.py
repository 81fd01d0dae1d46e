"""A simulated rotor of the Alliance U-100 kind: two motors behind relays, and a cam contact on each shaft.

Knows what is wired where, and its faults by name. Knows no driver: it offers lines in the shape of gpiod, and the rest
is physics. The contacts come through opto-isolators: a closed one pulls its line low, unless said otherwise.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from firmware_sim.faults import SimFault
from firmware_sim.parts.contact import ContactFault, ContactSpec, SimContact
from firmware_sim.parts.motor import MotorSpec, SimMotor
from firmware_sim.rotors.rotor import GearedRotor

U100_MOTOR = MotorSpec(
    speed_dps=6.0, lag_s=0.1, relay_delay_s=0.015, backlash_deg=0.5, stop_low_deg=0.0, stop_high_deg=360.0
)
"""One turn a minute; it stands half a second after its relay has opened."""


@dataclass(frozen=True, slots=True)
class PulseAxisSpec:
    """One axis of the rotor, and the pins it is wired to."""

    plus_pin: int
    minus_pin: int
    contact_pin: int
    motor: MotorSpec = U100_MOTOR
    contact: ContactSpec = field(default_factory=ContactSpec)
    start_deg: float = 0.0
    seed: int = 0
    """Of its bouncing."""


class SimPulseAxis:
    """A motor with its contact. Looked at only through the rotor, under its lock."""

    def __init__(self, spec: PulseAxisSpec, now_s: float) -> None:
        self.spec = spec
        self.motor = SimMotor(spec.motor, spec.start_deg, now_s)
        self.contact = SimContact(spec.contact, spec.start_deg, spec.seed)
        self.motor.on_turn.append(self.contact.turned)
        self.coils = (False, False)


class PulseRotor(GearedRotor):
    """`clock` tells the time, `sleep` lets it pass on the bus (None: transfers take none)."""

    azimuth: SimPulseAxis
    elevation: SimPulseAxis

    def __init__(
        self,
        azimuth: PulseAxisSpec,
        elevation: PulseAxisSpec,
        clock: Callable[[], float],
        sleep: Callable[[float], None] | None = None,
        *,
        relays_active_low: bool = False,
        contacts_active_low: bool = True,
        master_pin: int | None = None,
    ) -> None:
        super().__init__(clock, sleep)
        self._active_low = relays_active_low
        self._closed_level = not contacts_active_low
        self._master_pin = master_pin
        self.azimuth = SimPulseAxis(azimuth, clock())
        self.elevation = SimPulseAxis(elevation, clock())
        self.relay_starts: int = 0
        self._axes = (self.azimuth, self.elevation)
        for axis in self._axes:
            self.gpio.drive_input(axis.spec.contact_pin, axis.contact.closed is self._closed_level)
        self.gpio.on_edges.append(self._relays_changed)
        self.gpio.on_look.append(self._catch_up)
        self.faults = self._fault_table()
        if master_pin is not None:
            self._relays_changed(clock(), {master_pin: self.gpio.level(master_pin)})

    def drives(self) -> tuple[int, int]:
        with self._lock:
            azimuth, elevation = (int(plus) - int(minus) for plus, minus in (axis.coils for axis in self._axes))
            return azimuth, elevation

    def _relays_changed(self, now_s: float, changes: Mapping[int, bool]) -> None:
        with self._lock:
            for axis in self._axes:
                pins = (axis.spec.plus_pin, axis.spec.minus_pin)
                if changed := changes.keys() & set(pins):
                    plus, minus = axis.coils = (self._pulled(pins[0]), self._pulled(pins[1]))
                    axis.motor.coils(plus, minus, now_s)
                    self.relay_starts += sum(self._pulled(pin) for pin in changed)
            if self._master_pin is not None and self._master_pin in changes:
                self._advance()
                for axis in self._axes:
                    axis.motor.supply = self._pulled(self._master_pin)

    def _pulled(self, pin: int) -> bool:
        return self.gpio.level(pin) != self._active_low

    def _advance(self) -> None:
        now_s = self._clock()
        for axis in self._axes:
            axis.motor.advance(now_s)

    def _catch_up(self, now_s: float) -> None:
        """The contacts' pins, up to now. The lines' lock is held, and always taken before the rotor's."""
        with self._lock:
            self._advance()
            changes = [(*change, axis) for axis in self._axes for change in axis.contact.take(now_s)]
        for at_s, closed, axis in sorted(changes, key=lambda change: change[0]):
            self.gpio.drive_input(axis.spec.contact_pin, closed is self._closed_level, at_s)

    def _fault_table(self) -> dict[str, SimFault]:
        table: dict[str, SimFault] = {}
        for name, axis, plus, minus in (
            ("azimuth", self.azimuth, "cw", "ccw"),
            ("elevation", self.elevation, "up", "down"),
        ):
            table |= {
                f"{name}-contact-stuck-open": self._contact_fault(axis, ContactFault.STUCK_OPEN),
                f"{name}-contact-stuck-closed": self._contact_fault(axis, ContactFault.STUCK_CLOSED),
                f"{name}-pulses-missed": self._contact_fault(axis, ContactFault.MISSES),
                f"{name}-pulses-doubled": self._contact_fault(axis, ContactFault.DOUBLES),
                f"{name}-motor-stalled": self._fault_of(axis.motor, "stalled", True, False),
                f"{name}-motor-reversed": self._fault_of(axis.motor, "reversed", True, False),
                f"{name}-motor-slow": self._fault_of(axis.motor, "pace", 0.4, 1.0),
                f"{name}-hand-turns": self._fault_of(axis.motor, "pushed", 1.0, 0.0),
                f"{name}-relay-welded-{plus}": self._fault_of(axis.motor, "welded", 1, 0),
                f"{name}-relay-welded-{minus}": self._fault_of(axis.motor, "welded", -1, 0),
            }
        return table

    def _contact_fault(self, axis: SimPulseAxis, fault: ContactFault) -> SimFault:
        def become(wanted: ContactFault) -> None:
            with self._lock:
                self._advance()
                axis.contact.break_down(wanted, self._clock())

        return SimFault(lambda: become(fault), lambda: become(ContactFault.NONE))
