"""The two rows of the display, letter by letter."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from hw.moteus.faults import LIMITS
from hw.ports import Axis, Direction
from rotator.status import AxisStatus, Fault, Status
from rotator.views.lcd import _SHORT_FAULTS, _SHORT_NOTICES, rows

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
POT_OPEN = Fault("pot open or shorted", AZ, "0.001", "0.02 to 0.98")
STALLED = Fault("stalled", EL, "0.0°/s", "1.0°/s")
BUS = Fault("bus hung", None, "no answer", "0.1 s")


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
    return replace(now, **{axis.value: replace(now.axis(axis), **more)})


def uppers(now: Status, seconds: int = 16) -> list[str]:
    """The upper row, looked at in the middle of every second."""
    return [rows(now, second + 0.5)[0].rstrip() for second in range(seconds)]


# --- directions


def test_satellite_over_antenna() -> None:
    assert rows(status(), 0.0) == ("SAT A:235 E:025 ", "ANT A:231 E:024 ")


def test_no_order_yet() -> None:
    assert rows(status(wanted=(None, None)), 0.0) == ("SAT A:--- E:--- ", "ANT A:231 E:024 ")


def test_only_one_axis_ordered() -> None:
    assert rows(status(wanted=(235, None)), 0.0)[0] == "SAT A:235 E:--- "


def test_no_reading_yet() -> None:
    assert rows(status(at=(None, None)), 0.0)[1] == "ANT A:--- E:--- "


def test_a_simulated_rotor_is_never_taken_for_an_antenna() -> None:
    assert rows(status(simulated=True), 0.0) == ("SAT A:235 E:025 ", "SIM A:231 E:024 ")


@pytest.mark.parametrize(
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


@pytest.mark.parametrize(
    ("elevation_deg", "shown"),
    [(0.0, "000"), (-0.2, "000"), (24.5, "025"), (90.0, "090"), (155.0, "155"), (180.0, "180"), (-5.0, "-05")],
)
def test_elevation_may_go_over_the_top_and_below_the_horizon(elevation_deg: float, shown: str) -> None:
    assert rows(status(at=(0, elevation_deg)), 0.0)[1] == f"ANT A:000 E:{shown} "


# --- what takes the upper row


def test_a_fault_takes_the_upper_row_every_other_two_seconds() -> None:
    sat, fault = "SAT A:235 E:025", "AZ POT OPEN/SHRT"
    assert uppers(with_axis(AZ, fault=POT_OPEN), 8) == [sat, sat, fault, fault, sat, sat, fault, fault]


def test_the_lower_row_stays() -> None:
    now = with_axis(AZ, fault=POT_OPEN)
    assert {rows(now, float(second))[1] for second in range(8)} == {"ANT A:231 E:024 "}


def test_several_notices_take_turns() -> None:
    now = with_axis(AZ, fault=POT_OPEN)
    now = replace(now, elevation=replace(now.elevation, fault=STALLED), latched="console")
    assert uppers(now, 16)[2::4] == ["AZ POT OPEN/SHRT", "EL STALLED", "STOP: CONSOLE", "AZ POT OPEN/SHRT"]
    assert uppers(now, 16)[::4] == ["SAT A:235 E:025"] * 4


def test_a_latched_stop_says_who_pressed_it() -> None:
    assert uppers(status(latched="console"))[2] == "STOP: CONSOLE"


@pytest.mark.parametrize(("axis", "shown"), [(AZ, "AZ UNCALIBRATED"), (EL, "EL UNCALIBRATED")])
def test_uncalibrated(axis: Axis, shown: str) -> None:
    assert uppers(with_axis(axis, uncalibrated="limits"), 4)[2] == shown


def test_a_fault_of_no_axis() -> None:
    assert uppers(with_axis(AZ, fault=BUS), 4)[2] == "BUS HUNG"


def test_without_a_notice_the_satellite_keeps_its_row() -> None:
    assert set(uppers(status())) == {"SAT A:235 E:025"}


# --- every fault and every notice there is

ROTATOR = Path(__file__).parents[2] / "rotator"


def calls(*names: str) -> Iterator[ast.expr]:
    """What the code gives these functions first, wherever it calls them."""
    for file in sorted(ROTATOR.rglob("*.py")):
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and node.args:
                called = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
                if called in names:
                    yield node.args[0]


def fault_names() -> set[str]:
    """Those in the code, and the headings of the page that explains them: a few are told apart in a variable."""
    said = {each.value for each in calls("Fault", "_closed") if isinstance(each, ast.Constant)}
    page = (ROTATOR.parent / "docs" / "troubleshooting.md").read_text(encoding="utf-8")
    faults = page.split("\n## Faults of an axis\n")[1].split("\n## ")[0]
    notices = {"motor hot", "blind to a broken pot wire"}
    explained = {line.removeprefix("### ") for line in faults.splitlines() if line.startswith("### ")}
    return (said | explained) - notices


def test_the_names_are_found() -> None:
    names = fault_names()
    assert {"relay welded", "turning with no relay on", "controller fault", "servo board", "not homed"} <= names
    assert len(names) >= 21


@pytest.mark.parametrize("name", sorted(fault_names()))
def test_every_fault_fits_beside_its_axis(name: str) -> None:
    shown = uppers(with_axis(AZ, fault=Fault(name, AZ, "")), 4)[2]
    words = _SHORT_FAULTS.get(name, name.upper())
    assert shown == f"AZ {words}"


def test_no_short_name_is_of_a_fault_there_is_not() -> None:
    assert set(_SHORT_FAULTS) <= fault_names()


@pytest.mark.parametrize("limit", LIMITS.values())
def test_what_holds_a_controller_back_fits_too(limit: str) -> None:
    assert uppers(with_axis(EL, notices=(limit,)), 4)[2] == f"EL {_SHORT_NOTICES[limit]}"


@pytest.mark.parametrize("head", sorted(_SHORT_NOTICES))
def test_every_notice_fits(head: str) -> None:
    assert uppers(with_axis(AZ, notices=(f"{head}: more",)), 4)[2] == f"AZ {_SHORT_NOTICES[head]}"


# --- any status

angles = st.none() | st.floats(-720, 1080)
words = st.text(st.characters(min_codepoint=32, max_codepoint=126), max_size=40)
faults = st.none() | st.builds(
    Fault, words.filter(bool), st.none() | st.sampled_from(Axis), words, words, act_now=words
)
axes = st.builds(
    AxisStatus,
    st.just(0.0),
    st.just(450.0),
    angle_deg=angles,
    drive=st.sampled_from(Direction),
    uncalibrated=words,
    fault=faults,
    notices=st.lists(words, max_size=3).map(tuple),
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
