"""The checks of the configuration: does it load, and is there all that an axis needs before it may be aimed.

Knows what a person has to do once. Knows no hardware.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

from hw.ports import Axis
from rotator.config.load import ConfigError, load
from rotator.config.model import Config
from rotator.doctor.finding import Finding, fine, wrong

NO_FILE = "Give --config a file that is there and yours to read; rotator config NAME prints one to start from."


def configuration(path: Path | None) -> Iterator[Finding]:
    try:
        config = load(path)
    except ConfigError as fault:
        readable = path is None or os.access(path, os.R_OK)
        advice = "Change that in the file; docs/configuration.md has every key." if readable else NO_FILE
        yield from (wrong(f"{fault.name}: {each}", advice) for each in fault.faults)
    else:
        rotor = "a simulated rotor" if config.rotor.hardware == "sim" else "a real rotor"
        yield fine(f"{path or 'the shipped one, for no file is given'}: {rotor}")


def axes(config: Config) -> Iterator[Finding]:
    if config.rotor.hardware == "sim":
        yield fine("a simulated rotor needs no calibration")
        return
    yield from (_set_up(config, axis) for axis in Axis)


def _set_up(config: Config, axis: Axis) -> Finding:
    name, table, told = axis.value, config.axis(axis), told_by(config, axis)
    lacks = []
    if not told and table.calibration is None:
        lacks.append("calibration")
    if not {"min_deg", "max_deg"} <= table.model_fields_set:
        lacks.append("limits")
    if not table.direction_checked:
        lacks.append("direction check")
    if lacks:
        keys = [f"{name}.{key}" for key in ("min_deg", "max_deg", *(() if told else ("calibration",)))]
        return wrong(
            f"{name} is not set up, and obeys short presses only: it lacks {', '.join(lacks)}",
            f"rotator calibrate {name} --config FILE leads you through it, or write {', '.join(keys)} and "
            f"{name}.direction_checked yourself.",
        )
    return fine(f"{name}: {table.min_deg:g}° to {table.max_deg:g}°, {told or 'calibrated'}, direction checked")


def told_by(config: Config, axis: Axis) -> str:
    """How the axis's angle comes, where it comes in degrees; empty: by a calibration."""
    if not config.in_degrees(axis):
        return ""
    if config.axis(axis).sensor.kind != "own":
        return "told by gravity"
    match config.rotor.type:
        case "relay-pulse":
            return "counted"
        case "moteus":
            return "told by its controller"
        case _:
            return "modelled"
