"""`rotator rehearse`: fly a pass on the simulated rotor and report the pointing error.

Knows files and output, and makes a simulated station of the configuration of a real one. `rotator.rehearsal.flight`
flies the pass.
"""

from __future__ import annotations

import csv
import json
import logging
from dataclasses import astuple, fields
from functools import partial
from io import StringIO
from pathlib import Path

import click

from rotator.cli.faults import parse_faults
from rotator.config.axes import AxisTable
from rotator.config.load import load
from rotator.config.model import Config
from rotator.rehearsal.flight import Sample, Summary, fly, plant_maker
from rotator.rehearsal.passes import Pass, PassError, read_pass
from rotator.store.whole import write_whole


def rehearse_pass(
    pass_file: Path,
    path: Path | None,
    faults: tuple[str, ...],
    *,
    via: str,
    trace: Path | None,
    as_json: bool,
    arduino: bool,
) -> None:
    logging.basicConfig(level=logging.WARNING, format="%(levelname).1s %(message)s")
    config = load(path)
    if config.rotor.hardware != "sim":
        config = simulated(config)
    try:
        flown = read_pass(pass_file)
    except PassError as fault:
        raise click.ClickException(str(fault)) from None
    if arduino and faults:
        raise click.UsageError("--fault is for the box, not for the Arduino")
    make = plant_maker(config, via=via, arduino=arduino, faults=partial(parse_faults, faults))
    rows, summary = fly(flown, make)
    if trace is not None:
        _write_trace(trace, rows)
    if as_json:
        click.echo(json.dumps(summary.as_dict()))
    else:
        click.echo(_sentence(flown, summary, arduino=arduino))


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
    return (
        f"{flown.name}: {flier} was off by {summary.rms_deg:.2f}° rms, {summary.p95_deg:.2f}° at 95 %, "
        f"{summary.max_deg:.2f}° at worst{work}"
    )


def _write_trace(path: Path, rows: list[Sample]) -> None:
    """As CSV, whole or not at all."""
    text = StringIO(newline="")
    writer = csv.writer(text)
    writer.writerow(field.name for field in fields(Sample))
    writer.writerows([round(value, 4) for value in astuple(row)] for row in rows)
    try:
        write_whole(path, text.getvalue())
    except OSError as fault:
        raise click.ClickException(f"{path}: cannot be written: {fault.strerror}") from None
