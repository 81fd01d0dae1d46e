"""The way round sectors: random ones, with motors of which none knows the other's pace."""

from __future__ import annotations

import math
import random
from collections import deque

import pytest

from rotator.control.sky.detour import Detours, box_about
from rotator.control.sky.mount import Mount, Range, Sector
from rotator.control.sky.route import Speeds
from rotator.control.sky.sectors import Box, Place, box_at
from tests.search import examples

SPEEDS = Speeds(6.0, 2.7)
ROOM_DEG, ABOUT_DEG = (3.0, 1.5), (0.5, 0.4)
CHIMNEY = Sector("the chimney", Range(100, 130), Range(0, 35), 2.0)
WORLDS = examples(10_000)


def detours(*sectors: Sector) -> Detours:
    return Detours(Mount(Range(0, 450), Range(0, 180), sectors=sectors), ROOM_DEG, ABOUT_DEG, SPEEDS)


def test_straight_on_where_nothing_is_in_the_way() -> None:
    chimney = detours(CHIMNEY)
    assert chimney.free(box_at((10, 10)), (90, 170))
    assert chimney.seconds(box_at((10, 10)), (70, 10)) == pytest.approx(10)


def test_round_the_chimney_goes_over_it() -> None:
    way = detours(CHIMNEY).round(box_at((60, 10)), (200, 10))
    assert way.sector == ""
    assert way.places[-1] == (200, 10)
    assert min(elevation_deg for _, elevation_deg in way.places[:-1]) > 38.5


@pytest.mark.parametrize(
    ("sector", "start", "target", "axis", "beside_deg"),
    [
        (Sector("roof", Range(100, 130), Range(0, 60), 2.0), (60, 20), (200, 20), 1, 64.5),
        (Sector("cable", Range(100, 130), Range(20, 180), 2.0), (60, 40), (200, 40), 1, 15.5),
        (Sector("west", Range(0, 200), Range(50, 60), 2.0), (150, 20), (150, 100), 0, 206.1),
        (Sector("east", Range(200, 450), Range(50, 60), 2.0), (250, 20), (250, 100), 0, 193.9),
    ],
    ids=lambda each: each.name if isinstance(each, Sector) else None,
)
def test_it_passes_close_by_the_free_side_of_a_sector(
    sector: Sector, start: Place, target: Place, axis: int, beside_deg: float
) -> None:
    """Margin, room for the motor, what the reading is in doubt by, and a little more: 4.5° up and down, 6.1° across."""
    way = detours(sector).round(box_at(start), target)
    turned_deg = [place[axis] for place in way.places]
    assert turned_deg[-1] == target[axis]
    assert max(turned_deg, key=lambda each_deg: abs(each_deg - target[axis])) == pytest.approx(beside_deg)


def test_a_target_inside_is_met_at_the_nearest_free_place() -> None:
    chimney = detours(CHIMNEY)
    (place,) = chimney.round(box_at((60, 10)), (105, 10)).places
    assert place == pytest.approx((93.9, 10))
    assert chimney.round(box_at((60, 10)), (105, 10)).sector == "the chimney"
    assert chimney.round(box_at((60, 10)), (115, 33)).places[-1] == pytest.approx((115, 39.5))


def test_beside_a_target_inside_the_antenna_does_not_change_sides_for_a_degree() -> None:
    chimney, here = detours(CHIMNEY), box_at((93.9, 10))
    ends = [chimney.round(here, (azimuth_deg, 10), (93.9, 10)).places[-1][0] for azimuth_deg in (114, 116, 117)]
    assert ends == pytest.approx([93.9] * 3)
    assert chimney.round(here, (123, 10), (93.9, 10)).places[-1][0] == pytest.approx(136.1)


def test_behind_a_tower_that_leaves_no_way_it_waits_on_this_side() -> None:
    tower = detours(Sector("the tower", Range(200, 210), Range(0, 180), 2.0))
    way = tower.round(box_at((100, 10)), (300, 50))
    assert way.sector == "the tower"
    assert way.places[-1] == pytest.approx((193.9, 50))
    assert math.isinf(tower.seconds(box_at((100, 10)), (300, 50)))


def test_from_inside_it_leads_out_first() -> None:
    way = detours(CHIMNEY).round(box_at((105, 10)), (300, 10))
    assert (way.leaves, way.sector) == (True, "the chimney")
    assert way.places == (pytest.approx((93.9, 10)),)


def test_nearer_to_a_sector_than_it_should_be_it_still_gets_away() -> None:
    chimney, here = detours(CHIMNEY), box_at((96.5, 10))
    assert chimney.free(here, (50, 100))
    assert chimney.free(here, (96.5, 60))
    assert not chimney.free(here, (97.5, 10))


def drawn(seed: int) -> tuple[Detours, list[Sector], random.Random, Mount]:
    draw = random.Random(seed)
    limits = Range(0, draw.choice([360, 450])), Range(0, draw.choice([90, 180]))
    sectors = []
    for number in range(draw.randint(1, 4)):
        west, low = draw.uniform(-20, 440), draw.choice([0.0, draw.uniform(-5, 170)])
        span = Range(west, west + draw.uniform(1, 120)), Range(low, low + draw.uniform(1, 90))
        sectors.append(Sector(f"{number}", *span, margin_deg=draw.choice([0.0, 2.0])))
    mount = Mount(*limits, sectors=tuple(sectors))
    return Detours(mount, ROOM_DEG, ABOUT_DEG, SPEEDS), sectors, draw, mount


def room(sector: Sector) -> tuple[Range, Range]:
    return sector.azimuth.widened(sector.margin_deg + 3.0), sector.elevation.widened(sector.margin_deg + 1.5)


def room_from(sector: Sector, here: Box) -> tuple[Range, Range]:
    """What is left of the room on the sides where the antenna stands nearer already: it comes no nearer."""
    left = []
    cores = sector.azimuth, sector.elevation
    for span, core, mine in zip(room(sector), cores, (here.azimuth, here.elevation), strict=True):
        kept = core.widened(sector.margin_deg)
        low_deg = max(span.min_deg, mine.max_deg) if mine.max_deg <= kept.min_deg else span.min_deg
        high_deg = min(span.max_deg, mine.min_deg) if mine.min_deg >= kept.max_deg else span.max_deg
        left.append(Range(low_deg, high_deg))
    return left[0], left[1]


def inside(spans: tuple[Range, Range], place: Place) -> bool:
    return all(span.min_deg + 1e-9 < at < span.max_deg - 1e-9 for span, at in zip(spans, place, strict=True))


def walked(draw: random.Random, a: Place, b: Place) -> list[Place]:
    """From place to place with motors at any two paces, each axis one way."""
    paces = draw.uniform(0.05, 1), draw.uniform(0.05, 1)
    return [
        (a[0] + (b[0] - a[0]) * min(1, share * paces[0]), a[1] + (b[1] - a[1]) * min(1, share * paces[1]))
        for share in (0.0, 0.5, 1.0, 2.0, 4.0, 8.0, 20.0)
    ]


def connected(mount: Mount, blocked: list[tuple[Range, Range]], a: Place, b: Place) -> bool:
    """By flooding a grid of whole degrees: an oracle that knows no corners. Wide gaps only."""
    seen, waiting = {(round(a[0]), round(a[1]))}, deque([(round(a[0]), round(a[1]))])
    goal = round(b[0]), round(b[1])
    while waiting:
        at = waiting.popleft()
        if at == goal:
            return True
        for step in ((4, 0), (-4, 0), (0, 4), (0, -4), (1, 0), (-1, 0), (0, 1), (0, -1)):
            then = at[0] + step[0], at[1] + step[1]
            ok = then not in seen and mount.azimuth.holds(then[0]) and mount.elevation.holds(then[1])
            if ok and not any(inside(spans, then) for spans in blocked):
                seen.add(then)
                waiting.append(then)
    return False


@pytest.mark.search
def test_no_way_enters_a_sector_at_any_speeds_of_the_motors() -> None:
    ways = reached = 0
    for seed in range(WORLDS):
        finder, sectors, draw, mount = drawn(seed)
        rooms = [room(sector) for sector in sectors]
        here, target = (
            (draw.uniform(0, mount.azimuth.max_deg), draw.uniform(0, mount.elevation.max_deg)) for _ in range(2)
        )
        if any(inside(spans, here) for spans in rooms):
            continue
        way = finder.round(box_at(here), target)
        ways += 1
        at = here
        for place in way.places:
            stands = box_at(here) if at == here else box_about(at, ABOUT_DEG)
            seen = [room_from(sector, stands) for sector in sectors]
            for between in walked(draw, at, place):
                assert not any(inside(spans, between) for spans in seen), f"world {seed}: {between} on {way}"
            assert at == here or finder.free(box_about(at, ABOUT_DEG), place), f"world {seed}: {at} on {way}"
            at = place
        free = not any(inside(spans, target) for spans in rooms)
        assert free or at != target
        assert (at == target) == (way.sector == "")
        reached += at == target
    assert ways > WORLDS / 3
    assert reached > ways / 3


@pytest.mark.search
@pytest.mark.parametrize("seed", range(0, 100, 100 // examples(50)))
def test_every_free_place_that_can_be_reached_is(seed: int) -> None:
    finder, sectors, draw, mount = drawn(seed)
    blocked = [room(sector) for sector in sectors]
    # The oracle keeps two degrees more away, for its steps are whole degrees and the ways have lines of their own.
    wide = [(azimuth.widened(2.0), elevation.widened(2.0)) for azimuth, elevation in blocked]
    here, target = (
        (float(draw.randint(0, int(mount.azimuth.max_deg))), float(draw.randint(0, int(mount.elevation.max_deg))))
        for _ in range(2)
    )
    if any(inside(spans, place) for spans in wide for place in (here, target)):
        return
    if connected(mount, wide, here, target):
        assert finder.round(box_at(here), target).places[-1] == target
