"""Which orders of a drill are in force, from its script alone: a stop holds over a restart of the program."""

from __future__ import annotations

import pytest

from benchmarks.drills.front_panel import STILL_AT_MOST_S
from benchmarks.drills.goals import Ranges
from benchmarks.drills.orders import Orders
from benchmarks.drills.script import Event

SOON_S = 0.05


class Script:
    """One event after the other, on a rotor of 360° and 180°. It begins when a mode switch would have been read."""

    def __init__(self) -> None:
        self.orders = Orders((Ranges(0.0, 360.0, False), Ranges(0.0, 180.0, False)), (0.0, 0.0))
        self.now_s = 0.0
        self.wait(STILL_AT_MOST_S)

    def say(self, who: str, what: str, *args: float | str) -> None:
        self.orders.note(Event(self.now_s, who, what, args))
        self.wait(SOON_S)

    def wait(self, seconds: float) -> None:
        self.now_s += seconds
        self.orders.expire(self.now_s)

    @property
    def moves(self) -> tuple[bool, bool]:
        """Whether each axis may move."""
        return self.orders.holds("azimuth"), self.orders.holds("elevation")


def restart(script: Script) -> None:
    script.wait(1.0)
    script.orders.forget_all(script.now_s)
    script.wait(SOON_S)


@pytest.mark.parametrize("stopper", [("console", "stop"), ("panel", "stop", "press")], ids=str)
def test_a_stop_holds_over_a_restart_until_a_person_resumes(stopper: tuple[str, ...]) -> None:
    script = Script()
    script.say(*stopper)
    restart(script)
    script.say("gs232b", "aim", 90.0, 45.0)
    assert script.orders.stops.latched
    assert script.moves == (False, False)
    if stopper[0] == "panel":
        script.say("panel", "stop", "pull")
    script.say("console", "resume")
    script.say("gs232b", "aim", 90.0, 45.0)
    assert script.moves == (True, True)


def test_a_stop_that_the_program_had_no_time_to_take_may_be_lost() -> None:
    script = Script()
    script.orders.note(Event(script.now_s, "console", "stop", ()))
    script.orders.forget_all(script.now_s + 0.1)
    assert not script.orders.stops.latched
