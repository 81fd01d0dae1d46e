"""The checks of the configuration: whether it loads, whether each axis is set up, and its forbidden sectors.

An axis of real hardware needs limits, a direction check, and a calibration unless its readings are degrees. Reads the
file and no hardware.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

from hw.ports import Axis
from rotator.assembly.settings import missing, own_points
from rotator.config.forbidden import seen_again
from rotator.config.load import ConfigError, load
from rotator.config.model import Config
from rotator.doctor.finding import Finding, fine, warn, wrong
from rotator.doctor.machine import Machine
from rotator.exchange.faults import Missing

KEYS = {
    Missing.CALIBRATION: ("calibration",),
    Missing.LIMITS: ("min_deg", "max_deg"),
    Missing.DIRECTION_CHECK: ("direction_checked",),
}
"""What a person writes who sets up an axis by hand."""
NO_FILE = "Give --config an existing file that you may read; rotator config NAME prints one to start from."


def configuration(path: Path | None) -> Iterator[Finding]:
    try:
        config = load(path)
    except ConfigError as fault:
        readable = path is None or os.access(path, os.R_OK)
        advice = "Change that in the file; `rotator help keys` has every key." if readable else NO_FILE
        yield from (wrong(f"{fault.name}: {each}", advice) for each in fault.mistakes)
    else:
        rotor = "a simulated rotor" if config.simulated else "a real rotor"
        yield fine(f"{path or 'the shipped one, because no file is given'}: {rotor}")


def axes(_machine: Machine, config: Config) -> Iterator[Finding]:
    if config.simulated:
        yield fine("a simulated rotor needs no calibration")
        return
    yield from (_set_up(config, axis) for axis in config.fitted)


def sectors(_machine: Machine, config: Config) -> Iterator[Finding]:
    again = seen_again(config.mount.forbidden, {axis: config.axis(axis) for axis in Axis})
    for sentence, keys in again:
        yield warn(sentence, f"If the antenna touches it there, add a [[mount.forbidden]] with {keys}.")
    if not again:
        yield fine(", ".join(table.name for table in config.mount.forbidden))


def _set_up(config: Config, axis: Axis) -> Finding:
    name, table, angle = axis.value, config.axis(axis), config.angle(axis)
    lacks = missing(table, calibrated=own_points(config, axis) is not None)
    if not table.sensor.learnt:
        return wrong(
            f"{name} is not set up, and obeys short presses only: its compass has not learnt the iron around it",
            f"Run rotator calibrate compass --config FILE, then rotator calibrate {name} --config FILE.",
        )
    if lacks:
        keys = [f"{name}.{key}" for each in lacks for key in KEYS[each]]
        return wrong(
            f"{name} is not set up, and obeys short presses only: it lacks {', '.join(each.text for each in lacks)}",
            f"Run rotator calibrate {name} --config FILE; or write {' and '.join(keys)} yourself.",
        )
    known = angle.by or "calibrated"
    span = "turns without ends" if config.endless(axis) else f"{table.min_deg:g}° to {table.max_deg:g}°"
    return fine(f"{name}: {span}, {known}, direction checked")
