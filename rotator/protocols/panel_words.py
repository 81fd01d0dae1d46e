"""What a person does with the switches and knobs of the simulated front panel, as words of the console.

Knows the words. Does not know the panel, nor what a switch does.
"""

from __future__ import annotations

from dataclasses import dataclass

from hw.ports import Axis, Direction
from rotator.exchange.orders import Mode
from rotator.protocols.aiming import degrees

LONGEST_THROW_S = 60.0
OPERANDS = "mode auto|manual|jog|park | knob azimuth|elevation SHARE | jog cw|ccw|up|down SECONDS | stop press|release"
TURNS = {
    "cw": (Axis.AZIMUTH, Direction.PLUS),
    "ccw": (Axis.AZIMUTH, Direction.MINUS),
    "up": (Axis.ELEVATION, Direction.PLUS),
    "down": (Axis.ELEVATION, Direction.MINUS),
}


@dataclass(frozen=True, slots=True)
class TurnMode:
    """Turn the mode switch."""

    mode: Mode


@dataclass(frozen=True, slots=True)
class TurnKnob:
    """Turn a knob to this share of its travel, 0 to 1."""

    axis: Axis
    share: float


@dataclass(frozen=True, slots=True)
class ThrowJog:
    """Hold a jog switch for so long."""

    axis: Axis
    direction: Direction
    seconds: float


@dataclass(frozen=True, slots=True)
class StopButton:
    """Press the stop button, or release it."""

    pressed: bool


Hand = TurnMode | TurnKnob | ThrowJog | StopButton


def parse_hand(words: list[str]) -> Hand:
    """From the words after `panel`. Raises ValueError for the operator."""
    match words:
        case ["mode", "auto" | "manual" | "jog" | "park" as mode]:
            return TurnMode(Mode(mode))
        case ["knob", "azimuth" | "elevation" as axis, text]:
            return TurnKnob(Axis(axis), _number(text, 1.0, "share of a knob's travel: 0 to 1"))
        case ["jog", turn, text] if turn in TURNS:
            seconds = _number(text, LONGEST_THROW_S, f"time: seconds, {LONGEST_THROW_S:g} at most")
            return ThrowJog(*TURNS[turn], seconds)
        case ["stop", "press" | "release" as what]:
            return StopButton(what == "press")
        case _:
            raise ValueError(f"write it like this: panel {OPERANDS}")


def _number(text: str, most: float, quantity: str) -> float:
    value = degrees(text)
    if value is None or not 0.0 <= value <= most:
        raise ValueError(f"{text[:20]!a} is no {quantity}")
    return value
