"""Parses the option --fault: the name of a simulated fault, and the time at which it begins.

Knows the form `NAME@SECONDS`. The simulated rotor has the names, and does what each fault does.
"""

from __future__ import annotations

import re
import time
from collections.abc import Collection
from pathlib import Path

import click

from rotator.assembly.simulation import SimulatedStation
from rotator.config.load import load

_SECONDS = re.compile(r"[0-9]{1,6}(?:[.,][0-9]{0,6})?")


def fault_names(path: Path | None) -> Collection[str] | None:
    """Those of the simulated rotor of this file; None: it is a real one. Whether its box runs does not count."""
    config = load(path)
    return SimulatedStation(config, time.monotonic, None, (0.0, 0.0)).build().faults if config.simulated else None


def chosen_faults(path: Path | None, texts: tuple[str, ...]) -> list[tuple[float, str]]:
    """Those of a command line, for the rotor of this file."""
    return parse_faults(texts, fault_names(path)) if texts else []


def parse_faults(texts: tuple[str, ...], names: Collection[str] | None) -> list[tuple[float, str]]:
    """`name@seconds` to (seconds, name); without seconds the fault begins at once.

    `list` among the texts prints the names and ends the program. Raises click.UsageError for an unknown name, and
    where `names` is None: there is no simulator.
    """
    if not texts:
        return []
    if names is None:
        raise click.UsageError("--fault is for the simulator; this configuration drives real hardware")
    if "list" in texts:
        click.echo("\n".join(sorted(names)))
        raise SystemExit(0)
    plan = []
    for text in texts:
        name, at, moment = text.partition("@")
        if name not in names:
            raise click.UsageError(f"no fault called {name}; --fault list shows them")
        if at and not _SECONDS.fullmatch(moment):
            raise click.UsageError(f"{text}: after @ stands the moment in seconds, such as {name}@20")
        plan.append((float(moment.replace(",", ".") or 0), name))
    return plan
