"""Work in a process of its own: its answers, its failures, and its end."""

from __future__ import annotations

import math
import os
import signal
import threading
import time
from pathlib import Path

import pytest

from rotator.runtime.own_process import OwnProcess


def test_it_answers_from_another_process_and_raises_what_the_job_raises() -> None:
    process = OwnProcess(60.0)
    other = process.compute(os.getpid)
    assert other != os.getpid()
    with pytest.raises(ValueError, match="domain"):
        process.compute(math.sqrt, -1.0)
    assert process.compute(os.getpid) == other
    with pytest.raises(RuntimeError, match="ended"):
        process.compute(os._exit, 1)
    assert process.compute(os.getpid) != other
    threading.Timer(0.0, process.close).start()
    with pytest.raises(RuntimeError, match="the box ends"):
        process.compute(time.sleep, 60.0)


def dies_once(path: Path) -> int:
    """The kernel ends the process in the middle of the first job."""
    if not path.exists():
        path.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return os.getpid()


def test_where_it_may_a_job_whose_process_was_killed_is_done_by_a_new_one(tmp_path: Path) -> None:
    process = OwnProcess(60.0, again=True)
    first = process.compute(os.getpid)
    os.kill(first, signal.SIGKILL)
    second = process.compute(os.getpid)
    assert second != first, "killed while it had nothing to do"
    third = process.compute(dies_once, tmp_path / "died")
    assert third not in (first, second), "killed in the middle"
    with pytest.raises(RuntimeError, match="ended"):
        process.compute(os._exit, 1)
    process.close()
    with pytest.raises(RuntimeError, match="the box ends"):
        process.compute(os.getpid)


def test_where_it_may_not_the_job_is_not_done_twice(tmp_path: Path) -> None:
    """A download would ask its server twice."""
    process = OwnProcess(60.0, once=True)
    with pytest.raises(RuntimeError, match="ended"):
        process.compute(dies_once, tmp_path / "died")
    process.close()


def test_a_box_that_ends_while_the_process_starts_gives_the_job_up() -> None:
    for head_start_s in (0.0, 0.0001, 0.0005, 0.002, 0.01):
        process = OwnProcess(60.0)
        failures: list[str] = []
        begun = threading.Event()

        def job(process: OwnProcess, begun: threading.Event, failures: list[str]) -> None:
            begun.set()
            try:
                process.compute(time.sleep, 60.0)
            except RuntimeError as failure:
                failures.append(str(failure))

        thread = threading.Thread(target=job, args=(process, begun, failures))
        thread.start()
        begun.wait()
        threading.Event().wait(head_start_s)
        process.close()
        thread.join()
        assert failures == ["the box ends"]


def test_a_job_that_needs_the_memory_of_the_box_is_refused_it() -> None:
    process = OwnProcess(60.0)
    with pytest.raises(ValueError, match="too much memory"):
        process.compute(bytearray, 600_000_000)
    process.close()


def test_a_job_that_takes_too_long_is_given_up_and_its_process_ended() -> None:
    process = OwnProcess(0.0, once=True)
    with pytest.raises(RuntimeError, match="longer than 0 s"):
        process.compute(time.sleep, 60.0)
    process.close()
