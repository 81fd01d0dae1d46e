"""The plan against every other plan: few short passes, and all chains of their parts tried one by one."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from rotator.control.sky.mount import Mount
from rotator.tracking.planned import Followed
from rotator.tracking.schedule import schedule
from tests.search import examples
from tests.tracking.arcs import EPOCH_S, FULL, OVER, Arc, antenna, travel_s, worth

GRID_S = 40.0
SPARE_S = 15.0
PROMISED = 0.95
Place = tuple[float, float]

ARCS = st.builds(
    lambda name, after_s, seconds, from_deg, turn_deg, top_deg: Arc(
        name, EPOCH_S + after_s, seconds, from_deg, turn_deg, top_deg
    ),
    st.sampled_from("abcdefgh"),
    st.floats(30, 700),
    st.floats(150, 300),
    st.floats(0, 359),
    st.floats(-90, 90),
    st.floats(5, 85),
)
FOLLOWED = st.lists(
    st.builds(Followed, ARCS, st.sampled_from([1.0, 2.0, 5.0])),
    min_size=2,
    max_size=4,
    unique_by=lambda each: each.target.name,
)


@dataclass(frozen=True, slots=True)
class Piece:
    """A part of an arc on one turn."""

    begin_s: float
    end_s: float
    begin: Place
    end: Place
    worth: float


def pieces(followed: Followed, mount: Mount) -> list[Piece]:
    """Every part that is worth half of all of it, on each turn, on a grid."""
    arc = followed.target
    assert isinstance(arc, Arc)
    count = math.ceil(arc.seconds / GRID_S)
    found = []
    for over in (False, True) if mount.flip else (False,):
        for turn_deg in (-360.0, 0.0, 360.0):
            for first in range(count):
                for last in range(first + 1, count + 1):
                    ends = []
                    for share in (first / count, last / count):
                        azimuth_deg = arc.from_deg + share * arc.turn_deg + 180.0 * over + turn_deg
                        height_deg = arc.sight(arc.aos_s + share * arc.seconds).elevation_deg
                        ends.append((azimuth_deg, 180.0 - height_deg if over else height_deg))
                    begin_s, end_s = (arc.aos_s + share * arc.seconds for share in (first / count, last / count))
                    gained = worth(followed, begin_s, end_s, ends[0][0], mount)
                    begin, end = ((mount.azimuth.nearest(place[0]), place[1]) for place in ends)
                    found.append(Piece(begin_s, end_s, begin, end, gained))
    most = max(piece.worth for piece in found)
    return [piece for piece in found if piece.worth >= most / 2]


def best_of_all(choices: Sequence[list[Piece]], free_s: float, place: Place, needed: float = 0.0) -> float:
    """Of every chain that begins at this moment and place; 0 where none is worth what is needed."""
    best = 0.0
    for index, parts in enumerate(choices):
        others = [*choices[:index], *choices[index + 1 :]]
        hoped = sum(max(piece.worth for piece in each) for each in others)
        for piece in parts:
            if piece.worth + hoped <= max(best, needed):
                continue
            if free_s + travel_s(place, piece.begin) + SPARE_S <= piece.begin_s:
                rest = best_of_all(others, piece.end_s, piece.end, max(best, needed) - piece.worth)
                best = max(best, piece.worth + rest)
    return best


def worth_of_plan(followed: Sequence[Followed], mount: Mount, stands_deg: float) -> float:
    total = 0.0
    for each in schedule(followed, antenna(mount, (stands_deg, 0.0)), EPOCH_S, EPOCH_S + 1200):
        if each.flight is None:
            continue
        flight, whose = each.flight, next(one for one in followed if one.target.name == each.name)
        points_deg = whose.target.sight(flight.begin_s).azimuth_deg + 180.0 * flight.over_the_top
        turn = round((flight.wait_deg[0] - points_deg) / 360.0)
        total += worth(whose, flight.begin_s, flight.end_s, points_deg + 360.0 * turn, mount)
    return total


def most_worth(followed: Sequence[Followed], mount: Mount, stands_deg: float) -> float:
    """Of all plans."""
    return best_of_all([pieces(each, mount) for each in followed], EPOCH_S, (stands_deg, 0.0))


@settings(max_examples=examples(25), phases=[Phase.explicit, Phase.reuse, Phase.generate])
@given(followed=FOLLOWED, mount=st.sampled_from([FULL, OVER]), stands_deg=st.floats(0, 360))
def test_no_other_plan_is_worth_much_more(followed: list[Followed], mount: Mount, stands_deg: float) -> None:
    assert worth_of_plan(followed, mount, stands_deg) >= PROMISED * most_worth(followed, mount, stands_deg)
