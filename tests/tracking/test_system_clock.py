"""Whether the clock has been set: asked of the system's own tool, which a test replaces, and of the kernel."""

from __future__ import annotations

from pathlib import Path

import pytest

from rotator.tracking.system_clock import (
    ASSUMED_ERROR_S,
    LONG_UNSET_AGAIN_S,
    SET_AGAIN_S,
    SOON_S,
    UNSET_AGAIN_S,
    SystemClock,
    expected_s,
)


@pytest.fixture
def tool(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """`timedatectl`, which prints what this file's neighbour holds."""
    tool = tmp_path / "timedatectl"
    tool.write_text(f'#!/bin/sh\necho "$@" > {tmp_path}/asked\ncat {tmp_path}/answer\n')
    tool.chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}:/usr/bin:/bin")
    return tmp_path / "answer"


@pytest.mark.parametrize(("answer", "is_set"), [("yes\n", True), ("no\n", False)])
def test_the_tool_answers(tool: Path, answer: str, is_set: bool) -> None:
    tool.write_text(answer)
    clock = SystemClock()
    assert not clock.is_set, "before the first look"
    clock.look(100.0)
    assert clock.is_set is is_set
    assert tool.with_name("asked").read_text() == "show --property=NTPSynchronized --value\n"


def test_it_waits_for_a_clock_that_is_not_set_and_seldom_asks_for_one_that_is(tool: Path) -> None:
    clock = SystemClock()
    tool.write_text("no\n")
    clock.look(100.0)
    tool.write_text("yes\n")
    clock.look(100.0 + UNSET_AGAIN_S - 0.1)
    assert not clock.is_set
    clock.look(100.0 + UNSET_AGAIN_S)
    assert clock.is_set
    tool.write_text("no\n")
    clock.look(100.0 + SET_AGAIN_S)
    assert clock.is_set
    clock.look(100.0 + UNSET_AGAIN_S + SET_AGAIN_S)
    assert not clock.is_set


def test_a_clock_that_is_not_set_for_long_is_asked_for_less_often(tool: Path) -> None:
    clock = SystemClock()
    tool.write_text("no\n")
    clock.look(100.0)
    clock.look(100.0 + SOON_S)
    tool.write_text("yes\n")
    clock.look(100.0 + SOON_S + LONG_UNSET_AGAIN_S - 0.1)
    assert not clock.is_set
    clock.look(100.0 + SOON_S + LONG_UNSET_AGAIN_S)
    assert clock.is_set


def test_without_the_tool_the_kernel_answers(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    clock = SystemClock()
    clock.look(0.0)
    assert clock.is_set in (True, False)


@pytest.mark.parametrize(
    ("most_us", "estimated_us", "error_s"),
    [
        (500_000, 20_000, 0.02),  # chrony tells what it expects
        (400_000, 0, 0.04),  # timesyncd does not: a crystal drifts by a tenth of what the kernel fears
        (16_000_000, 0, ASSUMED_ERROR_S),
        (16_000_000, 16_000_000, ASSUMED_ERROR_S),
    ],
)
def test_its_error_is_what_the_kernel_expects(most_us: int, estimated_us: int, error_s: float) -> None:
    assert expected_s(most_us, estimated_us) == pytest.approx(error_s)


def test_a_clock_that_is_not_set_may_be_off_by_what_a_person_does_not_see(tool: Path) -> None:
    tool.write_text("no\n")
    clock = SystemClock()
    assert clock.error_s == ASSUMED_ERROR_S
    clock.look(100.0)
    assert 0.0 <= clock.error_s <= ASSUMED_ERROR_S
