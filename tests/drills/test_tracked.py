"""What a drill takes for a flight of the box's own in force, and what ends one: judged from the script alone."""

from __future__ import annotations

import pytest

from benchmarks.drills.script import Event
from tests.drills.scripted import SOON_S, Script


def restart(script: Script) -> None:
    script.wait(1.0)
    script.orders.forget_all(script.now_s)
    script.wait(SOON_S)


@pytest.mark.parametrize("stopper", [("console", "stop"), ("panel", "stop", "press"), ("console", "storm")], ids=str)
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
