"""What the box makes of every fault that a simulator knows: one line each. A fault without a line fails its test.

Knows names and promises. A name without its axis stands for both. Knows nothing of how it is tried.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum


class Remedy(Enum):
    """What a person does when the cause is gone, so that it points right again."""

    NOTHING = "the next order is enough"
    ACKNOWLEDGE = "a stop, and the next order"
    LATER = "a stop after a second of good readings, and the next order"
    AGAIN = "one run in the direction of the relay that was not seen to open"
    CHECK = "saying that both relays have been looked at"
    HOME = "the same, and homing: the count is lost"
    CONFIRM = "saying where it points"
    TELL = "a stop, and saying where it points: nothing but the count knows"


@dataclass(frozen=True, slots=True)
class Outcome:
    fault: str = ""
    """What the box calls it; empty: it says nothing, and goes on."""
    within_s: float = 0.0
    """So soon after it struck in mid-move it is told, and the drive is off."""
    remedy: Remedy = Remedy.ACKNOWLEDGE
    turns_on: bool = False
    """Nothing that the box has can stop it."""
    notice: str = ""
    """What it begins to say though it goes on."""
    astray: bool = False
    """Without a word the box takes it for somewhere else: nothing tells it."""
    by_chance: str = ""
    """What the box may call it as well; empty: it always has one name."""
    before: bool = False
    """It strikes before the order, because it would not matter in mid-move."""


def goes_on(
    *, astray: bool = False, before: bool = False, notice: str = "", remedy: Remedy = Remedy.NOTHING
) -> Outcome:
    return Outcome(remedy=remedy, notice=notice, astray=astray, before=before)


BAD = "bad readings"
STANDS_STILL = "motor runs and pot stands still"
LOST = Remedy.HOME
# It arrives after at most 15 s; then a hand turns it for a second or two.
TURNED = Outcome("relay welded", 22.0, Remedy.AGAIN, turns_on=True)

HELD = Outcome("brake did not release", 3.0, Remedy.AGAIN, before=True)

RELAYS_AND_POTS = {
    "adc-gone": Outcome("sensor silent", 0.3),
    "pot-open": Outcome("pot open or shorted", 0.3),
    "pot-shorted": Outcome("pot open or shorted", 0.3),
    "pot-loose": Outcome("pot jumps", 0.3, Remedy.LATER, by_chance="pot open or shorted"),
    "pot-reversed": Outcome("pot moves the wrong way", 2.5),
    "pot-stuck": Outcome(STANDS_STILL, 2.0, Remedy.AGAIN),
    "pot-jumps": goes_on(),  # one reading that is far off moves nothing
    # Each tenth reading is ridden out, and is too many all the same.
    "pot-crackles": Outcome(BAD, 5.0, Remedy.LATER),
    "pot-spikes": Outcome(BAD, 5.0, Remedy.LATER),
    "adc-noisy": Outcome(BAD, 6.0, Remedy.LATER),
    "pot-bursts": Outcome("pot open or shorted", 3.5),  # four in a row
    "adc-gaps": Outcome("sensor silent", 3.0),
    "adc-frozen": Outcome(STANDS_STILL, 2.0),
    "pot-drifts": goes_on(),  # 0.4°/s, of a motor of 6
    "motor-stalled": Outcome(STANDS_STILL, 2.0, Remedy.AGAIN),
    "motor-reversed": Outcome("pot moves the wrong way", 1.0),
    "motor-slow": goes_on(),
    "hand-turns": TURNED,
    "wind-turns": goes_on(notice="turning with no relay on"),  # and is brought back, again and again
    "stop-early": goes_on(),
    "relay-welded-cw": TURNED,
    "relay-welded-up": TURNED,
    "relay-welded-ccw": Outcome(STANDS_STILL, 2.0, Remedy.CHECK, turns_on=True),
    "relay-welded-down": Outcome(STANDS_STILL, 2.0, Remedy.CHECK, turns_on=True),
}
WITH_SPEED = RELAYS_AND_POTS | {
    "dac-gone": Outcome("speed output", 1.1),  # its voltage is written at each change, and once a second
    "dac-noisy": Outcome("speed output", 6.0),
    "dac-gaps": goes_on(),
    "dac-dips": goes_on(),  # its voltage is written again every second
    "azimuth-wind-turns": TURNED,  # as fast as the motor at its lowest speed
}
COUNTED = {
    # Three periods of 5° at 6°/s are 2.5 s.
    "contact-stuck-open": Outcome("no pulses", 2.6, LOST),
    "contact-stuck-closed": Outcome("no pulses", 2.6, LOST),
    "motor-stalled": Outcome("no pulses", 2.6, LOST),
    "motor-slow": Outcome("count lost", 4.0, LOST),
    # Every fifth: the first one missed may be 25° away.
    "pulses-missed": Outcome("count lost", 5.5, LOST),
    "pulses-doubled": goes_on(),  # a contact cannot close again so soon
    "motor-reversed": goes_on(astray=True, before=True, remedy=LOST),  # a pulse does not say which way
    "hand-turns": Outcome("count lost", 15.0, LOST, turns_on=True),
    "relay-welded-cw": Outcome("count lost", 15.0, LOST, turns_on=True),
    "relay-welded-up": Outcome("count lost", 15.0, LOST, turns_on=True),
    "relay-welded-ccw": Outcome("no pulses", 2.6, LOST, turns_on=True),
    "relay-welded-down": Outcome("no pulses", 2.6, LOST, turns_on=True),
}
FIRMWARE = dict.fromkeys(
    (
        *("calibration", "gate-driver", "over-voltage", "encoder", "not-configured", "pwm-overrun"),
        *("over-temperature", "start-outside-limit", "under-voltage", "config-changed", "theta-invalid"),
        *("position-invalid", "driver-enable", "stop-position", "timing", "bemf-feedforward", "invalid-limits"),
        *("position-error", "velocity-error"),
    ),
    Outcome("controller fault", 0.1),
)
MOTEUS = FIRMWARE | {
    "silent": Outcome("controller silent", 0.5),
    "replies-lost": Outcome(BAD, 5.0, Remedy.LATER),
    "replies-gaps": Outcome(BAD, 5.0, Remedy.LATER),
    "jammed": Outcome("axis does not follow", 3.5),
    "factory-bounds": Outcome("axis does not follow", 3.5, notice="its position bounds"),  # as sold
    "power-cycled": Outcome("position unknown", 0.1, Remedy.CONFIRM),
}
SERVOS = {
    # The board is asked once a second, and noticed at once where it has to be written to.
    "board-unpowered": Outcome("servo board", 1.1),
    "board-dips": Outcome("servo board", 1.1),
    "board-gone": Outcome("servo board", 1.1),
    "board-noisy": Outcome("servo board", 1.1),
    "board-gaps": goes_on(),  # over before it moves on
    "wind-turns": goes_on(),  # it holds against the wind
    # Nothing comes back from a servo.
    "servo-stalled": goes_on(astray=True),
    "servo-unpowered": goes_on(astray=True),
}
BOXES = {
    "chip-dips": goes_on(),  # its step is said again every second
    # Nothing comes back from a control box either.
    "select-broken": goes_on(astray=True, before=True),
    "motor-stalled": goes_on(astray=True),
    "motor-slow": goes_on(),  # but until it arrives the box takes it for up to 30° further on
}
BRIDGES = {
    # At full speed nothing is written: it shows when the motor is to brake.
    "pwm-refuses": Outcome("motor driver", 16.0, Remedy.NOTHING),
    "motor-stalled": Outcome("no pulses", 1.5, Remedy.TELL),  # a dead encoder looks the same
    "encoder-dead": Outcome("no pulses", 1.5, Remedy.TELL),
    "encoder-channel-stuck": Outcome("no pulses", 1.5, Remedy.TELL),
    "motor-reversed": Outcome("pot moves the wrong way", 1.0),
    "motor-slow": goes_on(),
    "bridge-shorted-ccw": Outcome("pot moves the wrong way", 1.0),
    "bridge-shorted-down": Outcome("pot moves the wrong way", 1.0),
    # It shows when the axis has come to its place and does not stop.
    "bridge-shorted-cw": Outcome("pot moves the wrong way", 20.0),
    "bridge-shorted-up": Outcome("pot moves the wrong way", 20.0),
}
JUMPED = "its readings jumped to another place"
CONTROLLERS = {
    # It goes on to its last target: no stop reaches it.
    "controller-deaf": Outcome("controller silent", 1.4, turns_on=True),
    "controller-garbled": Outcome("controller not understood", 1.4, turns_on=True),
    "controller-unplugged": Outcome("controller silent", 0.2, turns_on=True),
    "controller-slow": goes_on(),
    "controller-ignores-stop": goes_on(),  # nothing stops it in mid-move: test_controllers.py
    # Turned the way that it goes anyhow, and beyond its target.
    "knob-turned": Outcome("axis does not follow", 18.0, turns_on=True),
    # The controller believes its sensor, and goes where that says.
    "jumps": goes_on(astray=True, notice=JUMPED),
    # With the time that a controller may take to turn round.
    "motor-stalled": Outcome("axis does not follow", 3.0),
    "motor-slow": goes_on(),
}
# Nothing comes back from a TV rotator: after any of these it points elsewhere, until it has been at its end stop.
BY_TIME = dict.fromkeys(
    (
        *("motor-stalled", "motor-slow", "motor-reversed", "hand-turns"),
        *("relay-welded-cw", "relay-welded-up", "relay-welded-ccw", "relay-welded-down"),
    ),
    goes_on(astray=True, before=True, remedy=LOST),
)
DRIVER = Outcome("stepper driver", 0.3, Remedy.HOME)
STEPPERS = {
    "chip-silent": Outcome("controller silent", 0.3),
    "chip-dips": Outcome("count lost", 0.3, Remedy.HOME),
    "chip-unpowered": Outcome("controller silent", 0.3, Remedy.HOME),
    "driver-hot": DRIVER,
    "driver-warm": goes_on(notice="its chip is hot"),
    "coil-short": DRIVER,
    "coil-open": Outcome("stepper driver", 0.5, Remedy.HOME),
    "enable-broken": DRIVER,
    "held": goes_on(astray=True, remedy=Remedy.HOME),  # without an encoder nobody counts what the motor does
    "switch-broken": goes_on(),  # it is asked at homing alone
}
OUTCOMES = {
    "g5500": RELAYS_AND_POTS,
    "ham4": RELAYS_AND_POTS | dict.fromkeys(("brake-stuck", "wedge-sticks"), HELD),
    "g1000": WITH_SPEED,
    "u100": COUNTED,
    "isel": MOTEUS,
    "servos": SERVOS,
    "orbit360": BOXES,
    "slew-drive": BRIDGES,
    "controller": CONTROLLERS,
    "tv-rotator": BY_TIME,
    "satnogs": STEPPERS,
}
REAL_TIME = {
    "g5500": {"bus-hung": Outcome("sensor late")},
    "ham4": {"bus-hung": Outcome("sensor late")},
    "g1000": {"bus-hung": Outcome("sensor late")},
    "servos": {"bus-hung": Outcome("axis does not follow")},
    "isel": {
        "adapter-unplugged": Outcome("controller silent"),
        "adapter-deaf": Outcome("controller silent"),
        "lines-dropped": Outcome("controller silent"),
        "lines-garbled": Outcome("controller silent"),
        "lines-late": Outcome("controller silent"),
    },
}
"""What needs threads: a bus that blocks whoever asks, and lines that come late."""


def plain(name: str) -> str:
    """A fault's name without its axis."""
    return name.removeprefix("azimuth-").removeprefix("elevation-")
