"""`rotator rehearse`: fly a pass on the simulated rotor and report the pointing error.

Knows files and output, and makes a simulated station of the configuration of a real one. `rotator.rehearsal.flight`
flies the pass.
"""

from __future__ import annotations

import csv
import json
import logging
import sys
import time
from collections.abc import Callable, Collection, Iterator
from contextlib import contextmanager
from dataclasses import astuple, fields
from io import StringIO
from pathlib import Path
from tempfile import TemporaryFile

import click

from rotator.assembly.settings import build_mount
from rotator.cli.failed import FAULTY, CommandFailed
from rotator.cli.faults import parse_faults
from rotator.cli.utc import day_and_time
from rotator.config.axes import AxisTable
from rotator.config.load import load
from rotator.config.model import Config
from rotator.control.sky.mount import Mount
from rotator.control.sky.named_turns import axis_rows, smooth_turns
from rotator.protocols.table_text import FORM
from rotator.rehearsal.flight import Summary, fly, plant_maker
from rotator.rehearsal.passes import SHIPPED, Pass, PassError, find_pass, next_pass, read_pass, shipped_names
from rotator.store.whole import write_whole
from rotator.views.pass_svg import Flown, draw
from rotator.views.trace import Sample

NO_SKY = (
    "--at is for a box that knows satellites: write [station] and below it locator, and "
    "[sky] elements or fetch, into the file of --config"
)


def rehearse_pass(
    word: str | None,
    path: Path | None,
    faults: tuple[str, ...],
    *,
    via: str,
    trace: Path | None,
    as_json: bool,
    at_s: float | None,
    arduino: bool,
    target: str | None,
    svg: Path | None,
) -> None:
    """`word`: the name of a shipped pass, or a file; None: list the names.

    `target`: what the box tracks by itself, in its first pass that ends after `at_s`, in seconds since 1970; None: now.
    Without a target the pass begins at `at_s`; None: the box knows no satellites.
    """
    logging.basicConfig(level=logging.WARNING, format="%(levelname).1s %(message)s")
    config = load(path)
    if not config.simulated:
        config = simulated(config)
    if target is not None and (word is not None or arduino):
        raise click.UsageError("--target is a pass of its own: leave out PASS.csv and --arduino")
    if word is None and target is None and "list" not in faults:
        click.echo(_listed())
        return
    tracked = None
    try:
        if target is not None:
            flown, tracked = next_pass(config, target, time.time() if at_s is None else at_s)
            click.echo(_begins(flown, tracked.begin_utc_s), err=True)
        else:
            flown = find_pass(word or shipped_names()[0])
            _make_sure_of_turns(flown, build_mount(config))
    except PassError as fault:
        raise CommandFailed(str(fault)) from None
    outputs = {option: file for option, file in (("--trace", trace), ("--svg", svg)) if file is not None}
    for option, file in outputs.items():
        if word and file.exists() and Path(word).exists() and file.samefile(word):
            raise click.UsageError(f"{option} would write over the pass")
    if arduino and faults:
        raise click.UsageError("--fault is for the box, not for the Arduino")
    knows_satellites = config.station.is_known and (config.sky.elements or config.sky.fetch)
    if at_s is not None and target is None and not knows_satellites:
        raise click.UsageError(NO_SKY)
    for file in outputs.values():
        _make_sure_of(file)
    make = plant_maker(
        config,
        via=via,
        arduino=arduino,
        faults=lambda world: _faults(faults, flown, world.faults),
        utc_s=None if target else at_s,
        target=tracked,
    )
    with _progress(flown) as progress:
        rows, summary = fly(flown, make, progress)
    if trace is not None:
        _write_trace(trace, rows)
    if svg is not None:
        flier = Flown("the sketch" if arduino else "the antenna", "red" if arduino else "blue", rows, summary)
        _write(svg, draw(flown.name, [flier], build_mount(config)))
    click.echo(json.dumps(summary.as_dict()) if as_json else _sentence(flown, summary, arduino=arduino))
    if summary.faults:
        raise CommandFailed("\n         ".join(("at the end of the pass:", *summary.faults)), FAULTY)


def _make_sure_of_turns(flown: Pass, mount: Mount) -> None:
    """That the rotor can be where the pass names it. Raises PassError."""
    if flown.turns and isinstance(fault := axis_rows(flown.table, smooth_turns(flown.rows), mount), str):
        raise PassError(f"{flown.name}, {fault}")


def _begins(flown: Pass, begin_utc_s: float) -> str:
    return (
        f"{flown.name} rises {day_and_time(begin_utc_s)} UTC, for {flown.end_s / 60:.0f} min, up to "
        f"{flown.highest_deg:.0f}°. The flight in simulated time takes a minute, or some on a Pi."
    )


def _listed() -> str:
    """The shipped passes, each in a row."""
    passes = [read_pass(SHIPPED / f"{name}.csv") for name in shipped_names()]
    rows = [
        f"{each.name:<16} {each.rows[0][1]:3.0f}° to {each.rows[-1][1]:3.0f}°, up to {each.highest_deg:2.0f}°, "
        f"{each.end_s / 60:4.1f} min"
        for each in passes
    ]
    return "\n".join(
        ("Passes of real satellites that come with the program:", *rows, "", f"Your own is a file. {FORM}")
    )


@contextmanager
def _progress(flown: Pass) -> Iterator[Callable[[float], None]]:
    """A bar on a terminal; nothing elsewhere. Only then its library is loaded."""
    if not sys.stderr.isatty():
        yield lambda _t_s: None
        return
    from rich.console import Console  # noqa: PLC0415
    from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn  # noqa: PLC0415

    text = TextColumn("{task.description} {task.completed:4.0f} of {task.total:.0f} s", markup=False)
    with Progress(text, BarColumn(), TimeRemainingColumn(), console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task(flown.name, total=flown.end_s)
        yield lambda t_s: bar.update(task, completed=t_s)


def simulated(config: Config) -> Config:
    """The configuration of a real station with a simulated rotor and healthy pots; no real device is opened."""
    # The readings of the simulated pots do not depend on what the file says about the real ones.
    pot = {"calibration": None}
    pot |= {key: AxisTable.model_fields[key].default for key in ("lowest_reading", "highest_reading")}
    return config.model_copy(
        update={
            "rotor": config.rotor.model_copy(update={"hardware": "sim"}),
            "azimuth": config.azimuth.model_copy(update=pot),
            "elevation": config.elevation.model_copy(update=pot),
        }
    )


def _sentence(flown: Pass, summary: Summary, *, arduino: bool) -> str:
    flier = "the emulated Arduino" if arduino else "the box"
    work = ""
    if summary.relay_starts is not None:  # without relays no motor is switched on and off
        work = f"; {summary.relay_starts} relay starts, motors on for {summary.motor_s:.0f} s of {flown.end_s:.0f} s"
    known = ""
    if summary.recognised is not None:
        known = f"; it recognised {summary.recognised.name} after {summary.recognised.after_s:.0f} s"
    return (
        f"{flown.name}: {flier} was off by {summary.rms_deg:.2f}° rms, {summary.p95_deg:.2f}° at 95 %, "
        f"{summary.max_deg:.2f}° at worst{work}{known}"
    )


def _faults(texts: tuple[str, ...], flown: Pass, names: Collection[str]) -> list[tuple[float, str]]:
    """Raises click.UsageError also for a fault that would begin after the pass."""
    plan = parse_faults(texts, names)
    for at_s, name in plan:
        if at_s >= flown.end_s:
            raise click.UsageError(f"{name}@{at_s:g}: {flown.name} ends after {flown.end_s:.0f} s")
    return plan


def _make_sure_of(path: Path) -> None:
    """Before the flight: that a file can be made there. Raises CommandFailed."""
    try:
        with TemporaryFile(dir=path.parent):
            pass
    except OSError as fault:
        raise _not_written(path, fault) from None


def _not_written(path: Path, fault: OSError) -> CommandFailed:
    return CommandFailed(f"{path}: cannot be written: {fault.strerror}")


def _write_trace(path: Path, rows: list[Sample]) -> None:
    """As CSV, whole or not at all."""
    text = StringIO(newline="")
    writer = csv.writer(text)
    writer.writerow(field.name for field in fields(Sample))
    writer.writerows([round(value, 4) for value in astuple(row)] for row in rows)
    _write(path, text.getvalue())


def _write(path: Path, text: str) -> None:
    try:
        write_whole(path, text, mode=0o644)
    except OSError as fault:
        raise _not_written(path, fault) from None
