"""What the motors have taught survives; a damaged, foreign or stale file is as good as none."""

from __future__ import annotations

import json
import logging
from pathlib import Path

import pytest

from hw.ports import Axis
from rotator.exchange.motor import Motor
from rotator.store.learnt import KeptMotors, Motors
from rotator.store.state import State

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
BEGUN = {AZ: {"hardware": "pi", "speed_dps": 6.0, "coast_s": 0.17}, EL: {"hardware": "pi", "speed_dps": 2.7}}


def motors(speed_dps: float = 5.6, coast_deg: float = 1.1) -> Motors:
    return Motor(speed_dps, coast_deg), Motor(speed_dps + 0.1, coast_deg)


BOTH = {AZ: motors(), EL: motors(2.5, 0.4)}


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "run" / "state.json"


def kept(path: Path) -> KeptMotors:
    """A file with BOTH in it."""
    file = KeptMotors(State(path), BEGUN)
    file.save(BOTH, ending=True)
    file.note(BOTH)
    return file


def test_there_and_back(path: Path) -> None:
    kept(path)
    assert KeptMotors(State(path), BEGUN).load() == BOTH
    assert [each.name for each in path.parent.iterdir()] == ["state.json"]


def test_no_file_says_nothing(path: Path, caplog: pytest.LogCaptureFixture) -> None:
    assert KeptMotors(State(path), BEGUN).load() == {}
    assert not caplog.records


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("speed_dps", 0),
        ("speed_dps", -6.0),
        ("speed_dps", 1e9),
        ("speed_dps", 24.1),
        ("speed_dps", 0.5),
        ("speed_dps", 10**400),
        ("speed_dps", "6"),
        ("speed_dps", True),
        ("coast_deg", -1),
        ("coast_deg", 29.0),
    ],
)
def test_figures_of_no_motor_are_ignored(path: Path, key: str, value: object, caplog: pytest.LogCaptureFixture) -> None:
    kept(path)
    whole = json.loads(path.read_text())
    whole["learnt"]["axes"]["azimuth"]["minus"][key] = value
    path.write_text(json.dumps(whole))
    assert KeptMotors(State(path), BEGUN).load() == {EL: BOTH[EL]}
    assert "azimuth: ignored, its motor is learnt anew" in caplog.text
    assert len(caplog.text) < 500, "a number of 400 digits is said in a few"


def test_a_motor_is_at_most_four_times_as_fast_as_configured(path: Path) -> None:
    fast = BOTH | {AZ: motors(23.8)}
    KeptMotors(State(path), BEGUN).save(fast, ending=True)
    assert KeptMotors(State(path), BEGUN).load() == fast


def test_not_a_number_is_no_motor(path: Path) -> None:
    kept(path)
    path.write_text(path.read_text().replace("5.6,", "NaN,"))
    assert KeptMotors(State(path), BEGUN).load() == {EL: BOTH[EL]}


def test_another_description_of_the_motor_makes_it_another_motor(path: Path, caplog: pytest.LogCaptureFixture) -> None:
    caplog.set_level(logging.INFO)
    kept(path)
    assert KeptMotors(State(path), BEGUN | {AZ: {"hardware": "sim"}}).load() == {EL: BOTH[EL]}
    assert "azimuth has been set up anew" in caplog.text


@pytest.mark.parametrize(
    ("azimuth", "worth_it"),
    [
        (motors(), False),
        (motors(5.6 * 1.04), False),
        (motors(5.6 * 1.06), True),
        (motors(5.6 * 0.94), True),
        (motors(5.6, 1.1 * 1.04), False),
        (motors(5.6, 1.1 * 1.06), True),
    ],
)
def test_only_large_changes_are_written_before_the_end(path: Path, azimuth: Motors, worth_it: bool) -> None:
    file = kept(path)
    path.unlink()
    file.save(BOTH | {AZ: azimuth}, ending=False)
    assert path.exists() is worth_it


def test_a_coast_of_next_to_nothing_is_not_written_for_every_thousandth(path: Path) -> None:
    file = KeptMotors(State(path), BEGUN)
    file.note({AZ: motors(5.6, 0.0)})
    file.save({AZ: motors(5.6, 0.009)}, ending=False)
    assert not path.exists()


def test_at_the_end_any_news_is_written_and_no_news_is_not(path: Path) -> None:
    file = kept(path)
    path.unlink()
    file.save(BOTH, ending=True)
    assert not path.exists()
    file.save(BOTH | {AZ: motors(5.61)}, ending=True)
    assert path.exists()
