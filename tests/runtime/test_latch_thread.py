"""The thread that writes a latched stop: the newest counts, and the end waits for the disk."""

from __future__ import annotations

import threading
import time
from pathlib import Path

from rotator.runtime.latch_thread import LatchThread
from rotator.status import Latch
from rotator.store.latch import DAMAGED, LatchFile

PATIENCE_S = 20.0
STOP, STORM = Latch("panel"), Latch("console#3", storm=True)


def left_in(path: Path) -> Latch | None:
    return LatchFile(path).load()


def begun(path: Path) -> LatchThread:
    file = LatchFile(path)
    thread = LatchThread(file, file.load())
    thread.start()
    return thread


def come(path: Path) -> bool:
    """Whether the file is there, soon."""
    end_s = time.monotonic() + PATIENCE_S
    waits = threading.Event()
    while not path.exists() and time.monotonic() < end_s:
        waits.wait(0.01)
    return path.exists()


def test_a_stop_is_in_the_file_while_the_program_still_runs(tmp_path: Path) -> None:
    path = tmp_path / "latch.json"
    thread = begun(path)
    thread.note(STOP)
    assert come(path)
    assert left_in(path) == Latch("panel before the restart")
    thread.close()


def test_of_many_changes_the_newest_is_kept_and_the_end_waits_for_it(tmp_path: Path) -> None:
    path = tmp_path / "latch.json"
    thread = begun(path)
    for latch in (STOP, None, STOP, None, STORM):
        thread.note(latch)
    thread.close()
    assert left_in(path) == Latch("console#3 before the restart", storm=True)
    thread.close()


def test_a_damaged_file_is_replaced_at_the_start_by_one_that_says_stopped(tmp_path: Path) -> None:
    path = tmp_path / "latch.json"
    path.write_text("x")
    begun(path).close()
    assert left_in(path) == Latch(f"{DAMAGED.by} before the restart")


def test_what_the_card_refused_is_tried_once_more_at_the_end(tmp_path: Path) -> None:
    folder = tmp_path / "run"
    thread = begun(folder / "latch.json")
    folder.write_text("a file where the folder should be")
    thread.note(STOP)
    folder.unlink()
    thread.close()
    assert left_in(folder / "latch.json") == Latch("panel before the restart")
