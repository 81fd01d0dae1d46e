"""What a drill takes for a flight of the box's own in force, and what ends one: judged from the script alone."""

from __future__ import annotations

import pytest

from benchmarks.drills.script import Event
from benchmarks.drills.tracked import RESTS_S
from tests.drills.scripted import SOON_S, Script

ARC = "arc 0 120 40 90 1 60"


@pytest.mark.parametrize(
    ("who", "what", "moves"),
    [
        ("gs232b", "stop", (False, False)),
        ("gs232b", "ask", (True, True)),
        ("console-2", "stop", (False, False)),
        ("console", "let-go", (False, False)),
        ("panel", "stop", (False, False)),
    ],
)
def test_a_stop_ends_what_is_tracked_also_while_its_plan_is_computed(
    who: str, what: str, moves: tuple[bool, bool]
) -> None:
    script = Script()
    script.say("console", "track", ARC)
    assert script.moves == (True, True)
    script.say(who, what, *(["press"] if who == "panel" else []))
    script.wait(60.0)
    assert script.moves == moves


def test_a_release_brings_no_flight_back() -> None:
    script = Script()
    script.say("console", "track", ARC)
    script.say("console", "stop")
    script.say("console", "resume")
    assert script.moves == (False, False)
    script.say("console", "track", ARC)
    assert script.moves == (True, True)


def test_track_off_ends_it_and_no_other_order() -> None:
    script = Script(follows=True)
    script.say("console", "track", ARC)
    script.say("console", "track", "off")
    assert script.moves == (False, False)
    script.say("gs232b", "aim-azimuth", 90.0)
    script.say("console", "track", "off")
    assert script.moves == (True, False)


def test_nothing_is_tracked_while_a_stop_is_latched() -> None:
    script = Script()
    script.say("console", "stop")
    script.say("console", "track", ARC)
    script.say("console-2", "resume")
    assert script.moves == (False, False)


def test_what_the_configuration_follows_is_an_order_and_rests_after_a_stop() -> None:
    script = Script(follows=True)
    assert script.moves == (True, True)
    script.say("gs232b", "stop")
    script.wait(RESTS_S - 1.0)
    assert script.moves == (False, False)
    script.wait(2.0)
    assert script.moves == (True, True)


def test_another_program_takes_the_antenna_and_no_late_plan_takes_it_back() -> None:
    script = Script()
    script.say("console", "track", ARC)
    script.wait(20.0)
    script.say("rotctld", "aim", 200.0, 20.0)
    script.say("rotctld", "stop-axis", "elevation")
    assert script.moves == (True, False)


def test_a_program_that_sent_before_may_go_on_while_the_plan_is_computed() -> None:
    script = Script()
    script.say("rotctld", "aim", 200.0, 20.0)
    script.wait(20.0)
    script.say("console", "track", ARC)
    script.say("rotctld", "aim", 210.0, 20.0)
    assert {"track", "rotctld"} <= script.orders.axes["azimuth"].goals.keys()


def test_a_recognised_stream_is_flown_anywhere_also_when_it_goes_on_after_a_stop() -> None:
    script = Script()
    script.say("gs232b", "aim", 90.0, 20.0)
    script.say("gs232b", "recognised", ARC)
    script.say("gs232b", "aim", 91.0, 20.0)
    assert script.orders.axes["azimuth"].goals["gs232b"].angles_deg == ()
    script.say("console", "stop")
    assert not script.orders.axes["azimuth"].goals
    script.say("console", "resume")
    script.say("gs232b", "aim", 91.0, 20.0)
    assert script.orders.axes["azimuth"].goals["gs232b"].angles_deg == ()


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


def test_a_restart_releases_no_mode_switch() -> None:
    script = Script()
    script.say("panel", "mode", "park")
    for _ in range(40):
        script.wait(SOON_S)
    restart(script)
    script.say("gs232b", "aim", 90.0, 45.0)
    assert script.moves == (False, False)
