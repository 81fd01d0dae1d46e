"""The box in a terminal: keys, STOP, faults and angles are in the picture whatever the size and the state."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import Any

from hypothesis import given, settings
from hypothesis import strategies as st
from rich.text import Text

from hw.ports import Axis, Direction
from rotator.control.sky.mount import Mount, Range, Sector
from rotator.exchange.faults import Fault, FaultKind, Missing, Notice
from rotator.exchange.status import AxisStatus, Status
from rotator.links.wire import Wire
from rotator.views import frame, terminal
from rotator.views.words import release
from tests.search import examples
from tests.tables import every_row
from tests.views.screens import BUSY, GLASS, LOG, SIZES, STATES, STATUS, on_screen, row, show

CHIMNEY = Sector("the chimney", Range(100.0, 130.0), Range(0.0, 40.0), 2.0)
MOUNT = Mount(Range(0.0, 450.0), Range(0.0, 180.0), horizon=((0.0, 5.0), (180.0, 12.0)), sectors=(CHIMNEY,))


# --- every size, every state


@every_row(("columns", "rows"), SIZES)
@every_row("state", STATES)
def test_keys_stop_faults_and_angles_are_there(columns: int, rows: int, state: str) -> None:
    status = STATES[state]
    for typed in ("", "> resume_  Enter does it"):
        picture = show(status, BUSY, LOG, (columns, rows), typed=typed, mount=MOUNT, trail=[(200.0, 20.0)])
        whole_and_clear(picture, status, columns, rows)
        assert typed in picture


def whole_and_clear(picture: str, status: Status, columns: int, rows: int) -> None:
    seen = picture.splitlines()
    assert len(seen) <= rows
    assert {len(line) for line in seen} == {columns}
    assert [line[0] + line[-1] for line in seen] == ["╭╮", *["││"] * (len(seen) - 2), "╰╯"]
    assert "space STOP   q quit" in picture
    assert re.search(r"park.*resume", picture), "the words that move or release it"
    for fault in status.faults:
        assert f"{fault.axis.value}: {fault.name}"[:24] in picture
        assert fault.act_now in picture
    if status.latched:
        assert "STOPPED by" in picture or "STORM PARK by" in picture or "CUT MOTOR" in picture
    whole = " ".join(line[2:-2].strip() for line in seen)
    assert release(status) in whole
    for axis in Axis:
        each = status.axis(axis)
        angle = "---" if each.shown_deg is None else f"{round(each.shown_deg, 1) + 0.0:.1f}°"
        assert re.search(rf"(az|el|azimuth|elevation)\s+{re.escape(angle)}", picture), axis
        lines = [line for line in seen if re.search(r" (az|el|azimuth|elevation|target) ", line)]
        if not each.seen:
            assert ("no signal" if each.shown_deg is None else "last seen") in "".join(lines)
        if not (status.azimuth.seen or status.elevation.seen):
            assert "measured" not in picture
            assert "counted" not in picture


ANGLES = st.none() | st.floats(-20.0, 470.0)
TEXTS = st.text(st.characters(codec="ascii", exclude_categories=["C"]), min_size=1, max_size=60)


@st.composite
def axes(draw: st.DrawFn, axis: Axis) -> AxisStatus:
    kind = draw(st.none() | st.sampled_from(FaultKind))
    return AxisStatus(
        draw(st.sampled_from([-180.0, 0.0, 10.0])),
        draw(st.sampled_from([90.0, 180.0, 360.0, 450.0, 540.0])),
        angle_deg=draw(ANGLES),
        target_deg=draw(ANGLES),
        drive=draw(st.sampled_from(Direction)),
        seen=draw(st.booleans()),
        missing=draw(st.sampled_from([(), (Missing.HOMING,), tuple(Missing)])),
        fault=Fault(kind, axis, draw(TEXTS), passing=draw(st.booleans())) if kind else None,
        notices=tuple(map(Notice, draw(st.lists(TEXTS, max_size=3)))),
        noise_deg=0.0,
        starts=draw(st.none() | st.integers(0, 999)),
    )


@given(
    st.integers(40, 250),
    st.integers(12, 80),
    axes(Axis.AZIMUTH),
    axes(Axis.ELEVATION),
    st.sampled_from(["", "console", "rotctld#12"]),
    st.booleans(),
)
@settings(max_examples=examples(60), deadline=None)
def test_any_status_at_any_size(  # noqa: PLR0917 - hypothesis fills them in
    columns: int, rows: int, azimuth: AxisStatus, elevation: AxisStatus, latched: str, masked: bool
) -> None:
    status = replace(STATUS, azimuth=azimuth, elevation=elevation, latched=latched)
    picture = show(status, BUSY, LOG, (columns, rows), mount=MOUNT if masked else None)
    whole_and_clear(picture, status, columns, rows)


# --- what a larger terminal gains, and what a simple one can show


def test_a_wide_terminal_gains_longer_bars_and_the_sky() -> None:
    assert "◆" not in show(size=(80, 24))
    wide, wider = show(size=(132, 43)), show(size=(200, 60))
    for picture in (wide, wider):
        assert "◆ antenna" in picture
        assert len(re.findall("[◆◈]", picture)) == 2, "the antenna in the sky, and in the legend"
    assert row(wider, "azimuth").count("█") > row(wide, "azimuth").count("█")


def test_a_high_terminal_gains_the_sky_below_and_more_of_the_log() -> None:
    picture = show(log=LOG[:2], size=(80, 60))
    assert "◆ antenna" in picture
    assert show(log=LOG, size=(80, 60)).count("refused") > show(log=LOG, size=(80, 40)).count("refused")


@every_row("size", SIZES)
def test_plain_characters_have_the_same_places(size: tuple[int, int]) -> None:
    around: dict[str, Any] = {"mount": MOUNT, "trail": [(0.0, 0.0), (10.0, 30.0)]}
    fine, plain = (show(STATUS, BUSY, size=size, ascii_only=only, **around) for only in (False, True))
    assert not set(plain) - {chr(code) for code in range(128)} - set("°\n")
    letters = re.compile(r"[A-Z0-9a-np-z°]")
    assert [letters.findall(line) for line in plain.splitlines()[1:5]] == [
        letters.findall(line) for line in fine.splitlines()[1:5]
    ]


def test_a_table_takes_what_room_there_is() -> None:
    cells = [Text("0123456789")]
    columns = [
        frame.Column("a", cells),
        frame.Column("b", cells, least=4, rank=1, end=True),
        frame.Column("c", cells, least=4),
    ]

    def last(width: int) -> str:
        return frame.table(columns, width, rank=0, head_rank=0, rule_rank=0)[-1].text.plain

    assert last(36) == "0123456789   0123456789   0123456789"
    assert last(35) == "0123456789  0123456789  0123456789"
    assert last(30) == "0123456789  …56789  0123456789"
    assert last(27) == "0123456789   0123456789", "the one that matters least is left out"
    assert last(20) == "0123456789  0123456…"


def test_the_arduino(wires: list[Wire]) -> None:
    picture = "\n".join(on_screen(terminal.sketch_picture(GLASS, (-1, 1), wires[:1]), 80, 24))
    for word in (*GLASS, "● CCW", "● UP", "○ CW", "○ DOWN", "F1EFW sketch", "SIMULATED", "q quit"):
        assert word in picture
