"""Writes a calibration and other keys of a table back into the user's configuration file.

Comments stay, a copy with `.bak` is kept, and a power cut leaves a whole file. Does not know where the values come
from.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from rotator.config.edit import Change, NoChangeError, edited
from rotator.config.load import ConfigError, Mistake, is_empty, parse
from rotator.config.migrations import FormatError
from rotator.config.statements import Place
from rotator.config.toml_text import WRITING, read, replace
from rotator.exchange.foreign import toml_of

Points = Sequence[Sequence[float]]
Value = float | bool | tuple[float, ...]


def save_table(
    path: Path,
    name: str,
    *,
    calibration: Points | None = None,
    points: Points | None = None,
    times_s: tuple[float, float] | None = None,
    **values: Value,
) -> None:
    """Replace keys of a table, such as `azimuth` or `mount.model`, all or none. None leaves a key as it is.

    `times_s`: of the axis `name`, for its table in [timed].

    The old file stays beside it as `.bak`. Raises OSError or ConfigError, and then the file is unchanged.
    """
    with WRITING:
        try:
            before = read(path)
            if is_empty(before):
                # Another program has emptied it. With these keys alone it would be the file of a simulated station.
                raise ConfigError(str(path), [Mistake("is empty")])
            text = changed(before, name, calibration=calibration, points=points, times_s=times_s, **values)
        except (FormatError, NoChangeError) as fault:
            raise ConfigError(str(path), [Mistake(str(fault))]) from fault
        except ValueError as fault:
            raise ConfigError(str(path), [Mistake(f"is not TOML any more: {fault}")]) from fault
        # A text that the next start would refuse is not written.
        parse(text, str(path))
        replace(path, before, text)


def changed(
    text: str,
    name: str,
    *,
    calibration: Points | None = None,
    points: Points | None = None,
    times_s: tuple[float, float] | None = None,
    **values: Value,
) -> str:
    """The file's text with these keys in the table `[name]`; everything else as it was."""
    table = tuple(name.split("."))
    wanted: dict[Place, object] = {(*table, key): _written(value) for key, value in values.items()}
    park = toml_of(text).get("mount", {}).get(f"park_{name}_deg")
    if park is not None and "min_deg" in values and "max_deg" in values:
        # A rotor that turns less far than the file had it parks as near to its old place as it can.
        wanted["mount", f"park_{name}_deg"] = _short(min(max(park, values["min_deg"]), values["max_deg"]), 3)
    for key, time_s in zip(("to_high_s", "to_low_s"), times_s or (), strict=False):
        wanted["timed", name, key] = _short(time_s, 1)
    for key, rows in (("calibration", calibration), ("points", points)):
        if rows is not None:
            # The first number of a calibration's point is a share of the sensor's range, and needs more decimals.
            wanted[*table, key] = [[round(first, 5), *(_short(each, 3) for each in others)] for first, *others in rows]
    return edited(text, [Change(place, value) for place, value in wanted.items()])


def _written(value: Value) -> object:
    match value:
        case bool():
            return value
        case tuple():
            return [_short(each, 3) for each in value]
    return _short(value, 3)


def _short(value: float, digits: int) -> float | int:
    """450 rather than 450.0, as in a file written by hand."""
    value = round(value, digits)
    return int(value) if value == int(value) else value
