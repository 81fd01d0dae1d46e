"""What a motor was tried for in vain survives: on the card, and in memory where the card refuses or would wear."""

from __future__ import annotations

import logging
from dataclasses import replace
from pathlib import Path

import pytest

from hw.ports import Axis
from rotator.exchange.faults import FaultKind
from rotator.exchange.motor import NO_TRIES, Tries
from rotator.store.state import State
from rotator.store.tries import KeptTries
from tests.refusing import refuse

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
NOTHING = {AZ: NO_TRIES, EL: NO_TRIES}
TRIED = {AZ: Tries(2, FaultKind.END_STOP, (445.9, None), (445.9, None)), EL: Tries(pressed=True)}


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "run" / "state.json"


@pytest.fixture
def memory(tmp_path: Path) -> Path:
    return tmp_path / "memory"


def test_without_a_file_nothing_was_tried_and_nothing_is_written(path: Path) -> None:
    file = KeptTries(State(path))
    assert file.load() == NOTHING
    file.save(NOTHING)
    assert not path.exists()


def test_the_next_run_goes_on_from_what_was_tried(path: Path) -> None:
    KeptTries(State(path)).save(TRIED)
    assert KeptTries(State(path)).load() == TRIED


def test_what_a_person_has_released_is_tried_anew(path: Path) -> None:
    file = KeptTries(State(path))
    file.save(TRIED)
    file.save(NOTHING)
    assert KeptTries(State(path)).load() == NOTHING


def test_who_has_not_looked_into_the_file_clears_it(path: Path) -> None:
    KeptTries(State(path)).save(TRIED)
    KeptTries(State(path)).save(NOTHING)
    assert KeptTries(State(path)).load() == NOTHING


def test_a_run_that_was_not_seen_to_move_the_axis_counts_and_wears_no_card(path: Path, memory: Path) -> None:
    file = KeptTries(State(path, memory))
    file.load()
    file.save(TRIED)
    on_card = path.read_bytes()
    file.save(TRIED | {AZ: replace(TRIED[AZ], driven=True)})
    assert path.read_bytes() == on_card
    assert KeptTries(State(path, memory)).load()[AZ] == replace(TRIED[AZ], faults=3)
    file.save(TRIED)
    assert KeptTries(State(path, memory)).load() == TRIED


@pytest.mark.parametrize("ran", [False, True])
def test_memory_keeps_what_the_card_refuses(path: Path, memory: Path, *, ran: bool) -> None:
    KeptTries(State(path, memory)).save(NOTHING)
    blocked = refuse(path)
    file = KeptTries(State(path, memory))
    assert file.load() == NOTHING
    assert not file.save(TRIED | {AZ: replace(TRIED[AZ], driven=ran)}), "who calls it is to try again"
    assert file.state.trouble
    assert KeptTries(State(path, memory)).load() == TRIED | {AZ: replace(TRIED[AZ], faults=2 + ran)}
    blocked.rmdir()
    later = KeptTries(State(path, memory))
    later.save(later.load())
    assert not later.state.trouble
    expected = TRIED | {AZ: replace(TRIED[AZ], faults=2 + ran)}
    assert KeptTries(State(path)).load() == KeptTries(State(path, memory)).load() == later.load() == expected


@pytest.mark.parametrize("deg", [-1000.0, -12.5, 1000.0])
def test_an_angle_on_either_side_of_zero_is_kept(path: Path, deg: float) -> None:
    stood = NOTHING | {AZ: Tries(1, FaultKind.STANDS_STILL, (None, deg), (deg, None))}
    KeptTries(State(path)).save(stood)
    assert KeptTries(State(path)).load() == stood


def test_ten_tries_are_the_most(path: Path) -> None:
    most = NOTHING | {AZ: Tries(10, FaultKind.STANDS_STILL)}
    KeptTries(State(path)).save(most)
    assert KeptTries(State(path)).load() == most


@pytest.mark.parametrize("in_memory", [False, True])
@pytest.mark.parametrize("old", [{"limits_deg": [0.0, 450.0]}, {}])
def test_an_axis_that_was_set_up_anew_forgets_its_places_and_keeps_its_count(
    path: Path, memory: Path, old: dict[str, object], in_memory: bool, caplog: pytest.LogCaptureFixture
) -> None:
    now: dict[str, object] = {"limits_deg": [0.0, 180.0]}
    kept = TRIED | {EL: Tries(1, FaultKind.STANDS_STILL, (None, 3.0), (None, 3.0))}
    blocked = refuse(path) if in_memory else None
    KeptTries(State(path, memory), {AZ: old, EL: now}).save(kept)
    if blocked:
        blocked.rmdir()
    caplog.set_level(logging.INFO)
    file = KeptTries(State(path, memory), {AZ: now, EL: now})
    expected = kept | {AZ: replace(TRIED[AZ], stood_deg=(None, None), stops_deg=(None, None))}
    assert file.load() == expected
    assert [record.getMessage() for record in caplog.records if record.levelno == logging.INFO] == [
        f"{path}: azimuth has been set up anew since; the stops that it met are forgotten"
    ]
    assert file.save(expected)
    back = KeptTries(State(path, memory), {AZ: old, EL: now})
    assert back.load() == expected, "a way back to the old settings brings no old place back"


def test_places_of_a_file_without_settings_are_not_believed(path: Path) -> None:
    KeptTries(State(path)).save(TRIED)
    path.write_text(path.read_text().replace('"settings": {},', ""))
    assert KeptTries(State(path)).load() == TRIED
    known = KeptTries(State(path), {AZ: {"offset_deg": 0.0}}).load()
    assert known == TRIED | {AZ: replace(TRIED[AZ], stood_deg=(None, None), stops_deg=(None, None))}
