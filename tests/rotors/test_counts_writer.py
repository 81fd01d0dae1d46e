"""The count's file and the control thread: a motor starts only when the file says so; control waits for no disk."""

from __future__ import annotations

import threading
from collections.abc import Callable
from pathlib import Path

import pytest

from hw.ports import Axis
from rotator.rotors.counts_writer import COUNTS_THREAD, CountsWriter
from rotator.store.counts import CountsFile, Place, Standing
from rotator.store.hanging import writes
from tests.refusing import hanging, wait_until

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
CAMS = {AZ: {"spacing_deg": 5.0}, EL: {"spacing_deg": 5.0}}
PATIENCE_S = 20.0


class SlowDisk:
    """Jobs wait until the disk gets to them."""

    def __init__(self) -> None:
        self.jobs: list[Callable[[], None]] = []

    def __call__(self, job: Callable[[], None]) -> None:
        self.jobs.append(job)

    def work(self) -> None:
        jobs, self.jobs = self.jobs, []
        for job in jobs:
            job()


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "counts.json"


@pytest.fixture
def disk() -> SlowDisk:
    return SlowDisk()


def known(path: Path) -> CountsFile:
    """A file in which both axes stand."""
    file = CountsFile(path, CAMS)
    file.home(AZ, 100.0)
    file.home(EL, 20.0)
    return file


def standing(path: Path, axis: Axis = AZ) -> Standing:
    return CountsFile(path, CAMS).load()[axis].standing


def test_a_motor_waits_until_the_file_says_that_it_moves(path: Path, disk: SlowDisk) -> None:
    counts_writer = CountsWriter(known(path), disk)
    assert [counts_writer.may_start(AZ) for _ in range(3)] == [False] * 3, "asked once, and then waited for"
    assert len(disk.jobs) == 1
    assert standing(path) is Standing.KNOWN
    disk.work()
    assert standing(path) is Standing.LOST, "moving, when it is read again"
    assert counts_writer.may_start(AZ)
    assert standing(path, EL) is Standing.KNOWN
    assert counts_writer.trouble(AZ, 0.0) == ""


def test_a_file_that_cannot_be_written_refuses_and_says_why(path: Path, disk: SlowDisk) -> None:
    counts_writer = CountsWriter(known(path), disk)
    path.unlink()
    path.mkdir()
    assert not counts_writer.may_start(AZ)
    assert counts_writer.trouble(AZ, 0.0) == "", "nothing is known yet"
    disk.work()
    assert "directory" in counts_writer.trouble(AZ, 0.0)
    assert counts_writer.trouble(EL, 0.0) == "", "the other axis was not ordered"
    assert not counts_writer.may_start(AZ)
    path.rmdir()
    disk.work()
    assert counts_writer.may_start(AZ)
    assert counts_writer.trouble(AZ, 0.0) == ""


def test_in_real_time_a_thread_of_its_own_writes_and_ends(path: Path) -> None:
    counts_writer = CountsWriter(known(path))
    give_up = threading.Event()
    for _ in range(round(PATIENCE_S / 0.005)):
        if counts_writer.may_start(AZ):
            break
        give_up.wait(0.005)
    assert standing(path) is Standing.LOST
    counts_writer.rests(AZ, 130.0)
    counts_writer.close()
    assert CountsFile(path, CAMS).load()[AZ] == Place(Standing.KNOWN, 130.0), "close writes what stands"
    assert not [thread for thread in threading.enumerate() if thread.name.startswith(COUNTS_THREAD)]


def test_the_end_does_not_wait_for_a_card_that_hangs(path: Path) -> None:
    counts_writer = CountsWriter(known(path))
    with hanging(path):
        assert not counts_writer.may_start(AZ)
        wait_until(lambda: path in writes().values())
        counts_writer.close(0.05)
        assert [thread for thread in threading.enumerate() if thread.name == COUNTS_THREAD and thread.daemon]
