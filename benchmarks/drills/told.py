"""For each fault of the simulators: within how long the box must report it, and when the fault can be seen at all.

Knows the name of each fault that is due a message, without its axis; of any other fault none is due: it is ridden out,
or moves no motor. Does not listen to the box; `silence` does.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum, auto

from firmware_sim.rotors.moteus import FAULT_CODES

SILENT_S = 5.0


class Shows(Enum):
    """When a fault can be seen."""

    AT_ONCE = auto()
    ORDERED = auto()
    """Only while an order is in force: else the part is not used."""
    ELSEWHERE = auto()
    """Only while its axis stands, and an order certainly sends it to another angle."""
    DRIVEN = auto()
    """Only while the motor has current."""
    TURNED = auto()
    """Only while the motor turns the axis, in either direction."""
    PRESSED = auto()
    """Only while the motor has current and the axis stands."""
    WITHOUT_CURRENT = auto()
    """Only while the axis turns at half of its speed or faster, and its relay is open."""
    WELDED = auto()
    """Only while the axis turns so with current, and its coil is off. What a pause shows is kept over the next run."""
    BLOWN = auto()
    """Only while the axis turns at a fifth of its speed or faster, and its relay is open."""
    AS_READ = auto()
    """With each bad reading or answer, also at rest."""


@dataclass(frozen=True, slots=True)
class Rule:
    """When a message about a fault is due."""

    shows: Shows
    within_s: float = SILENT_S
    every: int = 0
    """A message is due only if at least each `every`-th reading or answer is bad. 0: the fault has no such number."""
    usual: int = 0
    """The simulator's own number, for a fault that is begun without one."""
    shared: bool = False
    """The part serves both axes: the message may come at either axis."""
    heals: bool = False
    """A stop, a release or a new start of the program ends it."""
    felt: bool = False
    """A message is due only if the box has readings of the axis."""
    lost: bool = False
    """A message is due only if the axis loses its place: an encoder behind the gear shows it again at once."""
    measured: bool = False
    """A message is due only if the angle is measured: a counting contact shows neither a direction nor an angle."""


AT_ONCE, DRIVEN = Rule(Shows.AT_ONCE), Rule(Shows.DRIVEN, felt=True)
BAD, GAPS = Rule(Shows.AS_READ, every=20, usual=10), Rule(Shows.AS_READ, every=60, usual=60)
BUS = Rule(Shows.AS_READ, within_s=10.0, every=40, usual=20, shared=True)
"""The simulator spoils transfers of the bus at random, and a reading takes several transfers."""
SEEN: Mapping[str, Rule] = {
    # pots and their converter
    "pot-open": AT_ONCE,
    "pot-shorted": AT_ONCE,
    "pot-loose": AT_ONCE,
    "pot-stuck": DRIVEN,
    "pot-reversed": Rule(Shows.TURNED, measured=True),
    "pot-crackles": BAD,
    "pot-spikes": BAD,
    "pot-bursts": GAPS,
    "adc-gone": Rule(Shows.AT_ONCE, shared=True),
    "adc-noisy": BUS,
    "adc-gaps": Rule(Shows.AS_READ, every=80, usual=80, shared=True),
    "adc-frozen": Rule(Shows.DRIVEN, shared=True, measured=True),
    # other sensors
    "as5600-gone": AT_ONCE,
    "as5600-noisy": BUS,
    "as5600-gaps": GAPS,
    **dict.fromkeys(("as5045-gone", "as5048a-gone", "as5048b-gone", "mt6701-gone", "mt6701-ssi-gone"), AT_ONCE),
    **dict.fromkeys(("as5045-noisy", "as5048a-noisy", "as5048b-noisy", "mt6701-noisy", "mt6701-ssi-noisy"), BUS),
    **dict.fromkeys(("as5048b-gaps", "mt6701-gaps"), GAPS),
    **dict.fromkeys(("magnet-missing", "magnet-weak", "magnet-strong"), AT_ONCE),
    "mpu6050-gone": Rule(Shows.AT_ONCE, shared=True),
    "mpu6050-noisy": BUS,
    "mpu6050-gaps": Rule(Shows.AS_READ, every=60, usual=60, shared=True),
    # motors, relays, hands
    "motor-stalled": DRIVEN,
    "motor-reversed": Rule(Shows.TURNED, measured=True),
    "stop-early": Rule(Shows.PRESSED, felt=True),
    "hand-turns": Rule(Shows.WITHOUT_CURRENT, measured=True),
    "relay-welded": Rule(Shows.WELDED, felt=True),
    "wind-turns": Rule(Shows.BLOWN, measured=True),
    # contacts that are counted
    "contact-stuck-open": DRIVEN,
    "contact-stuck-closed": DRIVEN,
    # control boxes: a chip that does not hear leaves its box where it was sent before
    "select-broken": Rule(Shows.ELSEWHERE, measured=True),
    # servos
    "servo-stalled": Rule(Shows.DRIVEN, measured=True),
    "servo-unpowered": Rule(Shows.ELSEWHERE, measured=True),
    "board-unpowered": Rule(Shows.ORDERED, shared=True),
    "board-gone": Rule(Shows.ORDERED, shared=True),
    "board-noisy": Rule(Shows.ORDERED, within_s=10.0, every=40, usual=20, shared=True),
    # ready-made controllers
    "controller-deaf": Rule(Shows.AT_ONCE, shared=True),
    "controller-garbled": Rule(Shows.AT_ONCE, shared=True),
    "controller-unplugged": Rule(Shows.AT_ONCE, shared=True),
    "knob-turned": Rule(Shows.WITHOUT_CURRENT),
    "jumps": AT_ONCE,
    # bridges and their encoders
    "encoder-dead": DRIVEN,
    "bridge-shorted": Rule(Shows.WELDED, felt=True),
    # steppers
    "chip-silent": AT_ONCE,
    "chip-unpowered": AT_ONCE,
    "coil-short": DRIVEN,
    "coil-open": DRIVEN,
    "driver-hot": AT_ONCE,
    "held": Rule(Shows.PRESSED, felt=True),
    # moteus controllers
    "silent": AT_ONCE,
    "jammed": DRIVEN,
    "factory-bounds": Rule(Shows.ELSEWHERE, measured=True),
    "power-cycled": Rule(Shows.AT_ONCE, lost=True),
    "replies-lost": Rule(Shows.DRIVEN, every=12, usual=10),
    "replies-gaps": Rule(Shows.AS_READ, within_s=10.0, every=60, usual=60),
    **dict.fromkeys(FAULT_CODES, Rule(Shows.AT_ONCE, heals=True)),
    # troubles of the drills themselves
    "hung": Rule(Shows.AT_ONCE, shared=True),
    "card-hangs": Rule(Shows.AT_ONCE, shared=True),
    "every": BAD,
}


def plain(name: str) -> str:
    """The name of the fault without its axis, its relay and its number."""
    name = name.partition(":")[0].removeprefix("azimuth-").removeprefix("elevation-").removeprefix("second-")
    for switched in ("relay-welded", "bridge-shorted"):
        if name.startswith(switched):
            return switched
    return name.removeprefix("low-").removeprefix("high-")


def rule(name: str) -> Rule | None:
    """The rule for the simulators' fault `name`; None: no message is due, or bad readings are too rare for one."""
    found = SEEN.get(plain(name))
    if found is not None and found.every:
        _, _, number = name.partition(":")
        if int(number or found.usual or found.every + 1) > found.every:
            return None
    return found
