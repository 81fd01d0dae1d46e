"""`rotator rehearse`: fly a pass on the simulated rotor and say how well it went.

Knows files and output. The flying is `rotator.rehearsal.flight`.
"""

from __future__ import annotations

import csv
import json
import logging
import os
from dataclasses import astuple, fields
from pathlib import Path

import click

from firmware_sim.clock import SimClock
from rotator.cli.faults import parse_faults
from rotator.config.axes import AxisTable
from rotator.config.load import load
from rotator.config.model import Config
from rotator.rehearsal.flight import BoxPlant, Plant, Sample, Summary, fly, plant_maker
from rotator.rehearsal.passes import Pass, PassError, read_pass


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
    make = plant_maker(config, via=via, arduino=arduino)

    def make_faulty(clock: SimClock, flown: Pass) -> Plant:
        plant = make(clock, flown)
        if isinstance(plant, BoxPlant):
            for at_s, name in parse_faults(faults, plant.world):
                _strike(clock, at_s, plant, name)
        return plant

    rows, summary = fly(flown, make_faulty)
    if trace is not None:
        _write_trace(trace, rows)
    if as_json:
        click.echo(json.dumps(summary.as_dict()))
    else:
        click.echo(_sentence(flown, summary, arduino=arduino))


def simulated(config: Config) -> Config:
    """The file of a real station, its rotor simulated with healthy pots; nothing real is touched."""
    # The simulated pots read what they read, whatever the file says of the real ones.
    pot = {"calibration": None}
    pot |= {key: AxisTable.model_fields[key].default for key in ("lowest_reading", "highest_reading")}
    return config.model_copy(
        update={
            "rotor": config.rotor.model_copy(update={"hardware": "sim"}),
            "azimuth": config.azimuth.model_copy(update=pot),
            "elevation": config.elevation.model_copy(update=pot),
        }
    )


def _strike(clock: SimClock, at_s: float, plant: BoxPlant, name: str) -> None:
    pending = [at_s]

    def ring(_now_s: float) -> None:
        pending.clear()
        plant.world.inject(name)

    clock.add_alarm(lambda: pending[0] if pending else None, ring)


def _sentence(flown: Pass, summary: Summary, *, arduino: bool) -> str:
    who = "the emulated Arduino" if arduino else "the box"
    return (
        f"{flown.name}: {who} was off by {summary.rms_deg:.2f}° rms, {summary.p95_deg:.2f}° at 95 %, "
        f"{summary.max_deg:.2f}° at worst; {summary.relay_starts} relay starts, motors on for {summary.motor_s:.0f} s "
        f"of {flown.end_s:.0f} s"
    )


def _write_trace(path: Path, rows: list[Sample]) -> None:
    """Whole or not at all."""
    new = path.with_name(path.name + ".new")
    try:
        with new.open("w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file)
            writer.writerow(field.name for field in fields(Sample))
            writer.writerows([round(value, 4) for value in astuple(row)] for row in rows)
        os.replace(new, path)
    except OSError as fault:
        raise click.ClickException(f"{path}: cannot be written: {fault.strerror}") from None
