"""The hands on a simulated front panel: what a person says in words moves its switches and knobs.

Part of the composition root. Knows the simulated panel. A real panel has its own switches, and no program moves them.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from firmware_sim.panel import SimPanel
from firmware_sim.rotors.rotor import SimRotor
from hw.ports import Axis
from rotator.protocols.console_session import Hands
from rotator.protocols.panel_words import Hand, StopButton, ThrowJog, TurnKnob, TurnMode


def hands(world: SimRotor | None) -> Hands:
    """`world`: the simulated rotor with its panel; None: the hardware is real."""

    def move(hand: Hand) -> str:
        if world is None:
            return "this box is on real hardware: turn the panel's own switches"
        if world.panel is None:
            return "this box has no front panel: its file fits no part of [panel]"
        key, place, act = _part(world.panel, hand)
        if place is None:
            return f"this panel has no such part: {key} is not in the file"
        act()
        return ""

    return move


def _part(panel: SimPanel, hand: Hand) -> tuple[str, int | None, Callable[[], None]]:
    """The key of the part; its line or input, None where the panel lacks it; and what moves it."""
    spec = panel.spec
    match hand:
        case TurnMode(mode):
            from rotator.panel.inputs import POSITIONS  # noqa: PLC0415 - many a box has no panel

            return "panel.mode_msb", spec.mode_msb, partial(panel.turn_mode, POSITIONS.index(mode))
        case TurnKnob(axis, share):
            knob = spec.azimuth_knob if axis is Axis.AZIMUTH else spec.elevation_knob
            return f"panel.{axis.value}_knob", knob, partial(panel.turn_knob, axis.value, share)
        case ThrowJog(axis, direction, seconds):
            return "panel.jog", spec.jog, partial(panel.throw, axis.value, int(direction), seconds)
        case StopButton(pressed):
            return "panel.stop", spec.stop, panel.press_stop if pressed else panel.pull_stop
