"""What is known of the relays survives: a doubt as a doubt, and after a crash no relay is taken for open."""

from __future__ import annotations

from pathlib import Path

import pytest

from hw.ports import Axis
from rotator.exchange.motor import ALL_OPEN, Trust, Trusts
from rotator.store.relays import UNKNOWN, KeptRelays, after
from rotator.store.state import State
from tests.refusing import hanging, refuse

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
SUSPECTED: dict[Axis, Trusts] = {AZ: (Trust.WELDED, Trust.OPEN), EL: (Trust.OPEN, Trust.DOUBTED)}


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "run" / "state.json"


def kept(path: Path, memory: Path | None = None) -> KeptRelays:
    return KeptRelays(State(path, memory))


def test_without_a_file_each_relay_may_be_closed(path: Path) -> None:
    assert kept(path).load() == {AZ: UNKNOWN, EL: UNKNOWN}


def test_from_its_beginning_on_the_file_says_that_the_program_runs(path: Path) -> None:
    kept(path).save(SUSPECTED, ending=True)
    assert kept(path).begin() == SUSPECTED
    assert kept(path).load() == {AZ: (Trust.WELDED, Trust.UNSEEN), EL: (Trust.UNSEEN, Trust.DOUBTED)}


def test_what_a_card_says_that_refuses_may_be_older_than_the_last_run(path: Path) -> None:
    kept(path).save(SUSPECTED, ending=True)
    refuse(path)
    file = kept(path)
    assert file.begin() == {AZ: (Trust.WELDED, Trust.UNSEEN), EL: (Trust.UNSEEN, Trust.DOUBTED)}
    assert file.state.trouble
    assert not file.state.outlives


@pytest.mark.parametrize("ending", [False, True])
def test_memory_keeps_what_the_card_refuses(path: Path, tmp_path: Path, *, ending: bool) -> None:
    memory = tmp_path / "memory"
    kept(path, memory).save({AZ: ALL_OPEN, EL: ALL_OPEN}, ending=True)
    blocked = refuse(path)
    file = kept(path, memory)
    file.begin()
    file.save(SUSPECTED, ending=ending)
    assert file.state.trouble
    assert file.state.outlives
    left = {axis: after(each, proper=ending) for axis, each in SUSPECTED.items()}
    assert kept(path, memory).begin() == left
    blocked.rmdir()
    assert kept(path, memory).begin()[AZ][0] is Trust.WELDED
    assert not list(memory.iterdir())
    assert kept(path).load()[AZ][0] is Trust.WELDED


def test_a_proper_end_keeps_what_was_known(path: Path) -> None:
    kept(path).save(SUSPECTED, ending=True)
    assert kept(path).load() == SUSPECTED


def test_a_program_that_has_not_ended_properly_leaves_each_relay_unseen_and_each_doubt_a_doubt(path: Path) -> None:
    kept(path).save(SUSPECTED)
    assert kept(path).load() == {AZ: (Trust.WELDED, Trust.UNSEEN), EL: (Trust.UNSEEN, Trust.DOUBTED)}


def test_runs_that_come_and_go_are_not_written(path: Path) -> None:
    file = kept(path)
    file.save({AZ: ALL_OPEN, EL: ALL_OPEN})
    written_ns = path.stat().st_mtime_ns
    file.save({AZ: UNKNOWN, EL: ALL_OPEN})
    assert path.stat().st_mtime_ns == written_ns
    file.save({AZ: (Trust.DOUBTED, Trust.OPEN), EL: ALL_OPEN})
    assert path.stat().st_mtime_ns != written_ns


def test_a_start_does_not_wait_for_a_card_that_hangs_and_believes_no_relay(path: Path, tmp_path: Path) -> None:
    memory = tmp_path / "memory"
    kept(path).save(SUSPECTED, ending=True)
    with hanging(path):
        file = kept(path, memory)
        assert file.begin(0.01) == {AZ: (Trust.WELDED, Trust.UNSEEN), EL: (Trust.UNSEEN, Trust.DOUBTED)}
        file.note({AZ: (Trust.WELDED, Trust.WELDED), EL: ALL_OPEN})
        file.state.spare()
        assert kept(path, memory).load()[AZ] == (Trust.WELDED, Trust.WELDED)
