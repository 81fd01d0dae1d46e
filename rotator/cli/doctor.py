"""`rotator doctor`: check everything, and print the findings.

Chooses the file, and prints the report or JSON. The checks and the exit code come from `rotator.doctor`.
"""

from __future__ import annotations

import json
import sys
from dataclasses import replace
from functools import cache, partial
from pathlib import Path

import click
from rich.console import Console, RenderableType

from rotator import __version__
from rotator.cli.box import BoxStatus, DoesNotAnswer, RunningBox
from rotator.cli.commands import HERE
from rotator.cli.failed import CommandFailed, NoBox
from rotator.config.load import ConfigError
from rotator.config.places import INSTALLED
from rotator.doctor.checks import examine
from rotator.doctor.machine import Silent, this_machine
from rotator.views.examination import as_object, report

PLAIN_WIDTH = 110


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


def _show(report: RenderableType) -> None:
    if sys.stdout.isatty():
        Console(highlight=False).print(report)
        return
    console = Console(highlight=False, width=PLAIN_WIDTH)
    with console.capture() as lines:
        console.print(report)
    click.echo("\n".join(line.rstrip() for line in lines.get().splitlines()))
