"""From a configuration to the files that outlast a run: trust in relays, vain tries, a latched stop, learnt motors.

Part of the composition root. Knows where each file is, and which settings its content depends on. Does not know what is
in a file.
"""

from __future__ import annotations

from pathlib import Path

from hw.ports import AngleSource, Axis
from rotator.assembly.settings import build_offsets, own_points
from rotator.config.axes import AxisTable
from rotator.config.model import Config
from rotator.config.sim import SimAxisTable
from rotator.store import counts, relays
from rotator.store.counts import CountsFile
from rotator.store.latch import FILE_NAME as LATCH_NAME
from rotator.store.latch import LatchFile
from rotator.store.learnt import LearntFile
from rotator.store.relays import RelaysFile
from rotator.store.tries import FILE_NAME as TRIES_NAME
from rotator.store.tries import TriesFile


def build_relays_file(config: Config, memory: Path | None = None) -> RelaysFile | None:
    """The file in which a doubt about a relay survives the program; None where the rotor does not, or has no relays.

    `memory`: a folder in memory, for a card that refuses; None: there is none.
    """
    kept = config.keeps_files and config.rotor.switched
    return RelaysFile(Path(config.state.path).with_name(relays.FILE_NAME), memory) if kept else None


def build_tries_file(config: Config, memory: Path | None = None) -> TriesFile | None:
    """The file of vain tries and of the stops that were met; None where the rotor does not outlive the program.

    A stop that was met with another calibration, offset or limit is forgotten.
    """
    if not config.keeps_files:
        return None
    settings = {axis: _scale(config, axis) for axis in Axis}
    return TriesFile(Path(config.state.path).with_name(TRIES_NAME), memory, settings)


def build_latch_file(config: Config, memory: Path | None = None) -> LatchFile:
    return LatchFile(Path(config.state.path).with_name(LATCH_NAME), memory)


def build_modelled_file(config: Config) -> CountsFile | None:
    """The file of the angles that only a model knows, kept with these settings. None: none outlives the program."""
    modelled = [axis for axis in Axis if config.angle(axis).source is AngleSource.MODELLED]
    if not modelled or not config.keeps_files:
        return None
    tables = config.servo if config.rotor.type == "servo" else config.digipot
    settings = {
        axis: {"hardware": config.rotor.hardware, **tables.of(axis).model_dump(mode="json")} for axis in modelled
    }
    return CountsFile(Path(config.state.path).with_name(counts.FILE_NAME), settings)


def build_learnt(config: Config) -> LearntFile:
    """The file of the learnt motors. It ignores figures that were learnt with other settings of the motor."""

    def described(table: AxisTable, sim: SimAxisTable) -> dict[str, object]:
        motor: dict[str, object] = {"hardware": config.rotor.hardware}
        motor |= {"speed_dps": table.speed_dps, "coast_s": table.coast_s}
        if config.rotor.hardware == "sim":
            motor["sim"] = sim.model_dump(include={"speed_dps", "lag_s", "relay_delay_s"})
        return motor

    return LearntFile(
        Path(config.state.path),
        {
            Axis.AZIMUTH: described(config.azimuth, config.sim.azimuth),
            Axis.ELEVATION: described(config.elevation, config.sim.elevation),
        },
    )


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
