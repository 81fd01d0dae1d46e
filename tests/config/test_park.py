"""Where the antenna may rest: what the axes hold, on their own scales, and nowhere else."""

from __future__ import annotations

import pytest

from rotator.config.load import ConfigError, parse

BELOW = "[azimuth]\nmin_deg = -180\nmax_deg = 180\n[elevation]\nmin_deg = -5\nmax_deg = 90\n"
TWICE = "[azimuth]\nmin_deg = 0\nmax_deg = 540\n"
SOUTH = "[azimuth]\nmin_deg = 90\nmax_deg = 270\n[elevation]\nmin_deg = 10\n"


@pytest.mark.parametrize(
    ("text", "park_deg"),
    [
        (BELOW + "[mount]\npark_azimuth_deg = -90\npark_elevation_deg = -5\nhorizon = [[0, -1], [180, 3]]", (-90, -5)),
        (TWICE + "[mount]\npark_azimuth_deg = 500\n", (500, 0)),
        (TWICE, (0, 0)),
        (SOUTH, (90, 10)),
        ("[azimuth]\nmin_deg = 180\nmax_deg = 540\n", (360, 0)),
    ],
)
def test_the_park_position_is_any_place_of_the_range(text: str, park_deg: tuple[float, float]) -> None:
    assert parse(text, "rotator.toml").park_deg == park_deg


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("[mount]\npark_azimuth_deg = 451\n", "park_azimuth_deg = 451 is outside azimuth's range, 0 to 450"),
        ("[mount]\npark_elevation_deg = -1\n", "park_elevation_deg = -1 is outside elevation's range, 0 to 180"),
        (SOUTH + "[mount]\npark_azimuth_deg = 0\n", "park_azimuth_deg = 0 is outside azimuth's range, 90 to 270"),
        (
            BELOW + "[mount]\npark_azimuth_deg = -90\n"
            '[[mount.forbidden]]\nname = "mast"\nazimuth_deg = [-100, -80]\nelevation_deg = [-5, 20]\n',
            "holds the park position: the antenna could not stand there",
        ),
        ("[mount]\nhorizon = [[0, -91]]\n", "mount.horizon: elevations must be from -90 to 90"),
    ],
)
def test_a_place_that_cannot_be_reached_is_one_mistake(text: str, told: str) -> None:
    with pytest.raises(ConfigError) as refused:
        parse(text, "rotator.toml")
    (mistake,) = refused.value.mistakes
    assert told in mistake.text
