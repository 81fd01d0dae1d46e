"""The report of `rotator doctor`: lines for the operator, a JSON object for programs.

Knows the layout of the lines and the keys of the object. Does not know the checks.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from rotator.doctor.finding import Finding, Mark

FORM = 1
"""The version of the object's form. It rises when a key is removed or changes its meaning, not when one is added."""

Findings = Sequence[tuple[str, Finding]]
"""(name of the check, its finding)."""


def report(findings: Findings) -> RenderableType:
    """A line for each finding with its advice below, and the verdict at the end."""
    table = Table.grid(padding=(0, 2, 0, 0))
    table.add_column(overflow="fold")
    table.add_column(style="bold", no_wrap=True, overflow="fold")
    table.add_column(overflow="fold")
    last_name = ""
    for name, finding in findings:
        found = Text(finding.found, style=finding.mark.colour if finding.mark is Mark.SKIPPED else "")
        table.add_row(Text(finding.mark, style=finding.mark.colour), Text("" if name == last_name else name), found)
        if finding.advice:
            table.add_row("", "", Text(f"→ {finding.advice}"))
        last_name = name
    return Group(table, Text(), Text(verdict(findings)))


def verdict(findings: Findings) -> str:
    """One line: how many findings need a repair, how many are warnings, how many checks were skipped."""
    counts = Counter(finding.mark for _, finding in findings)
    wrong, warnings, skipped = (counts[mark] for mark in (Mark.WRONG, Mark.WARNING, Mark.SKIPPED))
    parts = [f"{Mark.WRONG} {wrong} to repair"] if wrong else []
    parts += [f"{Mark.WARNING} {warnings} warning{'s' if warnings > 1 else ''}"] if warnings else []
    parts = parts or [f"{Mark.GOOD} No problem found"]
    parts += [f"{Mark.SKIPPED} {skipped} skipped"] if skipped else []
    return ", ".join(parts) + "."


def as_object(findings: Findings, *, program: str, ok: bool) -> dict[str, object]:
    """The JSON object. In a check `ok` is null when the check was skipped; true with an advice is a warning."""
    return {
        "version": FORM,
        "rotator": program,
        "ok": ok,
        "checks": [
            {"name": name, "ok": finding.ok, "found": finding.found, "advice": finding.advice or None}
            for name, finding in findings
        ],
    }
