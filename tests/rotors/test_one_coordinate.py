"""One coordinate alone, over a link, on rotors that go over the top: the boom points where both together say.

Judged by where the simulated boom really points. Any order of single and double coordinates, on the way and at rest.
"""

from __future__ import annotations

from collections.abc import Callable

import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from rotator.control.sky.angles import great_circle_deg
from rotator.control.sky.turns import LONGEST_WAIT_S
from rotator.protocols.easycomm import Level
from rotator.protocols.easycomm_session import EasycommSession
from rotator.protocols.gs232 import Dialect
from rotator.protocols.gs232_session import Gs232Session
from rotator.protocols.pstrotator import PstRotatorSession
from tests.rotors.rig import AZ, EL, KINDS, Box, Kind

NewBox = Callable[..., Box]
SERVOS = next(kind for kind in KINDS if kind.profile == "servos")
Words = Callable[[Box, float | None, float | None], None]


def boom(box: Box) -> tuple[float, float]:
    """The direction on the sky in which the boom really points."""
    azimuth_deg, elevation_deg = box.boom_deg(AZ), box.boom_deg(EL)
    return (azimuth_deg + 180.0, 180.0 - elevation_deg) if elevation_deg > 90.0 else (azimuth_deg, elevation_deg)


def points_at(box: Box, azimuth_deg: float, elevation_deg: float) -> bool:
    return great_circle_deg(*boom(box), azimuth_deg, elevation_deg) <= box.kind.within_deg + 0.6


def easycomm(box: Box, azimuth_deg: float | None, elevation_deg: float | None) -> None:
    words = [f"{name}{value:.1f}" for name, value in (("AZ", azimuth_deg), ("EL", elevation_deg)) if value is not None]
    EasycommSession(box.client(), Level.II).receive(" ".join(words).encode() + b"\n")


def gs232(box: Box, azimuth_deg: float | None, elevation_deg: float | None) -> None:
    """GS-232 has no word for an elevation alone: it repeats the azimuth."""
    if elevation_deg is None:
        words = f"M{azimuth_deg:03.0f}\r"
    else:
        kept_deg = box.status.wanted_azimuth_deg if azimuth_deg is None else azimuth_deg
        words = f"W{kept_deg or 0.0:03.0f} {elevation_deg:03.0f}\r"
    Gs232Session(box.client(), Dialect.B).receive(words.encode())


def pstrotator(box: Box, azimuth_deg: float | None, elevation_deg: float | None) -> None:
    tags = [
        f"<{name}>{value:.1f}</{name}>"
        for name, value in (("AZIMUTH", azimuth_deg), ("ELEVATION", elevation_deg))
        if value is not None
    ]
    PstRotatorSession(box.client()).receive(f"<PST>{''.join(tags)}</PST>".encode())


def test_an_elevation_alone_keeps_the_azimuth_of_an_antenna_over_the_top(new_box: NewBox) -> None:
    box = new_box(SERVOS)
    box.run(1.0)
    easycomm(box, 200.0, 30.0)
    box.until_it_stands()
    assert box.boom_deg(EL) == pytest.approx(150.0, abs=1.0), "it went over the top"
    easycomm(box, None, 20.0)
    box.until_it_stands()
    assert points_at(box, 200.0, 20.0)
    assert (box.status.wanted_azimuth_deg, box.status.wanted_elevation_deg) == (200.0, 20.0)


directions = st.tuples(st.integers(0, 359).map(float), st.integers(5, 85).map(float))
steps = st.lists(
    st.tuples(st.sampled_from(["both", "azimuth", "elevation"]), directions, st.sampled_from([0.05, 0.5, 2.0, 12.0])),
    min_size=1,
    max_size=6,
)


@pytest.mark.parametrize("words", [easycomm, gs232, pstrotator])
@settings(max_examples=12, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(first=directions, steps=steps)
def test_any_row_of_coordinates_ends_where_the_latest_of_each_say(
    new_box: NewBox, words: Words, first: tuple[float, float], steps: list[tuple[str, tuple[float, float], float]]
) -> None:
    box = new_box(SERVOS)
    box.run(0.5)
    words(box, *first)
    azimuth_deg, elevation_deg = first
    box.run(0.1)
    for which, (new_azimuth_deg, new_elevation_deg), then_s in steps:
        azimuth_deg = azimuth_deg if which == "elevation" else new_azimuth_deg
        elevation_deg = elevation_deg if which == "azimuth" else new_elevation_deg
        words(
            box,
            None if which == "elevation" else new_azimuth_deg,
            None if which == "azimuth" else new_elevation_deg,
        )
        box.run(then_s)
    # A target that wavers across the end of the range is followed right round only after a wait.
    box.run(LONGEST_WAIT_S)
    box.until_it_stands()
    assert points_at(box, azimuth_deg, elevation_deg), f"{boom(box)}, not {(azimuth_deg, elevation_deg)}"


@settings(max_examples=15, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(flip=st.booleans(), first=directions, steps=steps)
# On its way down, where the azimuth's tolerance was still that of high up.
@example(
    flip=False,
    first=(0.0, 5.0),
    steps=[("both", (61.0, 75.0), 12.0), ("both", (58.0, 5.0), 0.05), ("azimuth", (54.0, 5.0), 0.05)],
)
def test_a_rotor_of_450_degrees_obeys_single_coordinates_too(
    new_box: NewBox, flip: bool, first: tuple[float, float], steps: list[tuple[str, tuple[float, float], float]]
) -> None:
    box = new_box(Kind("g5500", KINDS[0].source, (90.0, 30.0), 6.0, 1.3), mount={"flip": "over-top" if flip else "off"})
    box.run(0.5)
    easycomm(box, *first)
    azimuth_deg, elevation_deg = first
    for which, (new_azimuth_deg, new_elevation_deg), then_s in steps:
        azimuth_deg = azimuth_deg if which == "elevation" else new_azimuth_deg
        elevation_deg = elevation_deg if which == "azimuth" else new_elevation_deg
        easycomm(
            box, None if which == "elevation" else new_azimuth_deg, None if which == "azimuth" else new_elevation_deg
        )
        box.run(then_s)
    box.run(LONGEST_WAIT_S)
    box.until_it_stands()
    assert points_at(box, azimuth_deg, elevation_deg), f"{boom(box)}, not {(azimuth_deg, elevation_deg)}"
