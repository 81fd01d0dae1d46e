"""The console's words for the sky: what is tracked, and tables that come line by line."""

from __future__ import annotations

from dataclasses import replace

from rotator.config.sky import NO_PLACE
from rotator.control.sky.timed_table import TimedTable
from rotator.exchange.orders import GiveBack, Release
from rotator.protocols.console_session import MOST_TABLE_LINES, ConsoleSession
from tests.protocols.fed import Notebook
from tests.protocols.test_console import Feed


class Sky:
    """What tracks: it knows the ISS alone."""

    def __init__(self) -> None:
        self.heard: list[str] = []
        self.state = "off"
        self.goes_on_with = ""

    def track(self, words: str) -> str:
        self.heard.append(words)
        return "" if words == "iss" else f'"{words}" is not known'

    def program(self, table: TimedTable) -> str:
        self.heard.append(f"{table.name}: {table.rows} by lines {table.lines}")
        return ""

    def demo(self, zone: str, times: int) -> str:
        self.heard.append(f"demo {zone} {times}")
        return ""

    def follow_plan(self) -> str:
        self.heard.append("plan")
        return ""

    def off(self) -> None:
        self.heard.append("off")

    def clock_is_right(self) -> None:
        self.heard.append("the clock is right")


def test_what_is_tracked_and_why_not(feed: Feed) -> None:
    sky = Sky()
    session = ConsoleSession(Notebook(), tracking=sky)
    assert feed(session, b"track ISS\n") == [b"ok\n"]
    assert feed(session, b"track xyz\n") == [b'error: "xyz" is not known\n']
    assert feed(session, b"track\n") == [b"off\nok\n"]
    assert feed(session, b"clock-is-right\ntrack off\n") == [b"ok\n", b"ok\n"]
    assert sky.heard == ["iss", "xyz", "the clock is right", "off"]


def test_after_a_stop_a_person_alone_says_that_what_was_tracked_goes_on(feed: Feed) -> None:
    box, sky = Notebook(), Sky()
    box.shown = replace(box.shown, latched="panel")
    session = ConsoleSession(box, tracking=sky)
    sky.goes_on_with = "iss"
    assert feed(session, b"resume\n") == [b"it tracked iss before: go-on goes on with that\nok\n"]
    assert sky.heard == []
    assert feed(session, b"go-on\n") == [b"ok\n"]
    assert (box.orders, sky.heard) == ([Release(), Release()], ["iss"])
    sky.goes_on_with = "plan"
    assert feed(session, b"go-on\n") == [b"ok\n"]
    assert box.orders[-2:] == [Release(), GiveBack()]
    assert sky.heard[-1] == "plan"


def test_a_table_comes_line_by_line(feed: Feed) -> None:
    sky = Sky()
    session = ConsoleSession(Notebook(), tracking=sky)
    lines = b"table old\ntable\ntable t,az,el\ntable ,\ntable 1795372199, 10, 5\ntable 2026-11-22t18:30:00z,11,6\n"
    assert feed(session, lines + b"track-table Pass\n") == [b"ok\n"] * 7
    assert sky.heard == ["pass: ((1795372199.0, 10.0, 5.0), (1795372200.0, 11.0, 6.0)) by lines (3, 4)"]
    (refused,) = feed(session, b"track-table again\n")
    assert refused.startswith(b"error: the table: is empty.")


def test_a_table_has_an_end(feed: Feed) -> None:
    session = ConsoleSession(Notebook(), tracking=Sky())
    assert set(feed(session, b"table t,az,el\n" * MOST_TABLE_LINES)) == {b"ok\n"}
    assert feed(session, b"table 0,10,5\n") == [b"error: a table has no more than 20000 lines\n"]


def test_without_a_place_nothing_is_tracked(feed: Feed) -> None:
    session = ConsoleSession(Notebook())
    assert feed(session, b"track iss\n") == [f"error: {NO_PLACE}\n".encode()]
    assert feed(session, b"track\n") == [b"off\nok\n"]


def test_while_a_stop_is_latched_nothing_is_tracked(feed: Feed) -> None:
    box = Notebook()
    box.shown = replace(box.shown, latched="panel")
    sky = Sky()
    session = ConsoleSession(box, tracking=sky)
    assert feed(session, b"track iss\n") == [b"error: stopped by the panel: nothing moves until resume\n"]
    assert feed(session, b"track off\n") == [b"ok\n"]
    assert sky.heard == ["off"]
