"""The hands on a simulated front panel: what a person says in words moves its switches and knobs.

Part of the composition root. Knows the simulated panel. A real panel has its own switches, and no program moves them.
"""

from __future__ import annotations

from firmware_sim.panel import SimPanel
from firmware_sim.rotors.rotor import SimRotor
from rotator.exchange.orders import Mode
from rotator.protocols.console_session import Hands
from rotator.protocols.panel_words import Hand, StopButton, ThrowJog, TurnKnob, TurnMode


def hands(world: SimRotor | None) -> Hands:
    """`world`: the simulated rotor with its panel; None: the hardware is real."""

    def move(hand: Hand) -> str:
        if world is None:
            return "this box is on real hardware: turn the panel's own switches"
        if world.panel is None:
            return "this box has no front panel: its file fits no part of [panel]"
        if key := _unfitted(world.panel, hand):
            return f"this panel has no such part: {key} is not in the file"
        _move(world.panel, hand)
        return ""

    return move


def _unfitted(panel: SimPanel, hand: Hand) -> str:
    """The key of the part that the panel lacks for this; empty: it has it."""
    spec = panel.spec
    match hand:
        case TurnMode():
            key, place = "panel.mode_msb", spec.mode_msb
        case TurnKnob(axis):
            key = f"panel.{axis.value}_knob"
            place = spec.azimuth_knob if axis.value == "azimuth" else spec.elevation_knob
        case ThrowJog():
            key, place = "panel.jog", spec.jog
        case StopButton():
            key, place = "panel.stop", spec.stop
    return key if place is None else ""


def _move(panel: SimPanel, hand: Hand) -> None:
    from rotator.panel.inputs import POSITIONS  # noqa: PLC0415 - many a box has no panel

    match hand:
        case TurnMode(Mode() as mode):
            panel.turn_mode(POSITIONS.index(mode))
        case TurnKnob(axis, share):
            panel.turn_knob(axis.value, share)
        case ThrowJog(axis, direction, seconds):
            panel.throw(axis.value, int(direction), seconds)
        case StopButton(True):
            panel.press_stop()
        case StopButton():
            panel.pull_stop()
