"""What a calibration can end with, and which keys of the file that becomes: saved there, or shown as text."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from hw.ports import Axis, Ellipse
from rotator.config.mount import SkyRow
from rotator.control.sky.pointing_model import PointingModel

if TYPE_CHECKING:
    from rotator.config.save import Tables


@dataclass(frozen=True, slots=True)
class AxisCalibrated:
    """An axis that is set up. Limits are degrees on the rotor's own scale; the direction has been checked."""

    axis: Axis
    points: tuple[tuple[float, float], ...] | None
    """(reading, degrees) in rising degrees. None: the axis reads degrees and needs no table."""
    min_deg: float
    max_deg: float
    times_s: tuple[float, float] | None = None
    """From stop to stop, up and down, of an axis from which nothing comes back; None: not measured."""


@dataclass(frozen=True, slots=True)
class FieldLearnt:
    """What the compass that is the azimuth's sensor has learnt of the iron around it."""

    ellipse: Ellipse


@dataclass(frozen=True, slots=True)
class NorthFound:
    """`offset_deg` is the new `azimuth.offset_deg`."""

    offset_deg: float
    uncertainty_deg: float


@dataclass(frozen=True, slots=True)
class MountFound:
    """How the mount really stands, and the points that say so, on the rotor's own scale."""

    model: PointingModel
    points: tuple[SkyRow, ...]


@dataclass(frozen=True, slots=True)
class AngleConfirmed:
    """The controller has accepted the azimuth's angle. There is nothing to save."""

    angle_deg: float


Saved = AxisCalibrated | FieldLearnt | NorthFound | MountFound
Result = Saved | AngleConfirmed


def save(result: Saved, path: Path) -> None:
    """Write into the file, whole or not at all. Raises OSError or ConfigError."""
    from rotator.config.save import save_tables  # noqa: PLC0415 - loads tomlkit, which a start can do without

    save_tables(path, _tables(result))


def saved_in(path: Path) -> str:
    """The sentence for the operator after `save`."""
    return f"Saved in {path}; the file before is {path.name}.bak."


def as_toml(result: Saved) -> str:
    """The same keys as text, for an operator who gave no file."""
    from rotator.config.save import changed  # noqa: PLC0415

    return changed("", _tables(result))


def _tables(result: Saved) -> Tables:
    match result:
        case AxisCalibrated(axis, points, min_deg, max_deg, times_s):
            table = {"calibration": points} if points else {}
            timed = {"to_high_s": times_s[0], "to_low_s": times_s[1]} if times_s else {}
            limits = {"min_deg": min_deg, "max_deg": max_deg, "direction_checked": True}
            return {axis.value: {**limits, **table}, f"timed.{axis.value}": timed}
        case FieldLearnt(ellipse):
            return {"azimuth.sensor": asdict(ellipse)}
        case NorthFound(offset_deg):
            return {"azimuth": {"offset_deg": offset_deg}}
        case MountFound(model, points):
            return {"mount.model": {**asdict(model), "points": [[round(part, 3) for part in row] for row in points]}}
