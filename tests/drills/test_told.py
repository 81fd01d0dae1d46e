"""Every fault of every simulated rotor has a rule, or a reason in words why no message is due."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
import tomlkit

from benchmarks.drills.boxes import PANEL, SWITCHES
from benchmarks.drills.told import PANEL as OF_THE_PANEL
from benchmarks.drills.told import SEEN, UNTOLD, plain
from firmware_sim.clock import SimClock
from rotator.assembly.station import Station
from rotator.cli.rehearse import simulated
from rotator.config.load import ConfigError, parse, profiles, shipped

BARE = ("panel", "limits", "lcd")
MORE: tuple[dict[str, Any], ...] = (
    {"lcd": {"kind": "pcf8574"}},
    {"limits": SWITCHES, "lcd": {"kind": "none"}},
    {"lcd": {"kind": "none"}, "panel": PANEL},
    {"azimuth": {"sensor": {"kind": "as5600"}}, "elevation": {"sensor": {"kind": "mpu6050"}}},
    {axis: {"sensor": {"kind": "pot"}} for axis in ("azimuth", "elevation")},
    {"compass": {"kind": "bno055"}},
)


def every_fault() -> Iterator[str]:
    """Of each shipped configuration, one after the other with a display, switches, a panel, other sensors."""
    for profile in profiles():
        for more in MORE:
            values = tomlkit.parse(shipped(profile)).unwrap()
            for table in BARE:
                values.pop(table, None)
            for table, keys in more.items():
                values.setdefault(table, {}).update(keys)
            values["rotor"]["hardware"] = "sim"
            try:
                config = simulated(parse(tomlkit.dumps(values), profile))
            except ConfigError:
                continue  # this kind of rotor has no such part
            clock = SimClock()
            station = Station(config, clock, clock.sleep, (90.0, 45.0))
            assert station.world is not None
            yield from station.world.faults
            station.close()


@pytest.fixture(scope="module")
def faults() -> set[str]:
    return {plain(name) for name in every_fault() if not name.startswith(OF_THE_PANEL)}


def test_each_fault_is_judged_or_excused_in_words_and_none_is_both(faults: set[str]) -> None:
    assert sorted(faults - set(SEEN) - set(UNTOLD)) == []
    assert set(SEEN).isdisjoint(UNTOLD)


def test_each_rule_and_each_excuse_is_about_a_fault_of_a_simulator(faults: set[str]) -> None:
    of_the_drills = {"hung", "every", "card-hangs"}
    assert (set(SEEN) | set(UNTOLD)) - of_the_drills == faults
