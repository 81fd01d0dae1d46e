"""A cam on a shaft that turns by a closed formula: where it closes, when, and what goes wrong with it."""

from __future__ import annotations

from collections.abc import Callable

from firmware_sim.clock import SimClock
from firmware_sim.parts.contact import ContactFault, ContactSpec, SimContact
from firmware_sim.parts.motor import MotorSpec, SimMotor
from firmware_sim.rotors.relay_pulse import RelayPulseAxisSpec, SimRelayPulseRotor
from tests.tables import every_row

QUIET = ContactSpec(spacing_deg=5.0, closed_deg=1.0, closes_at_deg=0.0, bounce_s=0.0)
MOTOR = MotorSpec(speed_dps=6.0, lag_s=0.0, relay_delay_s=0.0, backlash_deg=0.0, stop_low_deg=-50.0, stop_high_deg=50.0)


def steadily(speed_dps: float, from_deg: float = 0.0) -> Callable[[float], float]:
    return lambda seconds: from_deg + speed_dps * seconds


def rounded(changes: list[tuple[float, bool]]) -> list[tuple[float, bool]]:
    return [(round(at_s, 6), closed) for at_s, closed in changes]


def test_up_it_closes_at_the_low_edge_and_down_at_the_high_one() -> None:
    contact = SimContact(QUIET, 2.0)
    contact.turned(10.0, 1.0, steadily(6.0, 2.0))  # to 8°
    assert rounded(contact.take(11.0)) == [(10.5, True), (round(10 + 4 / 6, 6), False)]
    contact.turned(20.0, 1.0, steadily(-6.0, 8.0))
    assert rounded(contact.take(21.0)) == [(round(20 + 2 / 6, 6), True), (20.5, False)]


def test_turned_back_inside_a_closure_it_leaves_by_the_way_it_came() -> None:
    contact = SimContact(QUIET, 4.5)
    contact.turned(0.0, 1.0, steadily(1.0, 4.5))
    contact.turned(1.0, 1.0, steadily(-1.0, 5.5))
    assert rounded(contact.take(2.0)) == [(0.5, True), (1.5, False)]
    assert contact.zone == 1


def test_play_delays_every_edge_on_the_way_back() -> None:
    contact = SimContact(ContactSpec(5.0, 1.0, 0.0, play_deg=0.4, bounce_s=0.0), 2.0)
    contact.turned(0.0, 1.0, steadily(5.0, 2.0))
    assert rounded(contact.take(1.0)) == [(0.6, True), (0.8, False)]
    contact.turned(1.0, 1.0, steadily(-5.0, 7.0))
    assert rounded(contact.take(2.0)) == [(round(1 + 1.4 / 5, 6), True), (round(1 + 2.4 / 5, 6), False)]


def test_steps_of_any_size_tell_the_same() -> None:
    whole, pieces = SimContact(QUIET, 0.5), SimContact(QUIET, 0.5)
    whole.turned(0.0, 10.0, steadily(6.0, 0.5))
    for piece in range(1000):
        pieces.turned(piece * 0.01, 0.01, steadily(6.0, 0.5 + piece * 0.06))
    assert rounded(pieces.take(10.0)) == rounded(whole.take(10.0))


def test_a_motor_tells_every_stretch_it_turned_and_none_beyond_its_stop() -> None:
    motor = SimMotor(MOTOR, 44.0, 0.0)
    contact = SimContact(QUIET, 44.0)
    motor.on_turn.append(contact.turned)
    motor.coils(plus=True, minus=False, now_s=0.0)
    motor.advance(10.0)
    assert motor.shaft_deg == 50.0
    assert rounded(contact.take(10.0)) == [(round(1 / 6, 6), True), (round(2 / 6, 6), False), (1.0, True)]


# --- faults


def closures(contact: SimContact) -> int:
    contact.turned(0.0, 60.0, steadily(6.0, 2.0))
    return sum(closed for _, closed in contact.take(100.0))


@every_row(
    ("fault", "count"),
    [
        (ContactFault.NONE, 72),
        (ContactFault.MISSES, 72 - 14),
        (ContactFault.DOUBLES, 72 + 14),
        (ContactFault.STUCK_OPEN, 0),
        (ContactFault.STUCK_CLOSED, 1),
    ],
)
def test_faults(fault: ContactFault, count: int) -> None:
    contact = SimContact(QUIET, 2.0)
    contact.break_down(fault, 0.0)
    assert closures(contact) == count


# --- on its pins


def test_a_rotor_pulls_the_line_low_while_the_contact_is_closed() -> None:
    clock = SimClock()
    rotor = SimRelayPulseRotor(
        RelayPulseAxisSpec(22, 23, 17, start_deg=0.5), RelayPulseAxisSpec(24, 25, 27, start_deg=2.0), clock
    )
    assert (rotor.gpio.level(17), rotor.gpio.level(27)) == (False, True)
    rotor.gpio.drive_input(22, True)  # as if a relay line were driven
    clock.sleep(0.3)
    assert rotor.gpio.level(17)
    assert rotor.shafts()[0] > 1.0
