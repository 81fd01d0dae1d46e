"""The findings of `rotator doctor`: lines for the operator, a JSON object for programs.

Knows the layout, and the form of the object. Does not know what is checked.
"""

from __future__ import annotations

from collections.abc import Sequence

from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from rotator.doctor.finding import Finding

FORM = 1
"""The version of the object's form. It rises when a key is removed or changes its meaning, not when one is added."""
COLOURS = {"✓": "green", "✗": "bold red", "!": "yellow", "–": "dim"}

Findings = Sequence[tuple[str, Finding]]
"""(name of the check, its finding)."""


def report(findings: Findings) -> RenderableType:
    """A line for each finding with its advice below, and a sentence at the end."""
    table = Table.grid(padding=(0, 2, 0, 0))
    for style in ("", "bold", ""):
        table.add_column(style=style, no_wrap=style == "bold", overflow="fold")
    last_name = ""
    for name, finding in findings:
        found = Text(finding.found, style="dim" if finding.ok is None else "")
        table.add_row(Text(finding.mark, style=COLOURS[finding.mark]), Text("" if name == last_name else name), found)
        if finding.advice:
            table.add_row("", "", Text(f"→ {finding.advice}"))
        last_name = name
    return Group(table, Text(), Text(verdict(findings)))


def verdict(findings: Findings) -> str:
    marks = [finding.mark for _, finding in findings]
    wrong, doubtful = marks.count("✗"), marks.count("!")
    counts = [f"✗ {wrong} to mend"] if wrong else []
    counts += [f"! {doubtful} to think about"] if doubtful else []
    return ", ".join(counts) + "." if counts else "✓ All well."


def as_object(findings: Findings, *, program: str, ok: bool) -> dict[str, object]:
    """The JSON object. `ok` of a check is null where it was skipped; advice with a true `ok` is a warning."""
    return {
        "version": FORM,
        "rotator": program,
        "ok": ok,
        "checks": [
            {"name": name, "ok": finding.ok, "found": finding.found, "advice": finding.advice or None}
            for name, finding in findings
        ],
    }
