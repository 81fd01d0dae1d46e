"""Any sequence of switches and knobs: nothing moves that the stop button, the mode or two switches forbid."""

from __future__ import annotations

from dataclasses import replace

from hypothesis import given, settings
from hypothesis import strategies as st

from rotator.exchange.orders import Aim, Home, Jog, Mode, Nudge, Release, SetMode, Stop
from rotator.panel.ladder import thrown
from tests.panel.person import AZ, BITS, CCW, CENTRE, CW, CW_AND_UP, DOWN, LATCHED, OFF, STILL, UP, Person
from tests.search import examples

Deed = list[tuple[dict[str, object], int]]
"""(inputs that change, number of steps that they stay so), one after the other."""
LOOKS = st.sampled_from([25, 3, 1])
SINGLES = st.sampled_from([CW, CCW, UP, DOWN])
JOG_INPUT = st.sampled_from([CW_AND_UP, CENTRE, CW, CCW, UP, DOWN, 0.61, 0.0, None])
KNOBS = st.sampled_from(["azimuth_knob", "elevation_knob"])
DEEDS: st.SearchStrategy[Deed] = st.one_of(
    st.builds(lambda way, looks: [({"jog": CENTRE}, 3), ({"jog": way}, looks)], SINGLES, LOOKS),
    st.builds(lambda share, looks: [({"jog": share}, looks)], JOG_INPUT, LOOKS),
    st.builds(
        lambda knob, share, looks: [({knob: share}, looks)], KNOBS, st.sampled_from([0.3, 0.6, 1.0, None]), LOOKS
    ),
    st.builds(lambda bits, looks: [({"mode_bits": bits}, looks)], st.sampled_from([*BITS, None]), LOOKS),
    st.builds(lambda is_open, looks: [({"stop_open": is_open}, looks)], st.booleans(), LOOKS),
    st.builds(lambda who: [({"latched": who}, 1)], st.sampled_from(["", "console"])),
    st.just([({"stop_open": False}, 3), ({"latched": ""}, 3)]),
)


@settings(max_examples=examples(200), deadline=None)
@given(st.lists(DEEDS, min_size=5, max_size=30), st.sampled_from(list(BITS)), st.sampled_from([False, False, True]))
def test_nothing_moves_that_the_stop_button_the_mode_or_two_switches_forbid(
    deeds: list[Deed], bits: tuple[bool, bool], calibrate: bool
) -> None:
    person = Person()
    person.waits(1.5, mode_bits=bits, calibrate=calibrate)
    mode = Mode.MANUAL if calibrate else BITS[bits]
    for parts, looks in (each for deed in deeds for each in deed):
        if "latched" in parts:
            person.status = replace(STILL, latched=str(parts["latched"]))
        for _ in range(looks):
            latched = person.status.latched
            for order in person.sees(**{part: value for part, value in parts.items() if part != "latched"}):
                look = person.look
                assert isinstance(order, Stop) or not look.stop_open
                match order:
                    case SetMode():
                        mode = order.mode
                    case Stop(latch=True):
                        person.status = LATCHED
                    case Release():
                        person.status = STILL
                    case Home():
                        assert calibrate
                    case Jog(axis, direction):
                        assert (mode, latched) == (Mode.JOG, "")
                        assert look.jog is not None
                        assert thrown(look.jog) == ((direction, OFF) if axis is AZ else (OFF, direction))
                    case Aim():
                        assert (mode, latched) == (Mode.MANUAL, "")
                    case Nudge():
                        assert (mode, latched) == (Mode.AUTO, "")
