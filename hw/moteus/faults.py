"""The numbers in a moteus's fault register: the meaning of each, and the remedy for the user.

Knows the firmware's codes (mjbots, "moteus reference", fault codes). Does not know when a controller reports one.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Fault:
    """A short name, and what to do."""

    name: str
    remedy: str


@dataclass(frozen=True, slots=True)
class Limit:
    """A limit that a running controller meets: its name, and a text of 13 characters at most for the LCD."""

    name: str
    short: str


FAULTS: dict[int, Fault] = {
    32: Fault("calibration fault", "calibrate the motor with moteus_tool --calibrate"),
    33: Fault("gate driver fault", "the supply drooped, or a motor wire is shorted: check both"),
    34: Fault("supply voltage too high", "braking feeds the supply: lower the acceleration, or use one that takes it"),
    35: Fault("encoder fault", "check the encoder's magnet and wires"),
    36: Fault("motor not configured", "calibrate the motor with moteus_tool --calibrate"),
    37: Fault("control cycle overrun", "write the controller's firmware again, or lower its PWM rate"),
    38: Fault("too hot", "let it cool, and look for what turns hard"),
    39: Fault("started outside its position bounds", "set servopos.position_min and position_max with tview"),
    40: Fault("supply voltage too low", "check the supply and its wires under load"),
    41: Fault("configuration changed while it ran", "leave tview alone while the box runs"),
    42: Fault("no valid commutation angle", "check the encoder, then calibrate the motor"),
    43: Fault("no valid position", "check the output encoder's magnet and wires"),
    44: Fault("motor driver cannot be enabled", "check the supply; if it stays, the board is broken"),
    45: Fault("stop position together with limits", "another program commands this controller: end it"),
    46: Fault("timing violation", "write the controller's firmware again"),
    47: Fault("feedforward without acceleration limit", "set servo.bemf_feedforward to 0 with tview"),
    48: Fault("limits that contradict each other", "check the limits in moteus.azimuth and moteus.elevation"),
    49: Fault("too far from where it should be", "something holds the antenna, or the motor is too weak"),
    50: Fault("too fast or too slow", "something drives or holds the antenna, or the motor is too weak"),
}
"""Faults: the controller takes the torque away until it gets a stop."""

LIMITS: dict[int, Limit] = {
    96: Limit("its velocity limit", "SPEED LIMIT"),
    97: Limit("its power limit", "POWER LIMIT"),
    98: Limit("the supply voltage", "SUPPLY VOLTS"),
    99: Limit("its current limit", "CURRENT LIMIT"),
    100: Limit("its own temperature", "DRIVER WARM"),
    101: Limit("the motor's temperature", "MOTOR WARM"),
    102: Limit("its torque limit", "TORQUE LIMIT"),
    103: Limit("its position bounds (servopos.position_min, position_max)", "SERVOPOS"),
    104: Limit("braking that feeds the supply", "BRAKING"),
    105: Limit("field weakening", "FIELD WEAK"),
}
"""Not faults: the controller runs, but meets a limit."""


def explain(code: int) -> Fault:
    """The fault with that number; a number that is not listed gets a text of its own."""
    return FAULTS.get(code, Fault(f"fault {code}", "look the number up in the moteus reference"))
