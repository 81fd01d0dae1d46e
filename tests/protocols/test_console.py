"""The console's words, both ways."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

import pytest

from hw.ports import Axis, Direction
from rotator.exchange.faults import Missing
from rotator.exchange.orders import (
    Aim,
    Confirm,
    GiveBack,
    Home,
    Jog,
    LetGo,
    Mode,
    Nudge,
    Order,
    Park,
    RelaysChecked,
    Release,
    SetMode,
    Stop,
    Take,
)
from rotator.protocols.console import (
    VERBS,
    Ask,
    ConsoleCommand,
    Pair,
    TableLine,
    TrackTable,
    parse,
)
from rotator.protocols.console_session import MAX_LINE, ConsoleSession
from rotator.protocols.methods import ClockIsRight, Demo, GoOn, Pulse, Track
from rotator.protocols.panel_words import Hand, StopButton, ThrowJog, TurnKnob, TurnMode
from rotator.protocols.session import Session
from tests.protocols.fed import Notebook
from tests.tables import every_row

if TYPE_CHECKING:
    from tests.protocols.conftest import BenchBox

Feed = Callable[[Session, bytes], list[bytes]]
CANONICAL: list[tuple[bytes, ConsoleCommand]] = [
    (b"status", Ask.STATUS),
    (b"status json", Ask.STATUS_JSON),
    (b"stop", Stop(latch=True)),
    (b"resume", Release()),
    (b"go-on", GoOn()),
    (b"home azimuth", Home(Axis.AZIMUTH)),
    (b"home elevation", Home(Axis.ELEVATION)),
    (b"confirm azimuth 123.4", Confirm(Axis.AZIMUTH, 123.4)),
    (b"confirm elevation -3", Confirm(Axis.ELEVATION, -3.0)),
    (b"nudge azimuth -1.5", Nudge(Axis.AZIMUTH, -1.5, of_pass=True)),
    (b"relays-checked elevation", RelaysChecked(Axis.ELEVATION)),
    (b"let-go", LetGo()),
    (b"park", Park(storm=True)),
    (b"pulse ccw", Pulse(Axis.AZIMUTH, Direction.MINUS)),
    (b"mode jog", SetMode(Mode.JOG)),
    (b"jog cw 0.5", Jog(Axis.AZIMUTH, Direction.PLUS, 0.5)),
    (b"jog ccw 1", Jog(Axis.AZIMUTH, Direction.MINUS, 1.0)),
    (b"jog up 2", Jog(Axis.ELEVATION, Direction.PLUS, 2.0)),
    (b"jog down 5", Jog(Axis.ELEVATION, Direction.MINUS, 5.0)),
    (b"point 235 25.5", Aim(235.0, 25.5)),
    (b"take", Take()),
    (b"give-back", GiveBack()),
    (b"pair", Pair()),
    (b"pair list", Pair("list")),
    (b"pair revoke 12", Pair("revoke", "12")),
    (b"pair token my logger", Pair("token", "my logger")),
    (b"track iss", Track("iss")),
    (b"track jn58td long", Track("jn58td long")),
    ("track Curaçao".encode(), Track("curaçao")),
    ("pair token Übung".encode(), Pair("token", "Übung")),
    (b"track off", Track("off")),
    (b"track", Track("")),
    (b"table", TableLine(None)),
    (b"table t,az,el", TableLine("t,az,el")),
    (b"track-table pass", TrackTable("pass")),
    (b"clock-is-right", ClockIsRight()),
    (b"panel mode manual", TurnMode(Mode.MANUAL)),
    (b"panel knob elevation 0.25", TurnKnob(Axis.ELEVATION, 0.25)),
    (b"panel jog ccw 1.5", ThrowJog(Axis.AZIMUTH, Direction.MINUS, 1.5)),
    (b"panel stop press", StopButton(True)),
    (b"panel stop release", StopButton(False)),
    (b"demo europe/prague life", Demo("europe/prague", 1)),
    (b"help", Ask.HELP),
]
ALSO: list[tuple[bytes, ConsoleCommand]] = [
    (b"STOP", Stop(latch=True)),
    (b"stop at once", Stop(latch=True)),
    (b" \tPoint\t235   25 ", Aim(235.0, 25.0)),
    (b"point 235,5 25", Aim(235.5, 25.0)),
    (b"point -90 10", Aim(270.0, 10.0)),
    (b"confirm azimuth -90", Confirm(Axis.AZIMUTH, -90.0)),
    (b"jog cw 1,5", Jog(Axis.AZIMUTH, Direction.PLUS, 1.5)),
]
COMMANDS = (
    "status, stop, resume, go-on, take, give-back, mode, point, jog, pulse, nudge, park, track, demo, clock-is-right, "
    "home, confirm, relays-checked, let-go, table, track-table, panel, pair, help"
)
MISTAKES = [
    (b"parc", f"there is no command 'parc'; did you mean park? There are: {COMMANDS}"),
    (b"letgo", f"there is no command 'letgo'; did you mean let-go? There are: {COMMANDS}"),
    (b"W235 025", f"there is no command 'w235'. There are: {COMMANDS}"),
    (b"\xffpark", f"there is no command '\\ufffdpark'; did you mean park? There are: {COMMANDS}"),
    (b"status xml", "write it like this: status [json]"),
    (b"home", "write it like this: home azimuth|elevation"),
    (b"home polarisation", "axis must be one of azimuth, elevation, not 'polarisation'"),
    (b"park now", "write it like this: park"),
    (b"resume azimuth", "write it like this: resume"),
    (b"jog cw", "write it like this: jog cw|ccw|up|down SECONDS"),
    (b"jog left 1", "turn must be one of cw, ccw, up, down, not 'left'"),
    (b"jog cw 5.1", "seconds must be a number from 0.05 to 5, not '5.1'"),
    (b"jog cw 0", "seconds must be a number from 0.05 to 5, not '0'"),
    (b"jog cw -1", "seconds must be a number from 0.05 to 5, not '-1'"),
    (b"jog cw nan", "seconds must be a number from 0.05 to 5, not 'nan'"),
    (b"point", "write it like this: point AZIMUTH [ELEVATION]"),
    (b"point 721 25", "azimuth must be a number from -360 to 720, not '721'"),
    (b"point 235 211", "elevation must be a number from -90 to 210, not '211'"),
    (b"point 2x5 25", "azimuth must be a number from -360 to 720, not '2x5'"),
    (b"point 1e999 25", "azimuth must be a number from -360 to 720, not '1e999'"),
    (b"point \xb2 25", "azimuth must be a number from -360 to 720, not '\\ufffd'"),
    (b"nudge azimuth -1,5", "there is no target to nudge: track or point first"),
    (b"nudge azimuth 21", "offset must be a number from -20 to 20, not '21'"),
    (b"confirm azimuth", "write it like this: confirm azimuth|elevation DEGREES"),
    (b"confirm azimuth here", "angle must be a number from -360 to 720, not 'here'"),
    (b"confirm elevation inf", "angle must be a number from -360 to 720, not 'inf'"),
]


@every_row(("line", "said"), CANONICAL)
def test_reads(line: bytes, said: ConsoleCommand) -> None:
    assert parse(line) == said


def test_every_row_of_the_table_is_read_above() -> None:
    assert {line.split()[0].decode() for line, _ in CANONICAL} == {verb.text for verb in VERBS}


@every_row(("line", "said"), ALSO)
def test_reads_as_well(line: bytes, said: ConsoleCommand) -> None:
    assert parse(line) == said


@every_row(("line", "order"), [each for each in CANONICAL if isinstance(each[1], Order)])
def test_an_order_is_handed_on_and_answered(feed: Feed, line: bytes, order: Order) -> None:
    box = Notebook()
    box.shown = replace(box.shown, wanted_azimuth_deg=10.0)
    assert feed(ConsoleSession(box), line + b"\n") == [b"ok\n"]
    assert box.orders == [order]


@every_row(("line", "hand"), [each for each in CANONICAL if isinstance(each[1], Hand)])
def test_a_hand_moves_the_panel_and_no_antenna(feed: Feed, line: bytes, hand: Hand) -> None:
    box, moved = Notebook(), []

    def move(hand: Hand) -> str:
        moved.append(hand)
        return "" if len(moved) == 1 else "there is no such part"

    session = ConsoleSession(box, move)
    assert feed(session, line + b"\n") == [b"ok\n"]
    assert feed(session, line + b"\n") == [b"error: there is no such part\n"]
    assert (moved, box.orders) == ([hand, hand], [])
    assert ConsoleSession(box).receive(line + b"\n") == [b"error: there is no simulated panel\n"]


@every_row(("line", "why"), MISTAKES)
def test_a_mistake_is_explained_and_moves_nothing(new_box: type[BenchBox], feed: Feed, line: bytes, why: str) -> None:
    box = new_box(at=(235, 25))
    assert feed(ConsoleSession(box), line + b"\r\n") == [f"error: {why}\n".encode()]
    assert box.orders == []


def test_a_line_too_long_is_none(box: BenchBox) -> None:
    session = ConsoleSession(box)
    assert session.receive(b"point " + b"1" * MAX_LINE + b"\n") == [b"error: no line has more than 200 characters\n"]
    assert session.receive(b"stop " + b"x" * MAX_LINE + b"\n") == [b"ok\n"]
    assert box.orders == [Stop(latch=True)]


@pytest.mark.parametrize(
    ("line", "why"),
    [
        (b"point 500 20", "azimuth 500° names a turn beyond the range of -90° to 400°; the same direction is 140°"),
        (b"point 410,5 5", "azimuth 410.5° names a turn beyond the range of -90° to 400°; the same direction is 50.5°"),
        (b"point 20 -5", "elevation -5° is outside the range of -2° to 110°"),
        (b"point 20 111", "elevation 111° is outside the range of -2° to 110°"),
    ],
)
def test_an_angle_that_the_rotor_has_not_is_not_led_to_another_one(
    new_box: type[BenchBox], line: bytes, why: str
) -> None:
    box = new_box(azimuth=(-90, 400), elevation=(-2, 110))
    assert ConsoleSession(box).receive(line + b"\n") == [f"error: {why}\n".encode()]
    assert box.orders == []


@pytest.mark.parametrize(
    ("at", "line", "why"),
    [
        ((0, 0), b"jog ccw 1", "azimuth stands at the end of its range, 0°: it turns only the other way"),
        ((450, 0), b"jog cw 1", "azimuth stands at the end of its range, 450°: it turns only the other way"),
        ((90, 0.4), b"jog down 1", "elevation stands at the end of its range, 0°: it turns only the other way"),
        ((90, 180), b"pulse up", "elevation stands at the end of its range, 180°: it turns only the other way"),
    ],
)
def test_a_jog_against_an_end_of_the_range_is_refused_with_the_reason(
    new_box: type[BenchBox], at: tuple[float, float], line: bytes, why: str
) -> None:
    box = new_box(at=at)
    assert ConsoleSession(box).receive(line + b"\n") == [f"error: {why}\n".encode()]
    assert box.orders == []


@every_row("line", [b"jog cw 1", b"jog up 1", b"pulse cw", b"pulse up"])
@every_row("missing", [(), (Missing.CALIBRATION,)])
def test_from_an_end_of_the_range_it_jogs_the_other_way(
    new_box: type[BenchBox], line: bytes, missing: tuple[Missing, ...]
) -> None:
    assert ConsoleSession(new_box(missing=missing)).receive(line + b"\n") == [b"ok\n"]


@pytest.mark.parametrize("line", [b"jog ccw 1", b"jog down 1"])
def test_an_axis_without_a_known_range_jogs_both_ways(new_box: type[BenchBox], line: bytes) -> None:
    assert ConsoleSession(new_box(missing=(Missing.CALIBRATION,))).receive(line + b"\n") == [b"ok\n"]


def test_the_horizon_is_a_direction_where_the_scale_begins_above_it(new_box: type[BenchBox]) -> None:
    """An offset of the file shifts both ends: a person who says 0 means as low as it goes."""
    assert ConsoleSession(new_box(elevation=(0.8, 89.5))).receive(b"point 20 0\n") == [b"ok\n"]
    assert ConsoleSession(new_box(elevation=(0.8, 89.5))).receive(b"point 20 90\n") == [b"ok\n"]


def test_help_is_the_table(box: BenchBox) -> None:
    *rows, ok = ConsoleSession(box).receive(b"help\n")[0].decode().splitlines()
    assert ok == "ok"
    assert rows[::2] == [verb.usage for verb in VERBS]
    assert rows[1::2] == [f"  {verb.help}" for verb in VERBS]
