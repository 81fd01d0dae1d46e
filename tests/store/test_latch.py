"""A latched stop survives the program; it is written once, however often it is repeated; a damaged file is a stop."""

from __future__ import annotations

import logging
from pathlib import Path

import pytest

from rotator.exchange.status import Latch
from rotator.store.latch import DAMAGED, LatchFile
from tests.refusing import refuse

STOP, STORM = Latch("page#2"), Latch("console#3", storm=True)


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "run" / "latch.json"


def test_without_a_file_nothing_was_stopped_and_none_is_written_for_that(path: Path) -> None:
    file = LatchFile(path)
    assert file.load() is None
    assert file.save(None)
    assert not path.exists()


@pytest.mark.parametrize("latch", [STOP, STORM])
def test_the_next_run_knows_who_stopped_it_and_how(path: Path, latch: Latch) -> None:
    assert LatchFile(path).save(latch)
    assert LatchFile(path).load() == Latch(f"{latch.by} before the restart", storm=latch.storm)


def test_a_long_name_is_kept_whole(path: Path) -> None:
    LatchFile(path).save(Latch("x" * 200))
    assert LatchFile(path).load() == Latch("x" * 200 + " before the restart")


def test_a_release_is_kept_too(path: Path) -> None:
    LatchFile(path).save(STOP)
    file = LatchFile(path)
    file.load()
    assert file.save(None)
    assert LatchFile(path).load() is None


def test_after_ten_restarts_it_says_so_once(path: Path) -> None:
    LatchFile(path).save(STOP)
    for _ in range(10):
        file = LatchFile(path)
        latch = file.load()
        assert latch == Latch("page#2 before the restart")
        file.save(latch)


def test_a_repeated_stop_writes_nothing(path: Path) -> None:
    file = LatchFile(path)
    file.save(STOP)
    written_ns = path.stat().st_mtime_ns
    for number in range(100):
        assert file.save(Latch(f"console#{number}"))
    assert path.stat().st_mtime_ns == written_ns
    file.save(STORM)
    assert path.stat().st_mtime_ns != written_ns, "a storm park is another thing"


def test_a_stop_that_could_not_be_written_is_written_later(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    (tmp_path / "run").write_text("a file where the folder should be")
    file = LatchFile(tmp_path / "run" / "latch.json")
    assert not file.save(STOP)
    assert not file.save(STOP)
    assert [record.levelno for record in caplog.records] == [logging.ERROR], "each reason once"
    (tmp_path / "run").unlink()
    assert file.save(STOP)
    assert LatchFile(tmp_path / "run" / "latch.json").load() == Latch("page#2 before the restart")


@pytest.mark.parametrize(
    "text",
    [
        "",
        "\0" * 40,
        "{}",
        '{"format": "rotator latch 1"}',
        '{"format": "rotator latch 1", "by": ""}',
        '{"format": "rotator latch 1", "by": 0, "storm": false}',
        '{"format": "rotator latch 1", "by": null, "storm": false}',
        '{"format": "rotator latch 1", "by": "", "storm": true}',
        '{"format": "rotator latch 1", "by": "' + "x" * 201 + '", "storm": false}',
        '{"format": "rotator latch 1", "by": "page#2", "storm": "no"}',
        '{"format": "rotator latch 1", "by": "a\\u001b[2Jb", "storm": false}',
    ],
)
def test_a_damaged_file_may_have_held_a_stop(path: Path, text: str, caplog: pytest.LogCaptureFixture) -> None:
    path.parent.mkdir()
    path.write_text(text)
    file = LatchFile(path)
    assert file.load() == DAMAGED
    assert len(caplog.records) == 1
    assert file.save(DAMAGED)
    assert LatchFile(path).load() == Latch("the damaged file latch.json before the restart")


def test_memory_keeps_a_stop_that_the_card_refuses(tmp_path: Path) -> None:
    path, memory = tmp_path / "latch.json", tmp_path / "memory"
    blocked = refuse(path)
    assert not LatchFile(path, memory).save(STOP)
    assert LatchFile(path, memory).load() == Latch(f"{STOP.by} before the restart")
    blocked.rmdir()
    assert LatchFile(path, memory).save(STOP)
    assert LatchFile(path).load() == Latch(f"{STOP.by} before the restart")
    assert not list(memory.iterdir())


def test_it_says_whether_a_release_that_the_card_refuses_outlives_the_program(tmp_path: Path) -> None:
    path, memory = tmp_path / "latch.json", tmp_path / "memory"
    LatchFile(path).save(STOP)
    refuse(path)
    for folder, outlives in ((None, False), (memory, True)):
        file = LatchFile(path, folder)
        file.load()
        assert not file.save(None)
        assert file.outlives is outlives
        assert (LatchFile(path, folder).load() is None) is outlives


@pytest.mark.parametrize("before", [None, STORM])
@pytest.mark.parametrize("latch", [STOP, STORM, None])
def test_what_memory_alone_kept_is_written_to_the_card_by_the_next_run(
    tmp_path: Path, before: Latch | None, latch: Latch | None
) -> None:
    path, memory = tmp_path / "latch.json", tmp_path / "memory"
    first = LatchFile(path, memory)
    first.save(before)
    blocked = refuse(path)
    first.save(latch)
    blocked.rmdir()
    second = LatchFile(path, memory)
    assert second.save(second.load())
    kept = LatchFile(path).load()  # after a power cut there is only the card
    assert (kept is not None, kept is not None and kept.storm) == (latch is not None, latch is not None and latch.storm)
