"""The nursery that all boxes come from, and the table of what was measured."""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterator
from pathlib import Path
from typing import cast

import pytest

from tests.kernel.whole.site import Nursery, Site


@pytest.fixture(scope="session")
def nursery() -> Iterator[Nursery]:
    made = Nursery()
    yield made
    made.close()


MEASURED: list[tuple[str, str]] = []
PAGE = Path(__file__).parents[3] / "docs" / "safety.md"


@pytest.fixture
def measure() -> Callable[[str, float], None]:
    """Put a row into the table that the run ends with; the page must have a row for it."""

    def note(way: str, took_s: float) -> None:
        MEASURED.append((way, f"{took_s:.2f} s"))
        assert f"\n{way} | " in PAGE.read_text(encoding="utf-8"), f"docs/safety.md has no row for: {way}"

    return note


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item: pytest.Function) -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """What the box said stands below a failure."""
    report = yield
    if report.failed and "site" in item.funcargs:
        report.sections.append(("what the box said", cast(Site, item.funcargs["site"]).log.read_text()))
    return report


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    if MEASURED:
        terminalreporter.section("from the blow to the last relay off (for docs/safety.md)")
        for way, took in MEASURED:
            terminalreporter.line(f"{way} | {took}")
