"""The checks of the configuration: does it load, and is there all that an axis needs before it may be aimed.

Knows what a person has to do once. Knows no hardware.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

from rotator.config.axes import AxisTable
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
    yield _set_up("azimuth", config.azimuth)
    yield _set_up("elevation", config.elevation)


def _set_up(axis: str, table: AxisTable) -> Finding:
    lacks = []
    if table.calibration is None:
        lacks.append("calibration")
    if not {"min_deg", "max_deg"} <= table.model_fields_set:
        lacks.append("limits")
    if not table.direction_checked:
        lacks.append("direction check")
    if lacks:
        return wrong(
            f"{axis} is not set up, and obeys short presses only: it lacks {', '.join(lacks)}",
            f"rotator calibrate {axis} --config FILE leads you through it, or write {axis}.min_deg, {axis}.max_deg, "
            f"{axis}.calibration and {axis}.direction_checked yourself.",
        )
    return fine(f"{axis}: {table.min_deg:g}° to {table.max_deg:g}°, calibrated, direction checked")
