"""What a motor was tried for in vain survives: on the card, and in memory where the card refuses or would wear."""

from __future__ import annotations

import logging
from dataclasses import replace
from pathlib import Path

import pytest

from hw.ports import Axis
from rotator.exchange.faults import FaultKind
from rotator.exchange.motor import NO_TRIES, Tries
from rotator.store.tries import TriesFile
from tests.refusing import refuse

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
NOTHING = {AZ: NO_TRIES, EL: NO_TRIES}
TRIED = {AZ: Tries(2, FaultKind.END_STOP, (445.9, None), (445.9, None)), EL: Tries(pressed=True)}


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "run" / "tries.json"


@pytest.fixture
def memory(tmp_path: Path) -> Path:
    return tmp_path / "memory"


def test_without_a_file_nothing_was_tried_and_nothing_is_written(path: Path) -> None:
    file = TriesFile(path)
    assert file.load() == NOTHING
    file.save(NOTHING)
    assert not path.exists()


def test_the_next_run_goes_on_from_what_was_tried(path: Path) -> None:
    TriesFile(path).save(TRIED)
    assert TriesFile(path).load() == TRIED


def test_what_a_person_has_released_is_tried_anew(path: Path) -> None:
    file = TriesFile(path)
    file.save(TRIED)
    file.save(NOTHING)
    assert TriesFile(path).load() == NOTHING


def test_who_has_not_looked_into_the_file_clears_it(path: Path) -> None:
    TriesFile(path).save(TRIED)
    TriesFile(path).save(NOTHING)
    assert TriesFile(path).load() == NOTHING


def test_a_run_that_was_not_seen_to_move_the_axis_counts_and_wears_no_card(path: Path, memory: Path) -> None:
    file = TriesFile(path, memory)
    file.load()
    file.save(TRIED)
    on_card = path.read_bytes()
    file.save(TRIED | {AZ: replace(TRIED[AZ], driven=True)})
    assert path.read_bytes() == on_card
    assert TriesFile(path, memory).load()[AZ] == replace(TRIED[AZ], faults=3)
    file.save(TRIED)
    assert TriesFile(path, memory).load() == TRIED


def test_the_same_is_not_written_twice(path: Path) -> None:
    file = TriesFile(path)
    file.save(TRIED)
    written_ns = path.stat().st_mtime_ns
    file.save(TRIED)
    assert path.stat().st_mtime_ns == written_ns
    path.unlink()
    again = TriesFile(path)
    again.load()
    again.save(NOTHING)
    assert not path.exists()


@pytest.mark.parametrize("ran", [False, True])
def test_memory_keeps_what_the_card_refuses(path: Path, memory: Path, *, ran: bool) -> None:
    TriesFile(path, memory).save(NOTHING)
    blocked = refuse(path)
    file = TriesFile(path, memory)
    assert file.load() == NOTHING
    assert not file.save(TRIED | {AZ: replace(TRIED[AZ], driven=ran)}), "who calls it is to try again"
    assert file.trouble
    assert TriesFile(path, memory).load() == TRIED | {AZ: replace(TRIED[AZ], faults=2 + ran)}
    blocked.rmdir()
    later = TriesFile(path, memory)
    later.save(later.load())
    assert not later.trouble
    expected = TRIED | {AZ: replace(TRIED[AZ], faults=2 + ran)}
    assert TriesFile(path).load() == TriesFile(path, memory).load() == later.load() == expected


@pytest.mark.parametrize("latest", [TRIED, TRIED | {AZ: replace(TRIED[AZ], driven=True)}, NOTHING])
@pytest.mark.parametrize("before", [NOTHING, TRIED])
def test_called_again_with_the_same_it_ends_the_trouble_once_the_card_is_well(
    path: Path, memory: Path, before: dict[Axis, Tries], latest: dict[Axis, Tries]
) -> None:
    file = TriesFile(path, memory)
    assert file.save(before)
    blocked = refuse(path)
    assert not file.save(dict.fromkeys(Axis, NO_TRIES) | {EL: Tries(pressed=True)})
    assert not file.save(latest)
    assert not file.save(latest)
    assert file.trouble
    blocked.rmdir()
    assert file.save(latest)
    assert not file.trouble
    assert TriesFile(path).load() == {axis: replace(each, driven=False) for axis, each in latest.items()}


def test_a_refusing_card_is_not_written_for_each_start_of_a_motor(path: Path, memory: Path) -> None:
    blocked = refuse(path)
    file = TriesFile(path, memory)
    file.save(TRIED)
    blocked.rmdir()
    for driven in (True, False, True):
        assert not file.save(TRIED | {AZ: replace(TRIED[AZ], driven=driven)})
    assert not path.exists()


def test_a_card_that_is_well_again_is_written_within_ten_starts_of_a_motor(path: Path, memory: Path) -> None:
    blocked = refuse(path)
    file = TriesFile(path, memory)
    file.save(TRIED)
    blocked.rmdir()
    written = [file.save(TRIED | {AZ: replace(TRIED[AZ], driven=start % 2 == 0)}) for start in range(12)]
    assert written == [False] * 9 + [True] * 3
    assert TriesFile(path).load() == TRIED


@pytest.mark.parametrize("deg", [-1000.0, -12.5, 1000.0])
def test_an_angle_on_either_side_of_zero_is_kept(path: Path, deg: float) -> None:
    stood = NOTHING | {AZ: Tries(1, FaultKind.STANDS_STILL, (None, deg), (deg, None))}
    TriesFile(path).save(stood)
    assert TriesFile(path).load() == stood


def test_ten_tries_are_the_most(path: Path) -> None:
    most = NOTHING | {AZ: Tries(10, FaultKind.STANDS_STILL)}
    TriesFile(path).save(most)
    assert TriesFile(path).load() == most


def test_without_a_place_in_memory_a_refusing_card_is_said(path: Path) -> None:
    refuse(path)
    file = TriesFile(path)
    assert not file.save(TRIED)
    assert file.trouble


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('"faults": 2', '"faults": 11'),
        ('"faults": 2', '"faults": -1'),
        ('"faults": 2', '"faults": NaN'),
        ("445.9", "1e400"),
        ("445.9", "-1001"),
        ('"END_STOP"', '"NO_SUCH_KIND"'),
        ('"pressed": true', '"pressed": 1'),
        ('"axes"', '"exes"'),
        ("{", "["),
    ],
)
def test_a_damaged_file_is_not_believed(path: Path, old: str, new: str, caplog: pytest.LogCaptureFixture) -> None:
    TriesFile(path).save(TRIED)
    path.write_text(path.read_text().replace(old, new))
    file = TriesFile(path)
    assert file.load() == NOTHING
    assert len(caplog.records) == 1
    file.save(NOTHING)
    assert TriesFile(path).load() == NOTHING


@pytest.mark.parametrize("in_memory", [False, True])
@pytest.mark.parametrize("old", [{"limits_deg": [0.0, 450.0]}, {}])
def test_an_axis_that_was_set_up_anew_forgets_its_places_and_keeps_its_count(
    path: Path, memory: Path, old: dict[str, object], in_memory: bool, caplog: pytest.LogCaptureFixture
) -> None:
    now: dict[str, object] = {"limits_deg": [0.0, 180.0]}
    kept = TRIED | {EL: Tries(1, FaultKind.STANDS_STILL, (None, 3.0), (None, 3.0))}
    blocked = refuse(path) if in_memory else None
    TriesFile(path, memory, {AZ: old, EL: now}).save(kept)
    if blocked:
        blocked.rmdir()
    caplog.set_level(logging.INFO)
    file = TriesFile(path, memory, {AZ: now, EL: now})
    expected = kept | {AZ: replace(TRIED[AZ], stood_deg=(None, None), stops_deg=(None, None))}
    assert file.load() == expected
    assert [record.getMessage() for record in caplog.records if record.levelno == logging.INFO] == [
        f"{path}: azimuth has been set up anew since; the stops that it met are forgotten"
    ]
    assert file.save(expected)
    back = TriesFile(path, memory, {AZ: old, EL: now})
    assert back.load() == expected, "a way back to the old settings brings no old place back"


def test_places_of_a_file_without_settings_are_not_believed(path: Path) -> None:
    TriesFile(path).save(TRIED)
    path.write_text(path.read_text().replace('"settings": {},', ""))
    assert TriesFile(path).load() == TRIED
    known = TriesFile(path, settings={AZ: {"offset_deg": 0.0}}).load()
    assert known == TRIED | {AZ: replace(TRIED[AZ], stood_deg=(None, None), stops_deg=(None, None))}
