"""The configuration of the box of a drill: a shipped one with the drill's keys, on a simulated rotor.

Knows which tables a drill leaves out, and where its files are. Does not know what the keys mean.
"""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

import tomlkit

from benchmarks.drills.script import Drill
from rotator.cli.rehearse import simulated
from rotator.config.load import parse, shipped
from rotator.config.model import Config


def configured(drill: Drill, folder: Path) -> Config:
    """The shipped configuration with the drill's keys, on a simulated rotor that outlives the program."""
    values = tomllib.loads(shipped(drill.profile))
    for table in ("link", "lcd", "panel", "limits"):
        values.pop(table, None)
    _merge(values, drill.tables)
    _merge(
        values, {"lcd": {"kind": "none"}, "rotor": {"hardware": "sim"}, "state": {"path": str(folder / "state.json")}}
    )
    # With a world file the box keeps files of its own and trusts them. The drill itself keeps the world in memory.
    _merge(values, {"sim": {"world": str(folder / "world.json"), "bus_takes_time": False}})
    _park_within(values)
    return simulated(parse(tomlkit.dumps(values), drill.profile))


def _park_within(values: dict[str, Any]) -> None:
    """A shipped file parks at 0, where a drill's range may not reach."""
    for axis in ("azimuth", "elevation"):
        park = values.get("mount", {}).get(f"park_{axis}_deg")
        if park is not None and "max_deg" in values[axis]:
            values["mount"][f"park_{axis}_deg"] = min(
                max(park, values[axis].get("min_deg", 0.0)), values[axis]["max_deg"]
            )


def _merge(values: dict[str, Any], more: dict[str, Any]) -> None:
    for key, value in more.items():
        if isinstance(value, dict):
            _merge(values.setdefault(key, {}), value)
        else:
            values[key] = value
