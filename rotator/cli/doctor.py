"""`rotator doctor`: check everything, and print the findings, as lines for the operator or as JSON for programs.

Chooses the file; knows the layout of the lines and the keys of the object. The checks and the exit code come from
`rotator.doctor`.
"""

from __future__ import annotations

import json
import sys
from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from functools import cache, partial
from pathlib import Path

import click
from rich.console import Console, Group, RenderableType
from rich.table import Table
from rich.text import Text

from rotator import __version__
from rotator.cli.box import BoxStatus, DoesNotAnswer, RunningBox
from rotator.cli.commands import HERE
from rotator.cli.failed import CommandFailed, NoBox
from rotator.config.load import ConfigError
from rotator.config.places import INSTALLED
from rotator.doctor.checks import examine
from rotator.doctor.finding import Finding, Mark
from rotator.doctor.machine import Silent, this_machine

PLAIN_WIDTH = 110

FORM = 1
"""The version of the object's form. It rises when a key is removed or changes its meaning, not when one is added."""

Findings = Sequence[tuple[str, Finding]]
"""(name of the check, its finding)."""


def examine_box(path: Path | None, *, as_json: bool) -> int:
    """Check and print. Returns the exit code: 0 without errors, 1 with errors, 2 for an unusable configuration."""
    machine = this_machine()
    if path is None and machine.at(str(INSTALLED)).exists():
        path = machine.at(str(INSTALLED))
    if path is None and Path(HERE).exists():
        path = Path(HERE)
    # Asked once: a box that does not answer takes its time each time.
    examination = examine(replace(machine, ask_box=cache(partial(_ask_box, path))), path)
    if as_json:
        found = as_object(examination.findings, program=__version__, ok=examination.exit_code == 0)
        click.echo(json.dumps(found, indent=2, ensure_ascii=False))
    else:
        _show(report(examination.findings))
    return examination.exit_code


def _ask_box(path: Path | None) -> BoxStatus | Silent | str | None:
    try:
        with RunningBox(path) as box:
            return box.status()
    except NoBox:
        return None
    except DoesNotAnswer as why:
        return Silent(str(why))
    except ConfigError:
        return "the file does not say where it is"
    except CommandFailed as reason:
        return str(reason)


def _show(lines: RenderableType) -> None:
    if sys.stdout.isatty():
        Console(highlight=False).print(lines)
        return
    console = Console(highlight=False, width=PLAIN_WIDTH)
    with console.capture() as printed:
        console.print(lines)
    click.echo("\n".join(line.rstrip() for line in printed.get().splitlines()))


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
