"""Makes the table of checks in docs/reference/checks.md, so that page and program agree.

Knows Markdown. The checks are in `checks.py`.
"""

from __future__ import annotations

from rotator.doctor.checks import CONFIGURATION, OF_THE_MACHINE, OF_THE_STATION
from rotator.doctor.finding import Check


def checks_table() -> str:
    """One row for each check, in the order of the report."""
    checks: tuple[Check[...], ...] = (CONFIGURATION, *OF_THE_MACHINE, *OF_THE_STATION)
    rows = [f"{check.name} | {check.looks_at}" for check in checks]
    return "\n".join(["check | looks at", "--|--", *rows])
