"""Writes a calibration and other keys of a table back into the user's configuration file.

Comments stay, a copy with `.bak` is kept, and a power cut leaves a whole file. Does not know where the values come
from.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from rotator.config.edit import Change, NoChangeError, edited
from rotator.config.load import ConfigError, Mistake, is_empty, parse
from rotator.config.migrations import FormatError
from rotator.config.statements import Place
from rotator.config.toml_text import WRITING, read, replace
from rotator.exchange.foreign import toml_of

Value = float | bool | Sequence[float] | Sequence[Sequence[float]]
Tables = Mapping[str, Mapping[str, Value]]
"""New values of keys, by the name of their table, such as `azimuth` or `mount.model`."""


def save_tables(path: Path, tables: Tables) -> None:
    """Replace these keys of the file, all or none; the old file stays beside it as `.bak`.

    Raises OSError or ConfigError, and then the file is unchanged.
    """
    with WRITING:
        try:
            before = read(path)
            if is_empty(before):
                # Another program has emptied it. With these keys alone it would be the file of a simulated station.
                raise ConfigError(str(path), [Mistake("is empty")])
            text = changed(before, tables)
        except (FormatError, NoChangeError) as fault:
            raise ConfigError(str(path), [Mistake(str(fault))]) from fault
        except ValueError as fault:
            raise ConfigError(str(path), [Mistake(f"is not TOML any more: {fault}")]) from fault
        # A text that the next start would refuse is not written.
        parse(text, str(path))
        replace(path, before, text)


def changed(text: str, tables: Tables) -> str:
    """The file's text with these keys; everything else as it was."""
    wanted: dict[Place, object] = {}
    mount = toml_of(text).get("mount", {})
    for name, values in tables.items():
        wanted |= {(*name.split("."), key): _written(value) for key, value in values.items()}
        match mount.get(park := f"park_{name}_deg"), values:
            case float() | int() as park_deg, {
                "min_deg": float() | int() as least_deg,
                "max_deg": float() | int() as most_deg,
            }:
                # A rotor that turns less far than the file had it parks as near to its old place as it can.
                wanted["mount", park] = _short(min(max(park_deg, least_deg), most_deg))
    return edited(text, [Change(place, value) for place, value in wanted.items()])


def _written(value: Value) -> object:
    match value:
        case bool():
            return value
        case float() | int():
            return _short(value)
    return [_row(each) if isinstance(each, Sequence) else _short(each) for each in value]


def _row(row: Sequence[float]) -> list[float]:
    """The first number of a calibration's point is a share of the sensor's range, and needs more decimals."""
    first, *others = row
    return [round(first, 5), *map(_short, others)]


def _short(value: float) -> float | int:
    """450 rather than 450.0, as in a file written by hand."""
    value = round(value, 3)
    return int(value) if value == int(value) else value
