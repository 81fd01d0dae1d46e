"""A pass that lasts for hours is planned in pieces, each in time: the Moon's, and a satellite's on a high orbit."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rotator.assembly.tracking import build_antenna
from rotator.config.load import parse
from rotator.orbits.catalogue import Catalogue
from rotator.orbits.passes import passes
from rotator.tracking.next_flight import LONGEST_S, Now, Wanted, WantedOften, next_followed
from tests.tracking.tracked_box import BERLIN, ELEMENTS, FEBRUARY_S

SATELLITE = Catalogue((str(ELEMENTS),)).find("rs-44")
HIGH = replace(SATELLITE, mean_motion_rev_per_day=2.0, eccentricity=0.7, inclination_deg=63.0)
WANTED = {
    "moon": Wanted("moon", BERLIN, None),
    "high": Wanted("high", BERLIN, HIGH),
}


@pytest.mark.search
@pytest.mark.parametrize("name", ["moon", "high"])
def test_a_followed_pass_of_hours_is_flown_in_pieces_without_a_gap(name: str) -> None:
    wanted = WANTED[name]
    target = wanted.target()
    found = next(each for each in passes(target, FEBRUARY_S, FEBRUARY_S + 2 * 86_400.0, 10.0) if each.aos_s)
    assert found.aos_s is not None
    assert found.los_s is not None
    assert found.los_s - found.aos_s > LONGEST_S
    antenna = build_antenna(parse("", "box"))
    utc_s = found.aos_s - 150.0
    upcoming = next_followed((WantedOften(wanted, 1.0, 0.0),), antenna, Now(utc_s, 0.0))
    assert upcoming is not None
    utc_s = upcoming.set_off_utc_s
    pieces = 0
    ended_s = found.aos_s
    while ended_s < found.los_s - 30.0 and pieces < 4:
        upcoming = next_followed((WantedOften(wanted, 1.0, 0.0),), antenna, Now(utc_s, 0.0))
        assert upcoming is not None
        assert upcoming.flight is not None, "it sets off at once"
        piece = upcoming.flight
        assert piece.end_utc_s - piece.begin_utc_s <= LONGEST_S
        assert target.sight(piece.begin_utc_s).apart_deg(target.sight(ended_s)) < 1.0
        order = piece.order
        antenna = replace(antenna, stands_deg=(order.azimuth.angles_deg[-1], order.elevation.angles_deg[-1]))
        utc_s = ended_s = piece.end_utc_s
        pieces += 1
    assert pieces >= 2
