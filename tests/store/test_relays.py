"""What is known of the relays survives: a doubt as a doubt, and after a crash no relay is taken for open."""

from __future__ import annotations

from pathlib import Path

import pytest

from hw.ports import Axis
from rotator.exchange.motor import ALL_OPEN, Trust, Trusts
from rotator.store.relays import UNKNOWN, RelaysFile, after
from tests.refusing import hanging, refuse

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
SUSPECTED: dict[Axis, Trusts] = {AZ: (Trust.WELDED, Trust.OPEN), EL: (Trust.OPEN, Trust.DOUBTED)}


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "run" / "relays.json"


def test_without_a_file_each_relay_may_be_closed(path: Path) -> None:
    assert RelaysFile(path).load() == {AZ: UNKNOWN, EL: UNKNOWN}


def test_from_its_beginning_on_the_file_says_that_the_program_runs(path: Path) -> None:
    RelaysFile(path).save(SUSPECTED, ending=True)
    assert RelaysFile(path).begin() == SUSPECTED
    assert RelaysFile(path).load() == {AZ: (Trust.WELDED, Trust.UNSEEN), EL: (Trust.UNSEEN, Trust.DOUBTED)}


def test_what_a_card_says_that_refuses_may_be_older_than_the_last_run(path: Path) -> None:
    RelaysFile(path).save(SUSPECTED, ending=True)
    refuse(path)
    file = RelaysFile(path)
    assert file.begin() == {AZ: (Trust.WELDED, Trust.UNSEEN), EL: (Trust.UNSEEN, Trust.DOUBTED)}
    assert file.trouble
    assert not file.outlives


@pytest.mark.parametrize("ending", [False, True])
def test_memory_keeps_what_the_card_refuses(path: Path, tmp_path: Path, *, ending: bool) -> None:
    memory = tmp_path / "memory"
    RelaysFile(path, memory).save({AZ: ALL_OPEN, EL: ALL_OPEN}, ending=True)
    blocked = refuse(path)
    file = RelaysFile(path, memory)
    file.begin()
    file.save(SUSPECTED, ending=ending)
    assert file.trouble
    assert file.outlives
    left = {axis: after(each, proper=ending) for axis, each in SUSPECTED.items()}
    assert RelaysFile(path, memory).begin() == left
    blocked.rmdir()
    assert RelaysFile(path, memory).begin()[AZ][0] is Trust.WELDED
    assert not list(memory.iterdir())
    assert RelaysFile(path).load()[AZ][0] is Trust.WELDED


def test_after_a_refusal_the_same_is_written_again_at_the_next_call(
    path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    file = RelaysFile(path)
    blocked = refuse(path)
    assert not file.save(SUSPECTED)
    assert not file.save(SUSPECTED)
    blocked.rmdir()
    assert file.save(SUSPECTED)
    assert path.exists()
    assert not file.trouble
    assert len(caplog.records) == 1


def test_a_proper_end_keeps_what_was_known(path: Path) -> None:
    RelaysFile(path).save(SUSPECTED, ending=True)
    assert RelaysFile(path).load() == SUSPECTED


def test_a_program_that_has_not_ended_properly_leaves_each_relay_unseen_and_each_doubt_a_doubt(path: Path) -> None:
    RelaysFile(path).save(SUSPECTED)
    assert RelaysFile(path).load() == {AZ: (Trust.WELDED, Trust.UNSEEN), EL: (Trust.UNSEEN, Trust.DOUBTED)}


def test_runs_that_come_and_go_are_not_written(path: Path) -> None:
    file = RelaysFile(path)
    file.save({AZ: ALL_OPEN, EL: ALL_OPEN})
    written_ns = path.stat().st_mtime_ns
    file.save({AZ: UNKNOWN, EL: ALL_OPEN})
    assert path.stat().st_mtime_ns == written_ns
    file.save({AZ: (Trust.DOUBTED, Trust.OPEN), EL: ALL_OPEN})
    assert path.stat().st_mtime_ns != written_ns


@pytest.mark.parametrize(
    "text",
    [
        "",
        "{}",
        '{"format": "rotator relays 1"}',
        '{"format": "rotator relays 1", "axes": {"azimuth": {"plus": 0}}}',
    ],
)
def test_a_damaged_file_leaves_each_relay_unseen(path: Path, text: str, caplog: pytest.LogCaptureFixture) -> None:
    path.parent.mkdir()
    path.write_text(text)
    assert RelaysFile(path).load() == {AZ: UNKNOWN, EL: UNKNOWN}
    assert len(caplog.records) == 1


def test_a_start_does_not_wait_for_a_card_that_hangs_and_believes_no_relay(path: Path, tmp_path: Path) -> None:
    memory = tmp_path / "memory"
    RelaysFile(path).save(SUSPECTED, ending=True)
    with hanging(path):
        file = RelaysFile(path, memory)
        assert file.begin(0.01) == {AZ: (Trust.WELDED, Trust.UNSEEN), EL: (Trust.UNSEEN, Trust.DOUBTED)}
        file.spare({AZ: (Trust.WELDED, Trust.WELDED), EL: ALL_OPEN})
        assert RelaysFile(path, memory).load()[AZ] == (Trust.WELDED, Trust.WELDED)
