"""The sentences of the guides for each axis: names of the directions, the keys that turn it, what to look at.

Knows language. Does not know when a sentence is shown.
"""

from __future__ import annotations

from typing import Any

from hw.ports import Axis
from rotator.control.axis.goals import UNCALIBRATED_JOG_S

AZIMUTH = {
    "axis": "azimuth",
    "plus": "clockwise",
    "minus": "counter-clockwise",
    "plus_key": "r",
    "minus_key": "l",
    "arrows": "the arrows right and left",
    "plus_relay": "azimuth_cw",
    "minus_relay": "azimuth_ccw",
    "seen": "clockwise, seen from above",
    "low_end": "low end (counter-clockwise)",
    "high_end": "high end (clockwise)",
}
ELEVATION = {
    "axis": "elevation",
    "plus": "up",
    "minus": "down",
    "plus_key": "u",
    "minus_key": "d",
    "arrows": "the arrows up and down",
    "plus_relay": "elevation_up",
    "minus_relay": "elevation_down",
    "seen": "up",
    "low_end": "low end (down)",
    "high_end": "high end (up)",
}


class _Sentence:
    """With the words of the axis in the place of their names."""

    def __init__(self, *text: str) -> None:
        self._text = " ".join(text)

    def __get__(self, phrases: Phrases, _owner: type[Phrases]) -> str:
        return phrases.worded(self._text)


class _Lines:
    def __init__(self, *lines: str) -> None:
        self._lines = lines

    def __get__(self, phrases: Phrases, _owner: type[Phrases]) -> tuple[str, ...]:
        return tuple(map(phrases.worded, self._lines))


class Phrases:
    """`words`: AZIMUTH or ELEVATION."""

    plus = _Sentence("{plus}")
    minus = _Sentence("{minus}")
    low_end = _Sentence("{low_end}")
    high_end = _Sentence("{high_end}")
    keys = _Sentence(
        "All keys: {plus_key} turns it {plus}, {minus_key} {minus}; space or s stops it;",
        "y, n, f, b, numbers and Enter answer; ? helps; q leaves, and nothing is saved.",
    )
    introduction = _Lines(
        "Setting up the {axis}. The box does not know its limits yet: be ready to cut the motors' supply.",
        "  {plus_key} or {arrows}: {plus} / {minus} ({minus_key}), for as long as the key is held; {PLUS_KEY} and "
        "{MINUS_KEY}: {jog_s:g} s a press.",
        "  Space or s stops; ? says what is accepted; q or Ctrl-C leaves: the motors stop, nothing is saved.",
    )
    direction_check = _Lines(
        "The antenna should be in the middle of its travel, away from both stops.",
        "Turn it {plus} until you have clearly seen which way it goes.",
    )
    turn_plus = _Sentence("Press {plus_key} ({plus}) and watch the antenna.")
    turn_minus = _Sentence("Now back: press {minus_key} ({minus}).")
    page_turn_plus = _Sentence("Turn it {plus}.")
    page_turn_minus = _Sentence("Now turn it back, {minus}.")
    page_low_end = _Sentence("Turn it to its {low_end}.")
    page_high_end = _Sentence("Turn it to its {high_end}.")
    end = _Lines("To its stop, or to a mark you trust.", "Just before the stop is better than hard against it.")
    between = _Lines(
        "If the pot is not straight: drive to an angle that you know, as many as you like.",
        "Come to each from the same side: then the gear's play does not count.",
    )
    directions_right = _Sentence("Its buttons turn it the right way, {plus} and {minus}.")
    no_ends = _Sentence("The {axis} has no ends: it may be sent all the way round.")
    limit = _Lines("A degree or two before its stop, or earlier, where cables, guy wires or a chimney are in the way.")
    press_first = _Sentence("Turn it first: {plus_key} is {plus}, {minus_key} is {minus}.")
    drive_then_read = _Sentence(
        "Drive there with {plus_key} ({plus}) and {minus_key} ({minus}); then Enter reads it.",
        "b takes the last point back.",
    )
    did_it_turn = _Sentence("Did the antenna turn {seen}?")
    did_it_turn_back = _Sentence("Did it turn back, {minus}?")
    swap = _Sentence(
        "Then swap {plus_relay} and {minus_relay} in [relays] of the file (or the two wires), and begin again. "
        "Nothing is saved.",
    )
    same_way = _Sentence(
        "Refused: {plus} and {minus} move the reading the same way. Do both relays drive one direction? "
        "Nothing is saved.",
    )
    reads_backwards = _Sentence(
        "Refused: it turned {plus}, and the reading fell. forward and up of {axis}.sensor do not match how the "
        "board is mounted (rotator help sensors). Nothing is saved.",
    )
    homing = _Lines(
        "Watch the antenna: it turns {minus} to its stop, a little back, and there again.",
        "The box cannot tell a stop from a branch that the antenna hangs in, but you can.",
    )
    stopwatch = _Lines(
        "The box turns the {axis} from stop to stop, and you watch the antenna: answer when it has arrived and stands.",
        "The rotor's own end switches must work.",
    )
    to_low_stop = _Sentence("First {minus}, to its stop. This way is not timed.")
    time_to_high = _Sentence("Now {plus}, to the other stop. The watch runs from the motor's start to your answer.")
    time_to_low = _Sentence("And back, {minus}.")
    too_slow = _Sentence(
        "if it was still on its way, the rotor is slower than the file says: write a smaller {axis}.speed_dps, "
        "take the times out, and begin again.",
    )
    to_low_end = _Sentence("2. The {low_end}. Drive it there with {minus_key} ({minus}).")
    to_high_end = _Sentence("3. The {high_end}. Drive it there with {plus_key} ({plus}).")

    def __init__(self, words: dict[str, str]) -> None:
        capitals = {name.upper(): words[name].upper() for name in ("plus_key", "minus_key")}
        self._words: dict[str, Any] = words | capitals | {"jog_s": UNCALIBRATED_JOG_S}

    def worded(self, text: str) -> str:
        return text.format_map(self._words)

    def timed(self, times_s: tuple[float, float]) -> tuple[str, str]:
        return (
            f"From stop to stop it takes {times_s[0]:g} s {self.plus} and {times_s[1]:g} s {self.minus}.",
            "Its angle is reckoned by these times, so it drifts with wind and cold: home it now and then.",
        )

    def may_be_sent(self, low_deg: float, high_deg: float) -> str:
        return f"The {self._words['axis']} may be sent to angles from {low_deg:g}° to {high_deg:g}°."

    def turned_wrong(self, remedy: str) -> str:
        """What to change when the antenna turned the other way; an empty `remedy` means the relays."""
        return f"Then {remedy}, and begin again. Nothing is saved." if remedy else self.swap


def phrases_for(axis: Axis) -> Phrases:
    return Phrases(AZIMUTH if axis is Axis.AZIMUTH else ELEVATION)
