"""From a configuration to what outlasts a run: trust in relays, vain tries, a latched stop, learnt motors, counts.

Part of the composition root. Knows where the files are, and which settings their content depends on. Does not know what
is in them.
"""

from __future__ import annotations

import os
from pathlib import Path

from hw.ports import AngleSource, Axis
from rotator.assembly.settings import build_offsets, own_points
from rotator.config.model import Config
from rotator.config.places import memory_folder
from rotator.store import counts
from rotator.store.counts import CountsFile
from rotator.store.learnt import KeptMotors
from rotator.store.relays import KeptRelays
from rotator.store.state import State
from rotator.store.tries import KeptTries


def build_state(config: Config, path: Path | None = None) -> State:
    """What the box remembers. `path`: the configuration's file."""
    return State(Path(config.state.path), memory_folder(config.state.path, path, os.environ))


def build_relays(config: Config, state: State) -> KeptRelays | None:
    """The doubts about relays that survive the program; None where the rotor does not, or has no relays."""
    return KeptRelays(state) if config.keeps_files and config.rotor.switched else None


def build_tries(config: Config, state: State) -> KeptTries | None:
    """The vain tries and the stops that were met; None where the rotor does not outlive the program.

    A stop that was met with another calibration, offset or limit is forgotten.
    """
    if not config.keeps_files:
        return None
    settings = {axis: _scale(config, axis) for axis in config.fitted}
    return KeptTries(state, settings)


def build_modelled_file(config: Config) -> CountsFile | None:
    """The file of the angles that only a model knows, kept with these settings. None: none outlives the program."""
    modelled = [axis for axis in config.fitted if config.angle(axis).source is AngleSource.MODELLED]
    if not modelled or not config.keeps_files or config.rotor.switched:
        return None
    tables = config.servo if config.rotor.type == "servo" else config.digipot
    settings = {
        axis: {"hardware": config.rotor.hardware, **tables.of(axis).model_dump(mode="json")} for axis in modelled
    }
    return CountsFile(Path(config.state.path).with_name(counts.FILE_NAME), settings)


def build_learnt(config: Config, state: State) -> KeptMotors:
    """The learnt motors. Figures that were learnt with other settings of the motor are ignored."""

    def described(axis: Axis) -> dict[str, object]:
        table = config.axis(axis)
        motor: dict[str, object] = {"hardware": config.rotor.hardware}
        motor |= {"speed_dps": table.speed_dps, "coast_s": table.coast_s}
        if config.simulated:
            motor["sim"] = config.sim.of(axis).model_dump(include={"speed_dps", "lag_s", "relay_delay_s"})
        return motor

    return KeptMotors(state, {axis: described(axis) for axis in Axis})


def _scale(config: Config, axis: Axis) -> dict[str, object]:
    """What an angle of the axis depends on: an end stop that it has met is at the same angle while these are the same.

    In the types of JSON, to be compared with those in a file.
    """
    table, shift, stop = config.axis(axis), build_offsets(config), config.end_stop(axis)
    points = own_points(config, axis)
    return {
        "hardware": config.rotor.hardware,
        "sensor": config.angle(axis).sensor,
        "limits_deg": [table.min_deg, table.max_deg],
        "offset_deg": shift.deg(axis),
        "points": None if points is None else [list(point) for point in points],
        "home_deg": None if stop is None else stop.home_deg,
    }
