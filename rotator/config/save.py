"""Writes a calibration and other keys of a table back into the user's configuration file.

Comments stay, a copy with `.bak` is kept, and a power cut leaves a whole file. Does not know where the values come
from.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import tomlkit
from tomlkit.exceptions import TOMLKitError
from tomlkit.items import Array

from rotator.config import toml_text
from rotator.config.load import ConfigError, Mistake, is_empty, parse
from rotator.config.migrations import FormatError, brought_up
from rotator.config.writing import WRITING, replace

Points = Sequence[Sequence[float]]
LONG_TABLE = 4
"""A calibration with more points than this has one line for each point."""


def save_table(
    path: Path, name: str, *, calibration: Points | None = None, points: Points | None = None, **values: float | bool
) -> None:
    """Replace keys of a table, such as `azimuth` or `mount.model`, all or none. None leaves a key as it is.

    The old file stays beside it as `.bak`. Raises OSError or ConfigError, and then the file is unchanged.
    """
    with WRITING:
        try:
            before = toml_text.read(path)
            if is_empty(before):
                # Another program has emptied it. With these keys alone it would be the file of a simulated station.
                raise ConfigError(str(path), [Mistake("is empty")])
            text = changed(before, name, calibration=calibration, points=points, **values)
        except FormatError as fault:
            raise ConfigError(str(path), [Mistake(str(fault))]) from fault
        except (TOMLKitError, ValueError) as fault:
            raise ConfigError(str(path), [Mistake(f"is not TOML any more: {fault}")]) from fault
        except toml_text.NoTextError as none:
            raise ConfigError(str(path), [none.mistake]) from none
        # A text that the next start would refuse is not written.
        parse(text, str(path))
        replace(path, before, text)


def changed(
    text: str, name: str, *, calibration: Points | None = None, points: Points | None = None, **values: float | bool
) -> str:
    """The file's text with these keys in the table `[name]`; everything else as it was."""
    document = tomlkit.parse(brought_up(text))
    outer, *inner = name.split(".")
    if outer not in document and text and not text.endswith("\n\n"):
        document.add(tomlkit.nl())
    table = document.setdefault(outer, tomlkit.table(is_super_table=bool(inner)))
    for each in inner:
        table = table.setdefault(each, tomlkit.table())
    for key, value in values.items():
        table[key] = value if isinstance(value, bool) else _short(value, 3)
    park = document.get("mount", {}).get(f"park_{name}_deg")
    if park is not None and "min_deg" in values and "max_deg" in values:
        # A rotor that turns less far than the file had it parks as near to its old place as it can.
        document["mount"][f"park_{name}_deg"] = _short(min(max(park, values["min_deg"]), values["max_deg"]), 3)
    for key, rows in (("calibration", calibration), ("points", points)):
        if rows is not None:
            table[key] = _rows(rows)
    return tomlkit.dumps(document)


def _rows(points: Points) -> Array:
    """The first number of a calibration's point is a share of the sensor's range, and needs more decimals."""
    rows = tomlkit.array()
    for point in points:
        first, *others = point
        rows.append([round(first, 5), *(_short(each, 3) for each in others)])
    return rows.multiline(len(points) > LONG_TABLE)


def _short(value: float, digits: int) -> float | int:
    """450 rather than 450.0, as in a file written by hand."""
    value = round(value, digits)
    return int(value) if value == int(value) else value
