"""What can be wrong with an axis: every kind of fault, every reason not to be commissioned, and notices.

Knows the short texts that displays and protocols have for them. Knows neither when a fault arises nor what it stops.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum, IntFlag

from hw.ports import Axis


class EasycommError(IntFlag):
    """The bits of EasyComm III's error register (`GE`)."""

    SENSOR = 1
    JAM = 2
    NOT_CALIBRATED = 4
    MOTOR = 8


class FaultKind(Enum):
    """Every kind of fault: its name, its text on the LCD beside the axis (13 characters at most), its EasyComm bit, and
    what a person does about it, where AXIS stands for the axis.
    """

    POT_OPEN = "pot open or shorted", "POT OPEN/SHRT", EasycommError.SENSOR, "Check the pot's wires and its supply"
    SENSOR_SILENT = "sensor silent", "SENSOR SILENT", EasycommError.SENSOR, "Check the sensor's wires and its supply"
    SENSOR_LATE = (
        "sensor late",
        "SENSOR LATE",
        EasycommError.SENSOR,
        "Check the sensor's wires; look for a program that slows this computer down",
    )
    POT_JUMPS = (
        "pot jumps",
        "POT JUMPS",
        EasycommError.SENSOR,
        "Look for a loose wire, a worn pot, or your own transmitter",
    )
    BAD_READINGS = (
        "bad readings",
        "BAD READINGS",
        EasycommError.SENSOR,
        "Look for a loose wire, a worn pot, or motor cables beside the sensor's",
    )
    WRONG_WAY = (
        "pot moves the wrong way",
        "WRONG WAY",
        EasycommError.SENSOR,
        "Look which way the antenna turned: swap the pot's two ends, or the motor's two directions",
    )
    STANDS_STILL = (
        "motor runs and pot stands still",
        "STANDS STILL",
        EasycommError.JAM,
        "Check the motor's fuse and supply; look for ice, a rope, a guy wire",
    )
    BRAKE_HELD = (
        "brake did not release",
        "BRAKE HOLDS",
        EasycommError.JAM,
        "Listen for its solenoid: check the brake's relay and supply; a wedge may stick; then look for ice, a rope",
    )
    RUN_TOO_LONG = (
        "motor on longer than the travel takes",
        "RUN TOO LONG",
        EasycommError.JAM,
        "Look for a slow motor, or a pot that slips on its shaft",
    )
    END_STOP = "end stop reached", "END STOP", EasycommError.JAM, "Set the limit one degree inside this angle"
    LIMIT_SWITCH = (
        "limit switch reached",
        "LIMIT SWITCH",
        EasycommError.JAM,
        "Turn it the other way; far from an end, check the switch and its wires",
    )
    NOT_FOLLOWING = (
        "axis does not follow",
        "NOT FOLLOWING",
        EasycommError.JAM,
        "Look for what holds the antenna; check the motor's supply",
    )
    RELAY_WELDED = "relay welded", "RELAY WELDED", EasycommError.MOTOR, "Switch the motors off, and replace the relay"
    RELAY_UNSEEN = (
        "relay not seen to open",
        "RELAY OPEN?",
        EasycommError.MOTOR,
        "Jog it the same way for a second; or look at both relays, then: rotator relays-checked AXIS",
    )
    TURNS_BY_ITSELF = (
        "turning with no relay on",
        "TURNS BY SELF",
        EasycommError.MOTOR,
        "Look for a hand at the control box, strong wind, a relay that is stuck",
    )
    CONTROL_LATE = (
        "control thread late",
        "CONTROL LATE",
        EasycommError.MOTOR,
        "Look for a program that slows this computer down",
    )
    NO_PULSES = "no pulses", "NO PULSES", EasycommError.JAM, "Check the motor, then the contact and its wires"
    COUNT_LOST = "count lost", "COUNT LOST", EasycommError.NOT_CALIBRATED, "Find its end stop again: rotator home AXIS"
    COUNT_NOT_KEPT = "count not kept", "COUNT UNKEPT", EasycommError.SENSOR, "Look for a full or read-only card"
    NOT_HOMED = (
        "not homed",
        "NOT HOMED",
        EasycommError.NOT_CALIBRATED,
        "Correct that, then home it again and watch: rotator home AXIS",
    )
    CONTROLLER_FAULT = "controller fault", "CTRL FAULT", EasycommError.MOTOR, "The axis is loose until you release it"
    CONTROLLER_SILENT = (
        "controller silent",
        "CTRL SILENT",
        EasycommError.SENSOR,
        "Check the controller's supply and the CAN wires",
    )
    CONTROLLER_GARBLED = (
        "controller not understood",
        "CTRL GARBLED",
        EasycommError.SENSOR,
        "Compare protocol and baud rate with the controller's own settings",
    )
    CONTROLLER_RUNS_ON = (
        "controller does not stop",
        "CTRL RUNS ON",
        EasycommError.MOTOR,
        "Switch the controller off; then look at its own stop, and at who else gives it orders",
    )
    POSITION_UNKNOWN = (
        "position unknown",
        "POS UNKNOWN",
        EasycommError.NOT_CALIBRATED,
        "Look where the antenna points, then: rotator confirm AXIS DEGREES",
    )
    MOTOR_DRIVER = "motor driver", "MOTOR DRIVER", EasycommError.MOTOR, "Check the PWM of this Pi: rotator doctor"
    SPEED_OUTPUT = (
        "speed output",
        "SPEED OUTPUT",
        EasycommError.MOTOR,
        "Check what makes the speed input's voltage: rotator doctor",
    )
    STEPPER_DRIVER = (
        "stepper driver",
        "STEP DRIVER",
        EasycommError.MOTOR,
        "Check the motor's wires, its current and the chip's cooling",
    )
    STEPS_LOST = (
        "steps lost",
        "STEPS LOST",
        EasycommError.JAM,
        "Look for what holds the antenna; more current, or slower",
    )
    SERVO_BOARD = "servo board", "SERVO BOARD", EasycommError.MOTOR, "Check the board's wires and its 3.3 V supply"

    def __init__(self, text: str, lcd: str, easycomm: EasycommError, advice: str) -> None:
        self.text = text
        self.lcd = lcd
        self.easycomm = easycomm
        self.advice = advice

    @property
    def anchor(self) -> str:
        """The heading of this fault on its page of the documentation, as the page's links name it."""
        return self.text.replace(" ", "-")


LATE = frozenset({FaultKind.SENSOR_LATE, FaultKind.CONTROL_LATE})
"""The computer was too slow, or a bus hung for a moment: nothing is known to be wrong with the axis itself."""

POT = "pot"
OF_ANOTHER_SENSOR = {
    FaultKind.POT_OPEN: ("SENSOR shows no angle", "NO ANGLE", "Check the SENSOR's wires, its supply and its place"),
    FaultKind.POT_JUMPS: (
        "SENSOR jumps",
        "ANGLE JUMPS",
        "Look for a loose wire or magnet, your own transmitter, or an angle that was confirmed wrong",
    ),
    FaultKind.BAD_READINGS: (
        FaultKind.BAD_READINGS.text,
        FaultKind.BAD_READINGS.lcd,
        "Look for a loose wire, or motor cables beside the SENSOR's",
    ),
    FaultKind.WRONG_WAY: (
        "SENSOR moves the wrong way",
        FaultKind.WRONG_WAY.lcd,
        "Look which way the antenna turned: swap the motor's two directions, or those of the SENSOR",
    ),
    FaultKind.STANDS_STILL: (
        "motor runs and SENSOR stands still",
        FaultKind.STANDS_STILL.lcd,
        FaultKind.STANDS_STILL.advice,
    ),
    FaultKind.RUN_TOO_LONG: (
        FaultKind.RUN_TOO_LONG.text,
        FaultKind.RUN_TOO_LONG.lcd,
        "Look for a slow motor, or a SENSOR that slips on its shaft",
    ),
}
"""What the faults that speak of a pot are called where another SENSOR reads the angle: text, LCD, and advice."""


@dataclass(frozen=True, slots=True)
class Fault:
    """One fault that stopped an axis: what was measured, the limit it broke, and the page that explains it."""

    kind: FaultKind
    axis: Axis
    measured: str
    limit: str = ""
    """The limit that was exceeded, with its unit; empty where the fault has no limit."""
    page: str = "docs/troubleshooting.md"
    cut: bool = False
    """Opening the relay does not stop the motor: its supply has to be switched off."""
    act_now: str = ""
    """What a person must do this moment, in a few words in capitals; empty: nothing."""
    passing: bool = False
    """The fault ends with its cause, without being acknowledged."""
    sensor: str = POT
    """What reads the angle of this axis, in a word."""
    advice: str = ""
    """What a person does about it; empty: what its kind says."""

    @property
    def name(self) -> str:
        return self.kind.text

    @property
    def lcd(self) -> str:
        """Its text on the LCD beside the axis."""
        return self._words[1]

    @property
    def exceeded(self) -> str:
        """What was measured, and the limit that it broke."""
        return f"{self.measured}, limit {self.limit}" if self.limit else self.measured

    def told(self, words: str) -> Fault:
        """The same, with these words in place of what was measured and its limit."""
        return replace(self, measured=words, limit="")

    @property
    def _words(self) -> tuple[str, str, str]:
        """Text, LCD, and advice, as they fit the sensor of the axis."""
        own = self.kind.text, self.kind.lcd, self.kind.advice
        text, lcd, advice = own if self.sensor == POT else OF_ANOTHER_SENSOR.get(self.kind, own)
        return text.replace("SENSOR", self.sensor), lcd, advice.replace("SENSOR", self.sensor)

    def __str__(self) -> str:
        loud = f"{self.act_now} " if self.act_now else ""
        text, _, advice = self._words
        advice = (self.advice or advice).replace("AXIS", self.axis.value)
        seen = f"{self.axis.value}: {text}: {self.exceeded}"
        return f"{loud}{seen}. {advice} (rotator help {self.kind.anchor})"


class Missing(Enum):
    """Why an axis may not be aimed yet: its text, and its text on the LCD beside the axis."""

    CALIBRATION = "calibration", "UNCALIBRATED"
    LIMITS = "limits", "UNCALIBRATED"
    DIRECTION_CHECK = "direction check", "UNCALIBRATED"
    HOMING = "homing", "NOT HOMED"

    def __init__(self, text: str, lcd: str) -> None:
        self.text = text
        self.lcd = lcd


NOTICED_FOR_S = 3.0
"""A notice stays this long after its cause, so that it can be read."""


@dataclass(frozen=True, slots=True)
class Notice:
    """A remark on an axis, for a person. It stops no motor."""

    text: str
    lcd: str = ""
    """Its text on the LCD beside the axis, 13 characters at most; empty: only the log and the screens show it."""

    def __str__(self) -> str:
        return self.text
