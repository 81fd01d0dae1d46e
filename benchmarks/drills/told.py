"""What the box must tell of each fault of the simulators: within how long, and when there is anything to be seen.

Knows every name of every kind of rotor, without its axis: a rule, or the reason why no message is due. Does not listen
to the box; `silence` does.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum, auto

from firmware_sim.rotors.moteus import FAULT_CODES

SILENT_S = 5.0


class Shows(Enum):
    """When a fault can be seen at all."""

    AT_ONCE = auto()
    ORDERED = auto()
    """Only with an order in force is the part in use."""
    ELSEWHERE = auto()
    """Only while an order for certain sends its axis elsewhere."""
    DRIVEN = auto()
    """Only while the motor has current."""
    TURNED = auto()
    """Only while its motor turns it, either way."""
    PRESSED = auto()
    """Only while its motor has current and it stands."""
    WITHOUT_CURRENT = auto()
    """Only while it turns at half of its speed, and its relay is open."""
    BLOWN = auto()
    """The same, at a fifth of its speed."""
    AS_READ = auto()
    """With each bad reading or answer: also at rest."""


@dataclass(frozen=True, slots=True)
class Rule:
    shows: Shows
    within_s: float = SILENT_S
    every: int = 0
    """Only where at least each so many-th reading or answer is bad it need be told. 0: it takes no number."""
    usual: int = 0
    """The same number of a fault that is begun without one."""
    shared: bool = False
    """The part serves both axes: it may be told at either."""
    heals: bool = False
    """A stop, a release or a new start of the program ends it."""
    felt: bool = False
    """Only where something comes back from the axis."""
    measured: bool = False
    """Only where the angle is measured: a contact tells neither a way nor an angle."""


AT_ONCE, DRIVEN = Rule(Shows.AT_ONCE), Rule(Shows.DRIVEN, felt=True)
BAD, GAPS = Rule(Shows.AS_READ, every=20, usual=10), Rule(Shows.AS_READ, every=60, usual=60)
BUS = Rule(Shows.AS_READ, within_s=10.0, every=40, usual=20, shared=True)
"""By chance, and of the transfers: a reading takes some."""
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
    "magnet-missing": AT_ONCE,
    "mpu6050-gone": Rule(Shows.AT_ONCE, shared=True),
    "mpu6050-noisy": BUS,
    "mpu6050-gaps": Rule(Shows.AS_READ, every=60, usual=60, shared=True),
    # motors, relays, hands
    "motor-stalled": DRIVEN,
    "motor-reversed": Rule(Shows.TURNED, measured=True),
    "stop-early": Rule(Shows.PRESSED, felt=True),
    "hand-turns": Rule(Shows.WITHOUT_CURRENT, measured=True),
    "relay-welded": Rule(Shows.WITHOUT_CURRENT, felt=True),
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
    # moteus controllers
    "silent": AT_ONCE,
    "jammed": DRIVEN,
    "factory-bounds": Rule(Shows.ELSEWHERE, measured=True),
    "power-cycled": AT_ONCE,
    "replies-lost": Rule(Shows.DRIVEN, every=12, usual=10),
    "replies-gaps": Rule(Shows.AS_READ, within_s=10.0, every=60, usual=60),
    **dict.fromkeys(FAULT_CODES, Rule(Shows.AT_ONCE, heals=True)),
    # troubles of the drills themselves
    "hung": Rule(Shows.AT_ONCE, shared=True),
    "every": BAD,
}
RIDDEN_OUT = "one moment, that is ridden out"
BY_ITSELF = "the box puts it right with its next order"
NO_MOTION = "no part of what moves the antenna"
ADAPTER = "the drills speak to the controllers without an adapter's lines"
UNTOLD: Mapping[str, str] = {
    "pot-jumps": RIDDEN_OUT,
    "pot-drifts": "no reading tells a drift: the angle is wrong by it, and nothing else",
    "motor-slow": "it arrives later; a motor that is on for longer than the travel takes is told",
    "pulses-missed": "told as a lost count, which may take five closures",
    "pulses-doubled": "a contact cannot close again so soon: the second closure is not counted",
    "switch-open": "a broken wire is a switch that is reached: told when its way is ordered",
    "chip-dips": BY_ITSELF,
    "board-dips": BY_ITSELF,
    "board-gaps": "over before a servo moves on",
    "shaken": "a gust shakes the board as much",
    "steel-near": "a compass is asked by a person, who sees how it scatters",
    "bus-hung": "in the drills the reading thread hangs instead",
    "adapter-deaf": ADAPTER,
    "adapter-unplugged": ADAPTER,
    "lines-dropped": ADAPTER,
    "lines-garbled": ADAPTER,
    "lines-late": ADAPTER,
    **{f"{part}-{how}": NO_MOTION for part in ("lcd", "compass") for how in ("gone", "noisy", "gaps")},
}
"""Why no message is due: the fault cannot be seen, or moves nothing."""
PANEL = "panel-"
"""What is wrong with a panel moves no motor: the tests of the panel judge its messages."""


def plain(name: str) -> str:
    """The fault without its axis, its relay and the number of how often."""
    name = name.partition(":")[0].removeprefix("azimuth-").removeprefix("elevation-")
    if name.startswith("relay-welded"):
        return "relay-welded"
    return name.removeprefix("low-").removeprefix("high-")


def rule(name: str) -> Rule | None:
    """What must be told of the simulators' fault `name`; None: nothing, or not so often."""
    found = SEEN.get(plain(name))
    if found is not None and found.every:
        _, _, number = name.partition(":")
        if int(number or found.usual or found.every + 1) > found.every:
            return None
    return found
