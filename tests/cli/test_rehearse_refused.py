"""`rotator rehearse`: what it refuses and how it says so; the passes and faults that it offers."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.cli.rehearsed import Rotator, through_the_south


@pytest.fixture
def flown(tmp_path: Path) -> Path:
    return through_the_south(tmp_path)


@pytest.mark.parametrize(
    ("words", "said", "code"),
    [
        (("--via", "telepathy"), "'telepathy' is not one of", 2),
        (("--fault", "gremlins"), "no fault called gremlins", 2),
        (("--arduino", "--fault", "adc-gone"), "--fault is for the box", 2),
        (("--config", "nowhere.toml"), "nowhere.toml: 1 mistake", 2),
        (("--fault", "azimuth-pot-open@"), "after @ stands the moment in seconds, such as azimuth-pot-open@20", 2),
        (("--fault", "azimuth-pot-open@-3"), "azimuth-pot-open@-3: after @ stands the moment in seconds", 2),
        (("--fault", "azimuth-pot-open@nan"), "azimuth-pot-open@nan: after @ stands the moment in seconds", 2),
        (("--fault", "azimuth-pot-open@60"), "azimuth-pot-open@60: south ends after 60 s", 2),
        (("--trace", "nowhere/trace.csv"), "nowhere/trace.csv: cannot be written: No such file or directory", 1),
    ],
)
def test_what_cannot_be_done(
    rotator_here: Rotator, flown: Path, *, words: tuple[str, ...], said: str, code: int
) -> None:
    done = rotator_here("rehearse", flown, *words)
    assert done.returncode == code
    assert said in done.stderr


def test_a_shipped_pass_is_found_by_its_name(rotator_here: Rotator) -> None:
    """Here by what is said of a fault after its end: nothing has to be flown for that."""
    done = rotator_here("rehearse", "north-1-iss", "--fault", "azimuth-pot-open@900")
    assert "azimuth-pot-open@900: north-1-iss ends after 651 s" in done.stderr


def test_the_faults_there_are(rotator_here: Rotator, flown: Path) -> None:
    done = rotator_here("rehearse", flown, "--fault", "list")
    assert done.returncode == 0
    assert "azimuth-pot-open" in done.stdout.splitlines()
