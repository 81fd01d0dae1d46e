"""`rotator track`: ask the box to track a target, and tell what it is going to do.

Knows from the box's answers when its plan stands. The box finds the target, plans, and decides what moves.
"""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

import click

from rotator.cli.box import RunningBox
from rotator.cli.failed import CommandFailed

LOOK_S = 0.2
PATIENCE_S = 60.0
"""A plan takes some seconds, on a slow computer ten times as long."""


def begin(path: Path | None, words: str, *, clock_is_right: bool) -> None:
    """Returns when the antenna goes to wait for the target, or follows it. Raises CommandFailed."""
    with RunningBox(path) as box:
        if clock_is_right:
            box.order("clock-is-right")
        box.order(f"track {words}")
        if words.casefold() == "off":
            return click.echo("The box tracks nothing.")
        if words.casefold() == "plan":
            return click.echo("The box flies its plan: `rotator sky plan` shows it.")
        state = _planned(box)
        if state.startswith("ended: "):
            raise CommandFailed(state.removeprefix("ended: "))
        if state == "off":
            return click.echo("The antenna goes there, and stays.")
        tracks = _tracks(box)
    if tracks is None:
        raise CommandFailed("the box has a plan, and the antenna did not take it up: `rotator where` tells more")
    return click.echo(_sentence(tracks))


def _planned(box: RunningBox) -> str:
    """What goes on as soon as it is no longer planning."""
    give_up_s = time.monotonic() + PATIENCE_S
    while time.monotonic() < give_up_s:
        (state,) = box.order("track")
        if state != "planning":
            return state
        time.sleep(LOOK_S)
    raise CommandFailed(f"the box has made no plan within {PATIENCE_S:g} s; `rotator track off` gives up")


def _tracks(box: RunningBox) -> dict[str, Any] | None:
    """The status shows the plan a moment after the order."""
    for _ in range(10):
        if (tracks := box.status()["tracks"]) is not None:
            return dict(tracks)
        time.sleep(LOOK_S)
    return None


def _sentence(tracks: dict[str, Any]) -> str:
    wait_s = tracks["begins_in_s"]
    if wait_s > 0:
        text = f"{tracks['name']} rises in {_time(wait_s)}. The antenna goes there, and waits for it."
    elif tracks["ends_in_s"] is None:
        text = f"{tracks['name']} is always up. The antenna goes to it."
    else:
        text = f"{tracks['name']} is up for {_time(tracks['ends_in_s'])} more. The antenna goes to it."
    if tracks["expected_error_deg"] >= 0.1:
        text += f" Expect an error of up to {tracks['expected_error_deg']:.1f}°, from the age of its elements."
    return text


def _time(seconds: float) -> str:
    minutes = round(seconds / 60)
    if minutes >= 60:
        return f"{minutes // 60} h {minutes % 60:02d} min"
    return f"{minutes} min" if seconds >= 90 else f"{seconds:.0f} s"
