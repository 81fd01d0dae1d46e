"""The table of checks of docs/troubleshooting.md, made from the checks, so that the page cannot drift from the program.

Knows Markdown. Knows no check: those are in their own table.
"""

from __future__ import annotations

from rotator.doctor.checks import CONFIGURATION, OF_THE_MACHINE, OF_THE_STATION
from rotator.doctor.finding import Check


def checks_table() -> str:
    """A row for each check, in the order of the report."""
    checks: tuple[Check[...], ...] = (CONFIGURATION, *OF_THE_MACHINE, *OF_THE_STATION)
    rows = [f"| {check.name} | {check.looks_at} |" for check in checks]
    return "\n".join(["| check | looks at |", "| --- | --- |", *rows])
