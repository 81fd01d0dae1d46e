"""The front panel as its builder describes it: what each switch does in each mode, and what it never does."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hw.ports import AngleSource, Axis, Direction
from rotator.faults import Missing
from rotator.orders import Aim, Home, Jog, Mode, Nudge, Order, Release, SetMode, Stop
from rotator.panel.ladder import HALF_BAND, LEVELS, level, thrown
from rotator.panel.panel import LAMPS, Panel, PanelInputs, PanelOutput, PanelSettings
from rotator.status import AxisStatus, Status

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
PLUS, MINUS, OFF = Direction.PLUS, Direction.MINUS, Direction.OFF
LOOK_S = 0.05
about: Any = pytest.approx
"""An angle in an order that is compared, to a float's last digits."""
MANUAL, PARK, AUTO, JOG = (False, False), (False, True), (True, False), (True, True)
BITS = {MANUAL: Mode.MANUAL, PARK: Mode.PARK, AUTO: Mode.AUTO, JOG: Mode.JOG}
STILL = Status(
    0.0, AxisStatus(0.0, 360.0, angle_deg=90.0, source=AngleSource.COUNTED), AxisStatus(0.0, 180.0, angle_deg=45.0)
)
LATCHED = replace(STILL, latched="panel")
CENTRE, CW, CCW, UP, DOWN = (level(way) for way in ((OFF, OFF), (PLUS, OFF), (MINUS, OFF), (OFF, PLUS), (OFF, MINUS)))
CW_AND_UP = level((PLUS, PLUS))


@dataclass
class Person:
    """At the panel, with time in hand."""

    panel: Panel = field(default_factory=lambda: Panel(PanelSettings()))
    look: PanelInputs = field(
        default_factory=lambda: PanelInputs(mode_bits=AUTO, jog=CENTRE, azimuth_knob=0.0, elevation_knob=0.0)
    )
    status: Status = STILL
    looks: int = 0
    act: PanelOutput = field(default_factory=lambda: PanelOutput((), {}, {}))

    def sees(self, **parts: object) -> list[Order]:
        """One step of the panel, with these inputs changed."""
        self.look = replace(self.look, **parts)  # type: ignore[arg-type]
        self.looks += 1
        self.act = self.panel.step(100.0 + self.looks * LOOK_S, self.look, self.status)
        return list(self.act.orders)

    def waits(self, seconds: float, **parts: object) -> list[Order]:
        """What is ordered meanwhile."""
        return [order for _ in range(round(seconds / LOOK_S)) for order in self.sees(**parts)]

    def lit(self) -> set[str]:
        return {name for name, on in self.act.lamps.items() if on}


def at_the_panel(bits: tuple[bool, bool], settings: PanelSettings | None = None) -> Person:
    """With the mode set, and every switch released."""
    person = Person(Panel(settings or PanelSettings()))
    assert person.waits(1.5, mode_bits=bits) == [SetMode(BITS[bits])]
    return person


# --- the ladder


def test_the_ladder_s_levels_are_those_of_its_description() -> None:
    described = {
        (MINUS, MINUS): 0.232, (MINUS, OFF): 0.288, (OFF, MINUS): 0.353, (MINUS, PLUS): 0.426, (OFF, OFF): 0.500,
        (PLUS, MINUS): 0.574, (OFF, PLUS): 0.647, (PLUS, OFF): 0.712, (PLUS, PLUS): 0.768,
    }  # fmt: skip
    assert {throw: round(share, 3) for throw, share in LEVELS.items()} == described


def test_no_two_bands_meet() -> None:
    assert min(high - low for low, high in pairwise(sorted(LEVELS.values()))) > 2 * HALF_BAND


@pytest.mark.parametrize("throw", LEVELS)
def test_a_band_is_as_wide_as_resistors_of_one_percent_and_a_supply_3_percent_off(
    throw: tuple[Direction, Direction],
) -> None:
    share = level(throw)
    worst = 2 * 0.01 * share * (1 - share) + 0.03 * share
    if throw != (PLUS, PLUS):  # two at once may fall out of their band: that is no jog either
        assert thrown(share - worst * 0.99) == thrown(share + worst * 0.99) == throw


@pytest.mark.parametrize("share", [0.0, 0.1, 0.32, 0.39, 0.46, 0.54, 0.61, 0.68, 0.9, 1.0, 1.05])
def test_a_reading_between_bands_or_at_an_end_is_nothing(share: float) -> None:
    assert thrown(share) is None


# --- the mode switch


@pytest.mark.parametrize(("bits", "mode"), BITS.items())
def test_at_the_start_the_mode_is_set_after_a_second(bits: tuple[bool, bool], mode: Mode) -> None:
    person = Person()
    assert person.waits(1.0, mode_bits=bits) == []
    assert person.sees() == [SetMode(mode)]


def test_a_mode_must_be_still_for_a_second_and_is_lit_meanwhile() -> None:
    person = at_the_panel(AUTO)
    assert person.lit() == {"auto"}
    assert person.waits(0.9, mode_bits=PARK) == []
    assert person.lit() == {"auto", "park", "switch"}
    assert person.waits(0.2) == [Release(), SetMode(Mode.PARK)]
    assert person.lit() == {"park"}


def test_positions_on_the_way_set_no_mode() -> None:
    person = at_the_panel(AUTO)
    assert person.waits(0.8, mode_bits=PARK) == []
    assert person.waits(0.8, mode_bits=MANUAL) == []
    assert person.waits(3.0, mode_bits=AUTO) == []


def test_a_mode_switch_that_bounces_tells_nothing() -> None:
    person = at_the_panel(AUTO)
    for _ in range(100):
        assert person.sees(mode_bits=PARK) == person.sees(mode_bits=MANUAL) == []


def test_a_mode_switch_that_cannot_be_read_for_a_while_has_not_been_turned() -> None:
    person = at_the_panel(AUTO)
    assert person.waits(3.0, mode_bits=None) == person.waits(3.0, mode_bits=AUTO) == []


def test_without_a_mode_switch_no_mode_is_set_and_the_jog_switches_nudge() -> None:
    person = Person(Panel(PanelSettings(mode_switch=False)))
    assert person.waits(3.0, mode_bits=None) == []
    assert person.waits(0.2, jog=CW) == [Nudge(AZ, 5.0)]
    assert person.lit() == {"switch"}


# --- AUTO


def test_in_auto_a_press_is_one_index_however_long_it_is_held() -> None:
    person = at_the_panel(AUTO)
    assert person.waits(5.0, jog=CW) == [Nudge(AZ, 5.0)]
    assert person.lit() == {"auto", "switch"}
    assert person.waits(0.2, jog=CENTRE) == []
    assert person.lit() == {"auto"}
    assert person.waits(0.2, jog=CW) == [Nudge(AZ, 10.0)]


def test_every_switch_nudges_its_axis_its_way() -> None:
    person = at_the_panel(AUTO, PanelSettings(nudge_deg={AZ: 5.0, EL: 10.0}))
    for share, nudge in ((UP, Nudge(EL, 10.0)), (DOWN, Nudge(EL, 0.0)), (DOWN, Nudge(EL, -10.0)), (CCW, Nudge(AZ, -5))):
        assert person.waits(0.2, jog=share) == [nudge]
        assert person.waits(0.2, jog=CENTRE) == []


def test_nudges_end_at_minus_seven_and_plus_eight() -> None:
    person = at_the_panel(AUTO)
    assert presses(person, CW, 12)[-1:] == [Nudge(AZ, 40.0)]
    assert person.waits(0.2, jog=CW) == []
    assert "switch" not in person.lit()  # not acknowledged
    assert len(presses(person, CCW, 20)) == 15
    assert presses(person, CW, 1) == [Nudge(AZ, -30.0)]


def presses(person: Person, share: float, count: int) -> list[Order]:
    return [order for _ in range(count) for jog in (CENTRE, share, CENTRE) for order in person.waits(0.15, jog=jog)]


def test_a_change_of_mode_forgets_the_nudges() -> None:
    person = at_the_panel(AUTO)
    presses(person, CW, 3)
    person.waits(1.5, mode_bits=PARK)
    person.waits(1.5, mode_bits=AUTO)
    assert presses(person, CW, 1) == [Nudge(AZ, 5.0)]


def test_a_single_odd_reading_does_nothing() -> None:
    person = at_the_panel(AUTO)
    assert person.sees(jog=CW) == person.waits(0.5, jog=CENTRE) == []
    person.waits(0.2, jog=UP)
    assert person.sees(jog=CENTRE) == person.waits(0.5, jog=UP) == []  # held all the time


def test_knobs_do_nothing_in_auto() -> None:
    person = at_the_panel(AUTO)
    assert person.waits(3.0, azimuth_knob=0.5) == []
    assert person.act.meters == {AZ: 0.25, EL: 0.25}


# --- MANUAL


def test_in_manual_the_knobs_show_on_the_meters_and_send_the_rotors_a_second_after_they_stop() -> None:
    person = at_the_panel(MANUAL)
    assert person.act.meters == {AZ: 0.25, EL: 0.25}
    for turned in range(10):
        assert person.sees(azimuth_knob=turned / 20, elevation_knob=turned / 10) == []
    assert person.act.meters == {AZ: 0.45, EL: 0.9}
    assert person.waits(0.95) == []
    assert person.sees() == [Aim(about(162.0), about(162.0))]
    assert person.act.meters == {AZ: 0.25, EL: 0.25}
    assert person.waits(5.0) == []


def test_a_knob_that_was_not_turned_leaves_its_axis_where_it_is() -> None:
    person = at_the_panel(MANUAL)
    assert person.waits(2.0, elevation_knob=0.5) == [Aim(None, about(90.0))]


def test_both_knobs_must_have_stopped() -> None:
    person = at_the_panel(MANUAL)
    assert person.waits(0.8, azimuth_knob=0.5) == []
    assert person.waits(0.95, elevation_knob=0.5) == []
    assert person.waits(0.1) == [Aim(about(180.0), about(90.0))]


def test_jitter_of_one_count_is_ignored() -> None:
    person = at_the_panel(MANUAL)
    for _ in range(50):
        assert person.sees(azimuth_knob=1 / 255) == person.sees(azimuth_knob=0.0) == []
    assert person.waits(2.0, azimuth_knob=2 / 255) == [Aim(about(360 * 2 / 255), None)]


def test_a_knob_turned_before_the_mode_was_set_orders_nothing() -> None:
    person = at_the_panel(PARK)
    person.sees(azimuth_knob=0.7, mode_bits=MANUAL)
    assert person.waits(0.5, azimuth_knob=0.9) == []
    assert person.waits(5.0) == [Release(), SetMode(Mode.MANUAL)]


def test_a_knob_that_is_read_again_was_not_turned() -> None:
    person = at_the_panel(MANUAL)
    assert person.waits(1.0, azimuth_knob=None) == person.waits(3.0, azimuth_knob=0.6) == []


def test_jog_switches_do_nothing_in_manual() -> None:
    assert at_the_panel(MANUAL).waits(2.0, jog=CW) == []


# --- PARK


def test_in_park_knobs_only_show_and_nothing_moves() -> None:
    person = at_the_panel(PARK)
    assert person.waits(3.0, azimuth_knob=0.8, jog=UP) == []
    assert person.act.meters == {AZ: 0.8, EL: 0.0}


# --- JOG


def test_in_jog_it_drives_while_held_and_stops_when_let_go() -> None:
    person = at_the_panel(JOG)
    assert person.waits(0.5, jog=CCW) == [Jog(AZ, MINUS, 0.3)] * 9  # renewed with every step
    assert person.lit() == {"jog", "switch"}
    assert person.waits(1.0, jog=CENTRE) == [Stop((AZ,))]


@pytest.mark.parametrize("jog", [CW_AND_UP, UP, None, 0.0, 1.0], ids=["two", "other", "gone", "ground", "supply"])
def test_any_other_reading_stops_it_until_all_switches_are_released(jog: float | None) -> None:
    person = at_the_panel(JOG)
    person.waits(0.5, jog=CW)
    assert person.waits(1.0, jog=jog) == [Stop((AZ,))]
    assert person.waits(1.0, jog=CW) == []
    assert person.waits(0.2, jog=CENTRE) == []
    assert person.waits(0.1, jog=CW) == [Jog(AZ, PLUS, 0.3)]


def test_two_at_once_do_nothing() -> None:
    assert at_the_panel(JOG).waits(2.0, jog=CW_AND_UP) == []


def test_a_switch_held_since_before_the_mode_was_set_must_be_released_first() -> None:
    person = at_the_panel(PARK)
    assert person.waits(5.0, jog=CW, mode_bits=JOG) == [Release(), SetMode(Mode.JOG)]


def test_turning_the_mode_switch_ends_a_jog_at_once() -> None:
    person = at_the_panel(JOG)
    person.waits(0.5, jog=DOWN)
    assert person.sees(mode_bits=AUTO) == [Stop((EL,))]
    assert person.waits(2.0) == [Release(), SetMode(Mode.AUTO)]


def test_an_axis_without_calibration_gets_two_seconds_a_press() -> None:
    person = at_the_panel(JOG)
    person.status = replace(STILL, azimuth=replace(STILL.azimuth, missing=(Missing.HOMING,)))
    *jogs, last = person.waits(5.0, jog=CW)
    assert set(jogs) == {Jog(AZ, PLUS, 0.3)}
    assert 1.95 <= len(jogs) * LOOK_S <= 2.05
    assert last == Stop((AZ,))


# --- the stop button


def test_it_stops_at_once_and_nothing_else_is_ordered_while_it_is_open() -> None:
    person = at_the_panel(JOG)
    person.waits(0.5, jog=CW)
    assert person.sees(stop_open=True) == [Stop(latch=True)]
    person.status = LATCHED
    assert person.waits(2.0) == person.waits(2.0, jog=CENTRE) == person.waits(2.0, mode_bits=MANUAL) == []
    assert "stop" in person.lit()


def test_it_stops_again_whenever_it_opens() -> None:
    person = at_the_panel(AUTO)
    person.sees(stop_open=True)
    person.status = LATCHED
    assert person.waits(0.2, stop_open=False) == []
    assert person.sees(stop_open=True) == [Stop(latch=True)]


def test_closing_it_releases_nothing() -> None:
    person = at_the_panel(JOG)
    person.sees(stop_open=True)
    person.status = LATCHED
    assert person.waits(1.0, stop_open=False) == person.waits(1.0, jog=CW) == []
    assert "stop" in person.lit()


def test_it_counts_as_closed_after_50_ms() -> None:
    person = at_the_panel(AUTO)
    person.sees(stop_open=True)
    person.status = LATCHED
    for _ in range(20):  # it bounces: all that is one opening
        assert person.sees(stop_open=False) == person.sees(stop_open=True) == []


def test_who_releases_it_elsewhere_while_it_is_open_is_stopped_again() -> None:
    person = at_the_panel(AUTO)
    person.sees(stop_open=True)
    person.status = LATCHED
    assert person.sees() == []
    person.status = STILL
    assert person.sees() == [Stop(latch=True)]
    person.status = replace(LATCHED, azimuth=replace(STILL.azimuth, drive=PLUS))  # a storm park is latched, and moves
    assert person.sees() == [Stop(latch=True)]


def test_turning_the_mode_switch_releases() -> None:
    person = at_the_panel(AUTO)
    person.sees(stop_open=True)
    person.status = LATCHED
    person.waits(0.2, stop_open=False)
    assert person.waits(1.5, mode_bits=PARK) == [Release(), SetMode(Mode.PARK)]


def test_a_mode_switch_turned_while_it_was_open_releases_nothing() -> None:
    person = at_the_panel(AUTO)
    person.sees(stop_open=True)
    person.status = LATCHED
    assert person.waits(2.0, mode_bits=PARK) == []
    assert person.waits(2.0, stop_open=False) == [SetMode(Mode.PARK)]
    assert person.waits(0.5, stop_open=True, mode_bits=JOG) == [Stop(latch=True)]
    assert person.waits(2.0, stop_open=False) == [SetMode(Mode.JOG)]  # begun while it was open


def test_open_at_power_up_it_stops() -> None:
    assert Person().sees(stop_open=True) == [Stop(latch=True)]


def test_a_jog_ends_when_the_box_is_stopped_elsewhere_and_does_not_begin_again_by_itself() -> None:
    person = at_the_panel(JOG)
    person.waits(0.5, jog=CW)
    person.status = LATCHED
    assert person.sees() == [Stop((AZ,))]
    person.status = STILL
    assert person.waits(2.0) == []


# --- calibration at power-up


def test_calibration_reads_the_knobs_and_homes_one_axis_a_step() -> None:
    person = Person()
    assert person.sees(calibrate=True, azimuth_knob=0.97, elevation_knob=0.93, mode_bits=MANUAL) == [
        SetMode(Mode.MANUAL)
    ]
    assert person.act.full_scales == {AZ: 0.97, EL: 0.93}
    assert person.act.meters == {AZ: 1.0, EL: 1.0}  # for the meters' trimmers
    assert any("mode switch" in note for note in person.act.notes)
    assert person.waits(3.0) == []
    assert person.act.full_scales is None
    assert person.waits(1.5, mode_bits=PARK) == [Release(), Home(AZ)]
    assert person.waits(60.0, pulses=frozenset({AZ})) == []
    assert "azimuth_pulse" in person.lit()
    assert person.waits(1.5, mode_bits=AUTO) == [Release(), Home(EL)]
    assert person.waits(60.0) == []
    assert person.waits(1.5, mode_bits=JOG) == [Release(), SetMode(Mode.JOG)]
    assert person.waits(0.1, jog=CW) == [Jog(AZ, PLUS, 0.3)]


def test_the_calibrate_switch_is_read_at_power_up_only() -> None:
    person = at_the_panel(AUTO)
    assert person.waits(2.0, calibrate=True) == []
    assert person.act.full_scales is None
    assert person.waits(2.0, mode_bits=PARK) == [Release(), SetMode(Mode.PARK)]


def test_a_knob_that_is_not_at_its_maximum_is_not_trusted() -> None:
    person = Person()
    person.sees(calibrate=True, azimuth_knob=0.1, elevation_knob=0.95)
    assert person.act.full_scales == {AZ: 1.0, EL: 0.95}
    assert any("azimuth knob reads 0.100: not its maximum" in note for note in person.act.notes)


def test_a_knob_is_read_when_it_can_be() -> None:
    person = Person()
    person.sees(calibrate=True, azimuth_knob=None, elevation_knob=None)
    assert person.act.full_scales is None
    person.sees(azimuth_knob=0.9)
    assert person.act.full_scales == {AZ: 0.9, EL: 1.0}


def test_while_calibrating_switches_and_knobs_move_nothing() -> None:
    person = Person()
    person.sees(calibrate=True)
    assert person.waits(3.0, jog=CW, azimuth_knob=0.5) == []


def test_a_full_scale_that_was_kept_makes_the_knob_s_end_the_axis_s_end() -> None:
    person = Person(Panel(PanelSettings(), {AZ: 0.8}))
    person.waits(2.0, mode_bits=MANUAL)
    assert person.waits(2.0, azimuth_knob=0.8) == [Aim(about(360.0), None)]
    assert person.waits(2.0, azimuth_knob=0.9) == []  # it cannot be further than at its end


# --- lamps and meters


def test_lamps_of_motors_data_and_pulses() -> None:
    person = at_the_panel(AUTO)
    person.status = replace(STILL, azimuth=replace(STILL.azimuth, drive=MINUS, moving=True))
    person.sees(data=True, pulses=frozenset({EL}))
    assert person.lit() == {"auto", "motor", "data", "elevation_pulse"}
    person.waits(0.2, data=False)
    assert person.lit() == {"auto", "motor", "elevation_pulse"}
    assert set(person.act.lamps) == set(LAMPS)


def test_meters_show_where_the_axes_stand_and_zero_where_the_angle_is_unknown() -> None:
    person = at_the_panel(AUTO)
    person.status = replace(
        STILL,
        azimuth=AxisStatus(0.0, 450.0, angle_deg=455.0),
        elevation=AxisStatus(0.0, 180.0),
    )
    person.sees()
    assert person.act.meters == {AZ: 1.0, EL: 0.0}


# --- any sequence of switches

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


@settings(max_examples=200, deadline=None)
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
