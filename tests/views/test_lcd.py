"""The two rows of the display, letter by letter."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from hw.moteus.faults import LIMITS
from hw.ports import Axis, Direction
from rotator.control.axis.run_permit import Endurance
from rotator.control.axis.switched import BLIND
from rotator.exchange.faults import Fault, FaultKind, Missing, Notice
from rotator.exchange.orders import Mode
from rotator.exchange.status import AxisStatus, Flown, Status
from rotator.views.lcd import rows
from tests.tables import every_row

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
POT_OPEN = Fault(FaultKind.POT_OPEN, AZ, "0.001", "0.02 to 0.98")
STALLED = Fault(FaultKind.STANDS_STILL, EL, "0.0°/s", "1.0°/s")


def status(
    wanted: tuple[float | None, float | None] = (235, 25),
    at: tuple[float | None, float | None] = (231, 24),
    **more: Any,
) -> Status:
    return Status(
        at_s=0.0,
        azimuth=AxisStatus(0, 450, angle_deg=at[0]),
        elevation=AxisStatus(0, 180, angle_deg=at[1]),
        wanted_azimuth_deg=wanted[0],
        wanted_elevation_deg=wanted[1],
        **more,
    )


def with_axis(axis: Axis, **more: Any) -> Status:
    now = status()
    changed: Any = {axis.value: replace(now.axis(axis), **more)}
    return replace(now, **changed)


def uppers(now: Status, seconds: int = 16) -> list[str]:
    """The upper row, looked at in the middle of every second."""
    return [rows(now, second + 0.5)[0].rstrip() for second in range(seconds)]


def test_a_code_that_pairs_a_browser_leaves_room_for_a_fault() -> None:
    assert {rows(status(mode=Mode.MANUAL), second, "123456")[0] for second in range(16)} == {"PAIR CODE 123456"}
    failed = with_axis(AZ, fault=POT_OPEN)
    seen = {rows(failed, second, "123456")[0].rstrip() for second in range(16)}
    assert seen == {"PAIR CODE 123456", *uppers(failed)} - {rows(status(), 0.0)[0].rstrip()}


# --- directions


@pytest.mark.parametrize(
    ("now", "upper", "lower"),
    [
        (status(), "SAT A:235 E:025 ", "ANT A:231 E:024 "),
        (status(wanted=(None, None)), "SAT A:--- E:--- ", "ANT A:231 E:024 "),
        (status(wanted=(235, None), at=(None, None)), "SAT A:235 E:--- ", "ANT A:--- E:--- "),
        (status(simulated=True), "SAT A:235 E:025 ", "SIM A:231 E:024 "),
    ],
)
def test_satellite_over_antenna_all_the_time_without_a_notice(now: Status, upper: str, lower: str) -> None:
    assert {rows(now, float(second)) for second in range(8)} == {(upper, lower)}


def test_the_panel_s_mode_is_a_letter_and_a_notice_where_programs_are_not_obeyed() -> None:
    auto = status(mode=Mode.AUTO, mode_switch=True)
    assert rows(auto, 2.5) == ("SAT A:235 E:025 ", "ANT A:231 E:024A")
    manual = status(mode=Mode.MANUAL, mode_switch=True)
    assert rows(manual, 2.5) == ("MODE MANUAL     ", "ANT A:231 E:024M")


@every_row(
    ("azimuth_deg", "shown"),
    [
        (0.0, "000"),
        (0.4, "000"),
        (0.5, "001"),
        (234.5, "235"),
        (359.6, "360"),
        (360.4, "360"),
        (361.0, "001"),
        (449.6, "090"),
        (450.0, "090"),
        (-0.4, "000"),
        (-10.0, "350"),
    ],
)
def test_azimuth_is_a_compass_bearing_also_in_the_overlap(azimuth_deg: float, shown: str) -> None:
    assert rows(status(wanted=(azimuth_deg, 0), at=(azimuth_deg, 0)), 0.0) == (
        f"SAT A:{shown} E:000 ",
        f"ANT A:{shown} E:000 ",
    )


@every_row(
    ("elevation_deg", "shown"),
    [(0.0, "000"), (-0.2, "000"), (24.5, "025"), (90.0, "090"), (155.0, "155"), (180.0, "180"), (-5.0, "-05")],
)
def test_elevation_may_go_over_the_top_and_below_the_horizon(elevation_deg: float, shown: str) -> None:
    assert rows(status(at=(0, elevation_deg)), 0.0)[1] == f"ANT A:000 E:{shown} "


# --- what takes the upper row


def test_a_fault_takes_the_upper_row_every_other_two_seconds() -> None:
    sat, fault = "SAT A:235 E:025", "AZ POT OPEN/SHRT"
    assert uppers(with_axis(AZ, fault=POT_OPEN), 8) == [sat, sat, fault, fault, sat, sat, fault, fault]


def test_several_notices_take_turns() -> None:
    now = with_axis(AZ, fault=POT_OPEN)
    now = replace(now, elevation=replace(now.elevation, fault=STALLED), latched="keyboard")
    assert uppers(now, 16)[2::4] == ["AZ POT OPEN/SHRT", "EL STANDS STILL", "STOP: KEYBOARD", "AZ POT OPEN/SHRT"]
    assert uppers(now, 16)[::4] == ["SAT A:235 E:025"] * 4


# --- every fault and every notice there is


@every_row("kind", FaultKind)
def test_every_fault_fits_beside_its_axis(kind: FaultKind) -> None:
    assert uppers(with_axis(AZ, fault=Fault(kind, AZ, "")), 4)[2] == f"AZ {kind.lcd}"


@pytest.mark.parametrize("missing", Missing, ids=lambda missing: missing.text)
def test_whatever_an_axis_lacks_fits(missing: Missing) -> None:
    assert uppers(with_axis(EL, missing=(missing,)), 4)[2] == f"EL {missing.lcd}"


def motor_hot() -> Notice:
    endurance = Endurance(20.0, 20.0)
    for now_s in (0.0, 30.0):
        endurance.note(now_s, running=True)
    assert endurance.notice is not None
    return endurance.notice


NOTICES = [
    motor_hot(),
    Notice("turning with no relay on: wind, or a hand at the control box's switch", "TURNS BY SELF"),
    *(Notice(limit.name, limit.short) for limit in LIMITS.values()),
]


@every_row("notice", NOTICES)
def test_every_notice_fits(notice: Notice) -> None:
    assert notice.lcd
    assert uppers(with_axis(EL, notices=(notice,)), 4)[2] == f"EL {notice.lcd}"


def test_a_notice_without_a_text_for_the_display_leaves_the_satellite_its_row() -> None:
    assert set(uppers(with_axis(AZ, notices=(BLIND,)))) == {"SAT A:235 E:025"}


# --- any status

angles = st.none() | st.floats(-720, 1080)
words = st.text(st.characters(min_codepoint=32, max_codepoint=126), max_size=40)
faults = st.none() | st.builds(Fault, st.sampled_from(FaultKind), st.sampled_from(Axis), words, words, act_now=words)
axes = st.builds(
    AxisStatus,
    st.just(0.0),
    st.just(450.0),
    angle_deg=angles,
    drive=st.sampled_from(Direction),
    missing=st.lists(st.sampled_from(Missing), max_size=4).map(tuple),
    lost=words,
    fault=faults,
    notices=st.lists(st.builds(Notice, words, words), max_size=3).map(tuple),
)
statuses = st.builds(
    Status,
    st.just(0.0),
    axes,
    axes,
    wanted_azimuth_deg=angles,
    wanted_elevation_deg=angles,
    latched=words,
    simulated=st.booleans(),
)


@given(statuses, st.floats(0, 1e7))
def test_always_two_rows_of_sixteen_characters(now: Status, now_s: float) -> None:
    upper, lower = rows(now, now_s)
    assert len(upper) == len(lower) == 16
    assert lower.startswith("SIM A:" if now.simulated else "ANT A:")


def test_between_orders_a_target_that_is_flown_is_named_with_its_set() -> None:
    flown = Flown("ISS (ZARYA)", begin_s=-10.0, end_s=312.0, recognised=True)
    assert "ISS (ZA LOS 5:12" in uppers(status(flown=flown))
