"""What `rotator doctor` found: lines for people, an object for programs.

Knows layout, and the form of the object. Knows nothing of what is looked at.
"""

from __future__ import annotations

from collections.abc import Sequence

from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from rotator.doctor.finding import Finding

FORM = 1
"""The version of the object's form: it rises when a key changes its meaning or goes, not when one is added."""
COLOURS = {"✓": "green", "✗": "bold red", "!": "yellow", "–": "dim"}

Findings = Sequence[tuple[str, Finding]]
"""The names of checks with what they found."""


def report(findings: Findings) -> RenderableType:
    """A line for each finding, its advice below it, and a sentence at the end."""
    table = Table.grid(padding=(0, 2, 0, 0))
    for style in ("", "bold", ""):
        table.add_column(style=style, no_wrap=style == "bold", overflow="fold")
    told = ""
    for name, finding in findings:
        said = Text(finding.found, style="dim" if finding.ok is None else "")
        table.add_row(Text(finding.mark, style=COLOURS[finding.mark]), Text("" if name == told else name), said)
        if finding.advice:
            table.add_row("", "", Text(f"→ {finding.advice}"))
        told = name
    return Group(table, Text(), Text(verdict(findings)))


def verdict(findings: Findings) -> str:
    marks = [finding.mark for _, finding in findings]
    wrong, doubtful = marks.count("✗"), marks.count("!")
    said = [f"✗ {wrong} to mend"] if wrong else []
    said += [f"! {doubtful} to think about"] if doubtful else []
    return ", ".join(said) + "." if said else "✓ All well."


def as_object(findings: Findings, *, program: str, ok: bool) -> dict[str, object]:
    """`ok` of a check is null where it was not looked at; advice beside a true is a warning, else it is null."""
    return {
        "version": FORM,
        "rotator": program,
        "ok": ok,
        "checks": [
            {"name": name, "ok": finding.ok, "found": finding.found, "advice": finding.advice or None}
            for name, finding in findings
        ],
    }
