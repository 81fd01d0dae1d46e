"""Orders that have no effect are said in the log and in `where`: whose, and why."""

from __future__ import annotations

import logging
from dataclasses import replace

import pytest

from firmware_sim.clock import SimClock
from rotator.exchange.status import AxisStatus, Status
from rotator.protocols.console_session import report
from rotator.runtime.journal import Journal

IGNORED = (
    "orders from rotctld#1 are ignored: gs232b#1 has stopped the antenna; orders count again after a pause of 10 s"
)
QUIET = Status(0.0, AxisStatus(0.0, 450.0, 100.0), AxisStatus(0.0, 180.0, 10.0))
LOUD = replace(QUIET, notices=(IGNORED,))


def test_the_log_has_it_once_a_minute(caplog: pytest.LogCaptureFixture) -> None:
    """It comes and goes with each order of a slow program."""
    clock = SimClock()
    journal = Journal(clock)
    with caplog.at_level(logging.WARNING):
        for _ in range(10):
            journal.changed(QUIET, LOUD)
            clock.sleep(2.5)
            journal.changed(LOUD, LOUD)
            journal.changed(LOUD, QUIET)
            clock.sleep(2.5)
        assert [record.message for record in caplog.records] == [IGNORED]
        clock.sleep(30.0)
        journal.changed(QUIET, LOUD)
    assert [record.message for record in caplog.records][1:] == [
        f"{IGNORED} (9 similar lines before this one are not shown)"
    ]


def test_where_has_it() -> None:
    assert f"note: {IGNORED}" in report(LOUD)
    assert not any(line.startswith("note: ") for line in report(QUIET))
