"""`rotator track`: ask the box to track a target, and tell what it is going to do.

Knows from the box's answers when its plan stands. The box finds the target, plans, and decides what moves.
"""

from __future__ import annotations

import os.path
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import click

from rotator.cli.box import RunningBox, faults
from rotator.cli.failed import FAULTY, CommandFailed
from rotator.exchange.spoken import spoken
from rotator.exchange.status import SHOWN_ERROR_DEG, time_left

LOOK_S = 0.2
MOST_BYTES = 1_000_000
PATIENCE_S = 60.0
"""A plan takes some seconds, on a slow computer ten times as long."""


def begin(path: Path | None, words: Sequence[str], *, clock_is_right: bool) -> None:
    """Returns when the antenna goes to wait for the target, or follows it. Raises CommandFailed.

    Without words: tell what is tracked.
    """
    target = " ".join(words)
    table = _table(target) if target else None
    with RunningBox(path) as box:
        if clock_is_right:
            box.order("clock-is-right")
        if not target:
            return click.echo(_goes_on(box))
        if table is not None:
            _hand_in(box, table, Path(target).stem)
        else:
            box.order(f"track {target}")
        if target.casefold() == "off":
            return click.echo("The box tracks nothing.")
        if target.casefold() == "plan":
            return click.echo("The box flies its plan: `rotator sky plan` shows it.")
        state = _planned(box)
        if state.startswith("ended: "):
            raise CommandFailed(spoken(state.removeprefix("ended: ")))
        if state.startswith("refused: "):
            raise CommandFailed(f"{state.removeprefix('refused: ')}; what was tracked goes on")
        told = _stays(target) if _is_nothing(state) else _taken_up(box)
        failed = faults(box.status())
    click.echo(told)
    if failed:
        raise CommandFailed("\n         ".join(("a fault holds the antenna:", *failed)), FAULTY)
    return None


def _table(words: str) -> list[str] | None:
    """The lines of the file that the words name; None: they name no file. Raises CommandFailed."""
    path = Path(words)
    # A satellite may be called like a file of this folder. A name that is too long for a file is none: Path.is_file()
    # would raise.
    like_a_file = "." in words or "/" in words
    if not like_a_file or (path.suffix.lower() != ".csv" and not os.path.isfile(path)):
        return None
    from rotator.protocols.table_text import TableError, no_text, read_table  # noqa: PLC0415 - no other target needs it
    from rotator.store.plain import read_plain  # noqa: PLC0415

    try:
        text = read_plain(path, MOST_BYTES).decode("utf-8-sig")
        read_table(text, path.stem, str(path), turns=True)
    except OSError as fault:
        raise CommandFailed(f"{path}: {fault.strerror}") from None
    except UnicodeDecodeError:
        raise CommandFailed(no_text(str(path))) from None
    except TableError as mistake:
        raise CommandFailed(str(mistake)) from None
    return text.splitlines()


def _hand_in(box: RunningBox, lines: list[str], name: str) -> None:
    """Line by line, so that the box names the same lines as an editor."""
    box.order("table")
    for line in lines:
        box.order(f"table {line if line.strip() else ','}")
    box.order(f"track-table {'-'.join(name.split())[:40] or 'table'}")


def _goes_on(box: RunningBox) -> str:
    (state,) = box.order("track")
    tracks = box.status()["tracks"]
    if tracks is not None:
        return _sentence(tracks)
    if state == "planning":
        return "The box makes a plan."
    _, _, why = spoken(state).partition(": ")
    if why.startswith("the plan rests"):
        why += "; `rotator track plan` ends that"
    return f"The box tracks nothing: {why}." if why else "The box tracks nothing."


def _planned(box: RunningBox) -> str:
    """The box's answer as soon as it is no longer planning. Raises CommandFailed."""
    give_up_s, planned = time.monotonic() + PATIENCE_S, False
    while time.monotonic() < give_up_s:
        (state,) = box.order("track")
        if state != "planning":
            if planned and _is_nothing(state):
                raise CommandFailed("another person has ended the tracking meanwhile")
            return state
        planned = True
        time.sleep(LOOK_S)
    raise CommandFailed(f"the box has made no plan within {PATIENCE_S:g} s; `rotator track off` gives up")


def _stays(words: str) -> str:
    """Of a direction that does not move. A name such as FO29 is a locator where no satellite of that name is known."""
    from rotator.orbits.targets import place  # noqa: PLC0415 - no other answer needs it

    there = place(words)
    return f"The antenna {f'points at {there[0]}' if there else 'goes there'}, and stays."


def _is_nothing(state: str) -> bool:
    """Whether the box tracks nothing, though no request has failed: a direction needs no plan."""
    return state == "off" or state.startswith("rests: ")


def _taken_up(box: RunningBox) -> str:
    """What the antenna does, which the status shows a moment after the order. Raises CommandFailed."""
    for _ in range(10):
        if (tracks := box.status()["tracks"]) is not None:
            return _sentence(tracks)
        time.sleep(LOOK_S)
    raise CommandFailed("the box has a plan, and the antenna did not take it up: `rotator where` tells more")


def _sentence(tracks: dict[str, Any]) -> str:
    wait_s, table = tracks["begins_in_s"], tracks["table"]
    name = f"The table {tracks['name']}" if table else tracks["name"]
    if wait_s > 0:
        text = f"{name} {'begins' if table else 'rises'} in {time_left(wait_s)}. The antenna waits for it there."
    elif table:
        text = f"{name} goes on for {time_left(tracks['ends_in_s'])} more. The antenna follows it."
    elif tracks["ends_in_s"] is None:
        text = f"{name} is always up. The antenna follows it."
    else:
        text = f"{name} is up for {time_left(tracks['ends_in_s'])} more. The antenna follows it."
    if tracks["expected_error_deg"] >= SHOWN_ERROR_DEG:
        text += (
            f" Expect an error of up to {tracks['expected_error_deg']:.1f}°, from the age of its elements and the clock"
        )
        beyond = ": MORE THAN HALF OF THE BEAM. It needs newer elements, or the right time."
        text += beyond if tracks["beyond_beam"] else "."
    return text
