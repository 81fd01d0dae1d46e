"""The sentences of the guides for each axis: names of the directions, the keys that turn it, what to look at.

Knows language. Does not know when a sentence is shown.
"""

from __future__ import annotations

from dataclasses import dataclass

from hw.ports import Axis
from rotator.control.axis.goals import UNCALIBRATED_JOG_S


@dataclass(frozen=True, slots=True)
class Phrases:
    axis: str
    plus: str
    minus: str
    plus_key: str
    minus_key: str
    arrows: str
    plus_relay: str
    minus_relay: str
    seen: str
    low_end: str
    high_end: str

    @property
    def keys(self) -> str:
        return (
            f"All keys: {self.plus_key} turns it {self.plus}, {self.minus_key} {self.minus}; space or s stops it; "
            "y, n, f, b, numbers and Enter answer; ? helps; q leaves, and nothing is saved."
        )

    @property
    def introduction(self) -> tuple[str, ...]:
        return (
            f"Setting up the {self.axis}. The box does not know its limits yet: be ready to cut the motors' supply.",
            f"  {self.plus_key} or {self.arrows}: {self.plus} / {self.minus} ({self.minus_key}), for as long as the "
            f"key is held; {self.plus_key.upper()} and {self.minus_key.upper()}: {UNCALIBRATED_JOG_S:g} s a press.",
            "  Space or s stops; ? says what is accepted; q or Ctrl-C leaves: the motors stop, nothing is saved.",
        )

    @property
    def direction_check(self) -> tuple[str, ...]:
        return (
            "1. Directions. The antenna should be in the middle of its travel, away from both stops.",
            f"   Turn it {self.plus} until you have clearly seen which way it goes.",
        )

    @property
    def turn_plus(self) -> str:
        return f"Press {self.plus_key} ({self.plus}) and watch the antenna."

    @property
    def turn_minus(self) -> str:
        return f"Now back: press {self.minus_key} ({self.minus})."

    @property
    def press_first(self) -> str:
        return f"Turn it first: {self.plus_key} is {self.plus}, {self.minus_key} is {self.minus}."

    @property
    def drive_then_read(self) -> str:
        return (
            f"Drive there with {self.plus_key} ({self.plus}) and {self.minus_key} ({self.minus}); then Enter reads it. "
            "b takes the last point back."
        )

    @property
    def did_it_turn(self) -> str:
        return f"Did the antenna turn {self.seen}? y or n:"

    @property
    def did_it_turn_back(self) -> str:
        return f"Did it turn back, {self.minus}? y or n:"

    @property
    def swap(self) -> str:
        return (
            f"Then swap {self.plus_relay} and {self.minus_relay} in [relays] of the file (or the two wires), and begin "
            "again. Nothing is saved."
        )

    def turned_wrong(self, remedy: str) -> str:
        """What to change when the antenna turned the other way; an empty `remedy` means the relays."""
        return f"Then {remedy}, and begin again. Nothing is saved." if remedy else self.swap

    @property
    def same_way(self) -> str:
        return (
            f"Refused: {self.plus} and {self.minus} move the reading the same way. Do both relays drive one direction? "
            "Nothing is saved."
        )

    @property
    def reads_backwards(self) -> str:
        return (
            f"Refused: it turned {self.plus}, and the reading fell. `forward` and `up` of {self.axis}.sensor do not "
            "match how the board is mounted (rotator help sensors). Nothing is saved."
        )

    @property
    def homing(self) -> tuple[str, ...]:
        return (
            f"   Watch the antenna: it turns {self.minus} to its stop, a little back, and there again.",
            "   The box cannot tell a stop from a branch that the antenna hangs in; you can. Space or s stops it.",
        )

    def limit(self, where: str) -> tuple[str, ...]:
        return (
            f"{where} angle that it may be sent to: drive it there, or type it.",
            "   A degree or two before its stop, or earlier, where cables, guy wires or a chimney are in the way.",
        )

    def drive_to(self, where: str) -> tuple[str, ...]:
        number, key, direction = (
            ("2", self.minus_key, self.minus) if where == self.low_end else ("3", self.plus_key, self.plus)
        )
        return (
            f"{number}. The {where}. Drive it there with {key} ({direction}): to its stop, or to a mark you trust.",
            "   Just before the stop is better than hard against it.",
        )

    @property
    def between(self) -> tuple[str, ...]:
        return (
            "4. Points between, if the pot is not straight: drive to an angle that you know, as many as you like.",
            "   Come to each from the same side: then the gear's play does not count.",
        )

    def summary(self, min_deg: float, max_deg: float) -> tuple[str, ...]:
        return ("", f"[{self.axis}]: the table above, limits {min_deg:g} to {max_deg:g}, direction checked.")

    def degrees_summary(self, min_deg: float, max_deg: float) -> tuple[str, ...]:
        return ("", f"[{self.axis}]: limits {min_deg:g} to {max_deg:g}, direction checked.")


AZIMUTH = Phrases(
    axis="azimuth",
    plus="clockwise",
    minus="counter-clockwise",
    plus_key="r",
    minus_key="l",
    arrows="the arrows right and left",
    plus_relay="azimuth_cw",
    minus_relay="azimuth_ccw",
    seen="clockwise, seen from above",
    low_end="low end (counter-clockwise)",
    high_end="high end (clockwise)",
)
ELEVATION = Phrases(
    axis="elevation",
    plus="up",
    minus="down",
    plus_key="u",
    minus_key="d",
    arrows="the arrows up and down",
    plus_relay="elevation_up",
    minus_relay="elevation_down",
    seen="up",
    low_end="low end (down)",
    high_end="high end (up)",
)


def phrases_for(axis: Axis) -> Phrases:
    return AZIMUTH if axis is Axis.AZIMUTH else ELEVATION
