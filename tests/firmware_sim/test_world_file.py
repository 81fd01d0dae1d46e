"""The simulated world outlives the program: angles, coast, and what the parts keep while they have power."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from firmware_sim import world_file
from firmware_sim.clock import SimClock
from firmware_sim.parts.motor import MotorSpec, SimMotor
from firmware_sim.world_file import WorldState
from hw.ports import Axis
from rotator.assembly.simulation import SimulatedStation
from rotator.assembly.station import Station
from rotator.config.model import Config

STATE = WorldState(7.5, (10.0, 20.0), (10.2, 20.0), (11.0, 20.0), (1, 0), 12, 0.0, ("SAT", "ANT"), {"a": 1.5})


def config_of(path: Path, kind: str = "relay-pot") -> Config:
    return Config.model_validate({"rotor": {"type": kind}, "sim": {"world": str(path)}})


def test_what_is_written_is_read(tmp_path: Path) -> None:
    path = tmp_path / "world.json"
    assert world_file.read(path) is None
    world_file.write(path, STATE)
    assert world_file.read(path) == STATE


@pytest.mark.parametrize(("started_deg", "rests_deg"), [(10.0, 10.9), (359.5, 362.0)])
def test_a_coast_ends_without_the_program_and_at_the_stop_at_the_latest(started_deg: float, rests_deg: float) -> None:
    clock = SimClock()
    motor = SimMotor(MotorSpec(6.0, 0.15, 0.0, 0.0, -2.0, 362.0), started_deg, clock())
    motor.speed_dps = 6.0
    if started_deg > 359:
        motor.speed_dps = 60.0
    assert motor.rests_deg == pytest.approx(rests_deg)
    motor.advance(60.0)
    assert motor.shaft_deg == pytest.approx(rests_deg, abs=1e-3)


@pytest.mark.parametrize("kind", ["relay-pot", "relay-pulse", "moteus", "servo", "digipot"])
def test_each_kind_stands_where_the_last_run_left_it(tmp_path: Path, kind: str) -> None:
    path = tmp_path / "world.json"
    world_file.write(path, replace(STATE, rests_deg=(123.4, 45.6), parts={}))
    world = SimulatedStation(config_of(path, kind), SimClock(), None, (0.0, 0.0)).build()
    assert world.shafts() == pytest.approx((123.4, 45.6))
    assert WorldState.of(world, 0.0).rests_deg == pytest.approx((123.4, 45.6))


def test_a_counted_axis_of_a_kept_world_is_unknown_until_it_is_homed(tmp_path: Path) -> None:
    """As on a Pi: without a file of counts the box does not know where the antenna is."""
    world_file.write(tmp_path / "world.json", STATE)
    clock = SimClock()
    station = Station(
        config_of(tmp_path / "world.json", "relay-pulse"),
        clock,
        clock.sleep,
        add_alarm=clock.add_alarm,
        counts=tmp_path / "counts.json",
    )
    try:
        assert station.rotor.condition(Axis.AZIMUTH).lost
    finally:
        station.close()


def test_a_moteus_without_power_forgets_its_turns_and_with_power_keeps_them(tmp_path: Path) -> None:
    path, clock = tmp_path / "world.json", SimClock()
    world_file.write(path, replace(STATE, rests_deg=(270.0, 0.0), parts={}))
    cut = SimulatedStation(config_of(path, "moteus"), clock, None, (0.0, 0.0)).build()
    forgotten = cut.kept()
    world_file.write(path, replace(STATE, rests_deg=(270.0, 0.0), parts={**forgotten, "azimuth_scale_rev": 0.0}))
    kept = SimulatedStation(config_of(path, "moteus"), clock, None, (0.0, 0.0)).build()
    assert cut.antenna() == pytest.approx(kept.antenna())
    assert abs(0.75 + forgotten["azimuth_scale_rev"]) < 0.051, "it knows the angle within a turn of the motor"
    assert kept.kept()["azimuth_scale_rev"] == 0.0
