"""What is known of the relays survives: a doubt as a doubt, and after a crash no relay is taken for open."""

from __future__ import annotations

from pathlib import Path

import pytest

from hw.ports import Axis
from rotator.status import ALL_OPEN, Trust, Trusts
from rotator.store.relays import UNKNOWN, RelaysFile

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
SUSPECTED: dict[Axis, Trusts] = {AZ: (Trust.WELDED, Trust.OPEN), EL: (Trust.OPEN, Trust.DOUBTED)}


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "run" / "relays.json"


def test_without_a_file_no_relay_was_ever_closed(path: Path) -> None:
    assert RelaysFile(path).load() == {AZ: ALL_OPEN, EL: ALL_OPEN}


def test_a_proper_end_keeps_what_was_known(path: Path) -> None:
    RelaysFile(path).save(SUSPECTED, ending=True)
    assert RelaysFile(path).load() == SUSPECTED


def test_a_program_that_has_not_ended_properly_leaves_each_relay_unseen_and_each_doubt_a_doubt(path: Path) -> None:
    RelaysFile(path).save(SUSPECTED)
    assert RelaysFile(path).load() == {AZ: (Trust.WELDED, Trust.UNSEEN), EL: (Trust.UNSEEN, Trust.DOUBTED)}


def test_runs_that_come_and_go_are_not_written(path: Path) -> None:
    file = RelaysFile(path)
    file.save({AZ: ALL_OPEN, EL: ALL_OPEN})
    path.unlink()
    file.save({AZ: UNKNOWN, EL: ALL_OPEN})
    assert not path.exists()
    file.save({AZ: (Trust.DOUBTED, Trust.OPEN), EL: ALL_OPEN})
    assert path.exists()


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
