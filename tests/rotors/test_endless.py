"""An azimuth without ends: relays with a magnet on the shaft, a moteus, an H-bridge that counts. Judged by the boom.

The simulated rotors have no stops there, and their own scale goes on and on: one that unwinds shows it.
"""

from __future__ import annotations

import json
import random
from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from statistics import fmean
from typing import Any

import pytest

from hw.ports import AngleSource, Axis, Direction
from rotator.assembly.settings import build_mount, planned_motors
from rotator.config.load import ConfigError, parse
from rotator.control.sky.flight_plan import Antenna, plan_flight
from rotator.control.sky.known_path import KnownPath
from rotator.exchange.orders import Aim, Confirm, Jog, Park, Stop
from rotator.protocols import rotctld_caps
from rotator.protocols.status_object import as_object
from rotator.rehearsal.flight import fly, plant_maker
from rotator.rehearsal.passes import SHIPPED, Pass, read_pass
from rotator.tracking.travel import Travel
from tests.rotors.rig import KINDS, Box, Kind, configured

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
ENDLESS: dict[str, Any] = {"endless": True, "min_deg": None, "max_deg": None, "offset_deg": None}
MAGNET = Kind("g5500", AngleSource.MEASURED, (90.0, 30.0), 1.0, 1.3)
BY_PROFILE = {kind.profile: kind for kind in (*KINDS, MAGNET)}
TABLES: dict[str, dict[str, Any]] = {
    "g5500": ENDLESS | {"calibration": None, "sensor": {"kind": "as5600"}, "longest_run_s": 0, "tolerance_deg": 1.0},
    "isel": ENDLESS,
    "slew-drive": ENDLESS,
}
WALL: dict[str, Any] = {"name": "the wall", "azimuth_deg": [100.0, 120.0], "elevation_deg": [-1.0, 181.0]}
NORTH: dict[str, Any] = {"name": "the mast", "azimuth_deg": [350.0, 370.0], "elevation_deg": [0.0, 45.0]}

each_kind = pytest.mark.parametrize("profile", TABLES)


def made(new_box: Callable[..., Box], profile: str, **tables: Any) -> Box:
    tables = {"azimuth": TABLES[profile], "mount": {}} | tables
    tables["mount"] = {"park_azimuth_deg": None, "forbidden": []} | tables["mount"]
    box = new_box(BY_PROFILE[profile], **tables)
    box.run(1.0)
    return box


def way_deg(from_deg: float, to_deg: float) -> float:
    return (to_deg - from_deg + 180.0) % 360.0 - 180.0


@each_kind
def test_it_turns_the_short_way_wherever_it_stands(profile: str, new_box: Callable[..., Box]) -> None:
    box, places = made(new_box, profile), random.Random(profile)
    for _ in range(6):
        began_deg, wanted_deg = box.boom_deg(AZ), float(places.randrange(360))
        box.order(Aim(wanted_deg, 30.0))
        box.until_it_stands()
        turned_deg, short_deg = box.boom_deg(AZ) - began_deg, way_deg(began_deg, wanted_deg)
        assert abs(way_deg(box.boom_deg(AZ), wanted_deg)) < 1.5
        assert abs(turned_deg) < abs(short_deg) + 2.0
        axis = box.axis(AZ)
        assert axis.angle_deg is not None
        assert 0 <= axis.angle_deg < 360
        assert axis.at_target


@pytest.mark.parametrize(
    ("profile", "speed_dps", "turns"), [("g5500", 60.0, 100), ("isel", 30.0, 4), ("slew-drive", 3.0, 1)]
)
def test_many_turns_the_same_way_and_then_home_without_one_back(
    profile: str, speed_dps: float, turns: int, new_box: Callable[..., Box]
) -> None:
    fast = {"speed_dps": speed_dps}
    box = made(new_box, profile, azimuth=TABLES[profile] | fast, sim={"azimuth": fast})
    began_deg, asked_deg = box.boom_deg(AZ), 0.0
    while asked_deg < turns * 360.0:
        asked_deg += 0.7 * speed_dps
        box.order(Aim((began_deg + asked_deg) % 360.0, 30.0))
        box.run(1.0)
        assert json.dumps(as_object(box.status), allow_nan=False)
        assert not box.status.faults
    box.until_it_stands()
    assert box.boom_deg(AZ) == pytest.approx(began_deg + asked_deg, abs=3.0)
    stood_deg = box.boom_deg(AZ)
    box.order(Park())
    box.until_it_stands()
    assert abs(box.boom_deg(AZ) - stood_deg) < 182.0
    assert abs(way_deg(box.boom_deg(AZ), 0.0)) < 1.5


def total_deg(azimuths_deg: list[float]) -> float:
    return sum(abs(way_deg(a, b)) for a, b in pairwise(azimuths_deg))


def across_north(flown: Pass) -> Pass:
    """The two minutes in which it goes through north."""
    crosses_s = next(a[0] for a, b in pairwise(flown.rows) if abs(a[1] - b[1]) > 180.0)
    rows = [row for row in flown.rows if abs(row[0] - crosses_s) <= 60.0]
    return Pass(flown.name, tuple((row[0] - rows[0][0], row[1], row[2]) for row in rows))


@pytest.mark.parametrize(("profile", "most_rms_deg"), [("g5500", 2.0), ("isel", 0.3), ("slew-drive", 0.6)])
def test_a_pass_across_north_is_flown_through(profile: str, most_rms_deg: float) -> None:
    """The antenna turns as far as the satellite does, and no degree back."""
    config = configured(profile, azimuth=TABLES[profile], mount={"park_azimuth_deg": None, "forbidden": []})
    flown = across_north(read_pass(SHIPPED / "north-1-iss.csv"))
    trace, _ = fly(flown, plant_maker(config, via="rotctld"))
    needed_deg = total_deg([row[1] for row in flown.rows])
    errors_deg = [sample.error_deg for sample in trace if sample.t > 30.0]  # it starts level
    assert fmean(error_deg**2 for error_deg in errors_deg) < most_rms_deg**2
    assert total_deg([sample.antenna_az for sample in trace]) < needed_deg + 20.0


def test_a_count_goes_on_after_a_restart(new_box: Callable[..., Box], tmp_path: Path) -> None:
    counts = tmp_path / "counts.json"
    box = made(new_box, "slew-drive", counts=counts)
    box.order(Confirm(AZ, 90.0), Confirm(EL, 30.0))
    box.run(1.0)
    box.order(Jog(AZ, Direction.MINUS))
    box.run(400.0)
    box.order(Stop())
    box.until_it_stands()
    stood_deg = box.boom_deg(AZ)
    assert stood_deg < -1050  # beyond the widest range that a file can name
    box.close()
    again = made(new_box, "slew-drive", start_deg=(stood_deg, 30.0), counts=counts)
    assert way_deg(again.boom_deg(AZ), stood_deg) == pytest.approx(0, abs=0.2)
    assert again.axis(AZ).angle_deg == pytest.approx(stood_deg % 360.0, abs=0.2)
    began_deg = again.boom_deg(AZ)
    again.order(Aim((stood_deg + 170.0) % 360.0, 30.0))
    again.until_it_stands()
    assert again.boom_deg(AZ) == pytest.approx(began_deg + 170.0, abs=1.0)


def inside(box: Box, sectors: list[dict[str, Any]]) -> bool:
    azimuth_deg, elevation_deg = box.boom_deg(AZ) % 360.0, box.boom_deg(EL)
    return any(
        low < elevation_deg < high and any(west < azimuth_deg + turn < east for turn in (-360.0, 0.0, 360.0))
        for sector in sectors
        for (west, east), (low, high) in [(sector["azimuth_deg"], sector["elevation_deg"])]
    )


def run(box: Box, seconds: float, sectors: list[dict[str, Any]]) -> None:
    for _ in range(round(seconds * 10)):
        box.run(0.1)
        assert not inside(box, sectors), f"{box.boom_deg(AZ):.2f} {box.boom_deg(EL):.2f} {box.status.azimuth}"


@each_kind
def test_round_a_wall_it_goes_the_long_way(profile: str, new_box: Callable[..., Box]) -> None:
    box = made(new_box, profile, start_deg=(80.0, 30.0), mount={"forbidden": [WALL]})
    patience_s = 30.0 if profile == "isel" else 120.0
    for wanted_deg, at_deg in ((140.0, -220.0), (80.0, 80.0), (140.0, -220.0)):
        box.order(Aim(wanted_deg, 30.0))
        run(box, patience_s, [WALL])
        assert box.boom_deg(AZ) == pytest.approx(at_deg, abs=1.5)
    box.order(Jog(AZ, Direction.MINUS))
    run(box, 20.0, [WALL])
    assert -239.9 < box.boom_deg(AZ) < -225.0
    box.order(Aim(110.0, 30.0))
    run(box, 10.0, [WALL])
    assert "the wall" in str(box.axis(AZ).notices)


@pytest.mark.parametrize("profile", ["g5500", "isel"])
@pytest.mark.parametrize("seed", range(2))
def test_random_orders_beside_random_sectors_on_any_turn(profile: str, seed: int, new_box: Callable[..., Box]) -> None:
    world = random.Random(f"{profile} {seed}")
    west_deg, top_deg = world.randrange(20, 300), world.choice([30, 60, 181])
    other = {"name": "a tree", "azimuth_deg": [west_deg, west_deg + 25.0], "elevation_deg": [-1.0, float(top_deg)]}
    sectors = [NORTH, other]
    mount = {"forbidden": sectors, "park_azimuth_deg": float((west_deg + 40) % 340)}
    start_deg = (float((west_deg + 45) % 340), 60.0)
    box = made(new_box, profile, start_deg=start_deg, mount=mount)
    for _ in range(9):
        match world.randrange(5):
            case 0:
                box.order(Jog(AZ, world.choice([Direction.PLUS, Direction.MINUS]), world.uniform(1, 40)))
            case 1:
                box.order(Stop())
            case _:
                box.order(Aim(float(world.randrange(360)), float(world.randrange(0, 90))))
        run(box, world.uniform(1.0, 40.0), sectors)
        assert not box.status.faults


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ('type = "relay-pot"\n[azimuth]\nendless = true', "a pot ends, or has a gap, in each turn"),
        ('type = "relay-pot"\n[azimuth]\nendless = true\nsensor.kind = "qmc5883l"', "a compass learns its iron"),
        ('type = "relay-pulse"\n[azimuth]\nendless = true', "begins at an end stop, and an axis without ends has none"),
        ('type = "relay-timed"\n[azimuth]\nendless = true', "begins at an end stop, and an axis without ends has none"),
        ('type = "servo"\n[azimuth]\nendless = true', "has ends of its own"),
        ('type = "digipot"\n[azimuth]\nendless = true', "has ends of its own"),
        ('type = "controller"\n[azimuth]\nendless = true', "has ends of its own"),
        ('type = "stepper"\n[azimuth]\nendless = true', "has ends of its own"),
        ('type = "moteus"\n[azimuth]\nendless = true\nmax_deg = 450', "leave azimuth.min_deg and azimuth.max_deg out"),
        ('type = "moteus"\n[elevation]\nendless = true', "only an azimuth turns without ends"),
        ('type = "moteus"\n[azimuth]\nendless = true\n[limits]\nazimuth_low = 5', "has no limit switch"),
    ],
)
def test_what_cannot_turn_on_and_on_is_refused(text: str, told: str) -> None:
    with pytest.raises(ConfigError, match=told):
        parse(f'[rotor]\nhardware = "sim"\n{text}\n', "a file")


def test_programs_and_people_see_one_turn_without_ends(new_box: Callable[..., Box]) -> None:
    box = made(new_box, "isel", start_deg=(359.9, 0.0))
    angles_deg = rotctld_caps.limits(box.status)
    assert (angles_deg["min_az"], angles_deg["max_az"]) == (0.0, 360.0)
    axis = box.axis(AZ)
    assert (axis.min_deg, axis.max_deg) == (0.0, 360.0)
    assert not axis.at_end(Direction.PLUS)
    assert not replace(axis, angle_deg=0.0).at_end(Direction.MINUS)
    assert box.client().order(Jog(AZ, Direction.PLUS, 2.0)) is None
    box.run(5.0)
    assert box.boom_deg(AZ) > 365
    assert box.status.azimuth.angle_deg == pytest.approx(box.boom_deg(AZ) - 360.0, abs=0.1)


def test_a_plan_knows_no_north_and_both_ways_round() -> None:
    config = configured("isel", azimuth=TABLES["isel"], mount={"park_azimuth_deg": None, "forbidden": [WALL]})
    mount, rows = build_mount(config), read_pass(SHIPPED / "north-1-iss.csv").rows
    for stands_deg in (5.0, 355.0):
        antenna = Antenna(mount, *planned_motors(config), (stands_deg, 30.0))
        plan = plan_flight("north-1-iss", KnownPath(rows), antenna, -60.0)
        assert abs(plan.order.azimuth.angles_deg[0] - stands_deg) < 180
        assert plan.route.lost_s == 0
        assert len(plan.route.legs) == 1
        travel = Travel(antenna)
        assert travel.seconds((350.0, 30.0), (10.0, 30.0)) == pytest.approx(20 / 30)
        assert travel.seconds((780.0, 30.0), (-560.0, 30.0)) == pytest.approx(260 / 30)
        assert travel.on_this_side((200.0, 30.0))
