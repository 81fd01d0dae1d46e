"""The commands that move the antenna: give the order, show the way, and end when it stands, or when it will not arrive.

Knows from the box's status whether an order has had its effect. The box alone decides what moves, and keeps the rules
of safety. Ctrl-C stops the antenna. When the terminal closes, an antenna that points goes on to its place, as if a
program had sent it there; one that homes is stopped, for a person must watch that.
"""

from __future__ import annotations

import signal
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

import click

from rotator.cli.box import AXES, ENDED, BoxStatus, Refused, RunningBox, all_stand, faults, fitted, stands, typed
from rotator.cli.commands import draws
from rotator.cli.failed import FAULTY, CommandFailed, NoBox
from rotator.cli.lines import agree, columns
from rotator.cli.reach import consoles
from rotator.cli.stop import STOPPED, stop_boxes
from rotator.control.sky.angles import ZENITH_DEG
from rotator.exchange.sources import CONSOLE
from rotator.exchange.spoken import sender

LOOK_S = 0.2
"""The time between two looks at the antenna, in seconds."""
TAKEN_LOOKS = 5
"""An order shows in the status after so many looks at the latest. A relay's dead time is shorter too."""
BEGINS_LOOKS = 20
"""A jog begins after at most this many looks: the box first watches the axis stand, and a relay may have to wait."""
HOMING_LOOKS = 15
"""An axis that homes pauses within its homing, for less than so many looks."""
SAME_DEG = 1.0
"""An end of the range may be off by so much, by the offsets of the file, without a word."""


def point(path: Path | None, azimuth_deg: float, elevation_deg: float | None, *, wait: bool) -> None:
    """Point there, and return when the antenna has arrived. Raises CommandFailed if it has not."""
    numbers = [typed(each) for each in (azimuth_deg, elevation_deg) if each is not None]
    reached = _travel(path, f"point {' '.join(numbers)}", wait=wait)
    raised = reached["elevation"] if reached else None
    rests_deg = raised["target_deg"] if raised and raised["fitted"] else None
    if rests_deg is not None and elevation_deg is not None and elevation_deg + SAME_DEG < rests_deg <= ZENITH_DEG:
        why = "its range, [mount] horizon, or a forbidden sector"
        click.echo(f"It points no lower than {rests_deg:.1f}° there: {why}.")


def park(path: Path | None, *, wait: bool) -> None:
    if _travel(path, "park", wait=wait):
        click.echo("Nothing else moves it until `rotator resume`.")


def jog(path: Path | None, direction: str, seconds: float, *, wait: bool) -> None:
    """Turn one axis for a time, and return when it stands. Raises CommandFailed if a fault ended it."""
    axis = "azimuth" if direction in ("cw", "ccw") else "elevation"
    with RunningBox(path) as box:
        before = box.status()
        with _stops_on_ctrl_c(path):
            box.order(f"jog {direction} {typed(seconds)}")
            if not wait:
                return click.echo("The box has the order.")
            after, ours = _watched(box, before, (axis,), begins=BEGINS_LOOKS)
    _judge(after, ours, (axis,), "the jog")
    if before[axis]["angle_deg"] is None or after[axis]["angle_deg"] is None:
        return click.echo(f"{axis}: its angle is not known.")
    moved_deg = after[axis]["angle_deg"] - before[axis]["angle_deg"]
    return click.echo(f"{stands(after, axis)}: {moved_deg:+.1f}° from before.")


def home(path: Path | None, axis: str, *, yes: bool) -> None:
    """Home an axis, and return when it stands. Any other end stops the antenna. Raises CommandFailed if not homed."""
    for signum in (signal.SIGTERM, signal.SIGHUP):
        # A closed terminal means that the user no longer watches: the same as Ctrl-C.
        signal.signal(signum, signal.default_int_handler)
    with RunningBox(path) as box:
        before = box.status()
        if not before[axis]["homeable"]:
            box.order(f"home {axis}")  # it says why not
        agree(f"Watch the antenna: {axis} turns to its low end. Ctrl-C stops it. Begin?", yes=yes)
        with _stops_unless_done(path):
            box.order(f"home {axis}")
            after, ours = _watched(box, before, (axis,), patience=HOMING_LOOKS)
    _judge(after, ours, (axis,), "the homing")
    if after[axis]["missing"]:
        raise CommandFailed(f"{axis} is not homed: it needs {', '.join(after[axis]['missing'])}")
    click.echo(f"{stands(after, axis)}: homed.")


def _travel(path: Path | None, words: str, *, wait: bool) -> BoxStatus | None:
    """Go there. Returns the status at the end; None: it was not waited for. Raises CommandFailed."""
    with RunningBox(path) as box, _stops_on_ctrl_c(path):
        before = box.status()
        box.order(words)
        if not wait:
            click.echo("The box has the order. `rotator where` shows what comes of it.")
            return None
        after, ours = _watched(box, before, fitted(before))
    _judge(after, ours, AXES, words.partition(" ")[0])
    for axis in AXES:
        if missing := after[axis]["missing"]:
            raise CommandFailed(f"{axis} did not move: it needs {', '.join(missing)}")
    click.echo(f"Arrived: {all_stand(after)}.")
    return after


def _judge(after: BoxStatus, ours: str, axes: Sequence[str], order: str) -> None:
    """Raises CommandFailed where an axis did not do what was ordered. `ours`: this command, as the box calls it."""
    if failed := faults(after, axes):
        click.echo(f"{all_stand(after)}.")
        raise CommandFailed("\n         ".join(failed), FAULTY)
    if after["stopped_by"] and not after["storm_park"]:
        raise CommandFailed(
            f"{order} was ended: stopped by {sender(after['stopped_by'])}; nothing moves until `rotator resume`"
        )
    mover = str(after["moved_by"] or "")
    if not mover.startswith(CONSOLE) or (ours and mover != ours):
        other = "another command" if mover.startswith(CONSOLE) else sender(mover)
        ended = f"{other} moves the antenna now" if mover else "the antenna was stopped"
        raise CommandFailed(f"{order} was ended: {ended}")


def _watched(
    box: RunningBox, before: BoxStatus, axes: Sequence[str], patience: int = TAKEN_LOOKS, begins: int = 0
) -> tuple[BoxStatus, str]:
    """The status when these axes stand and have nothing to do, or when another sender has the antenna.

    And what the box calls this command; empty: it was never seen to move the antenna. `before`: the status before the
    order. The box gives each connection a new name, so who moved the antenna then is not this command. `begins`: the
    looks until an order that has no target, and so does not show before it, must have begun.
    """
    still, ours, begun = 0, "", False
    with _row() as show:
        while True:
            status = box.status()
            mover = str(status["moved_by"] or "")
            if (ours and mover != ours) or (status["stopped_by"] and not status["storm_park"]):
                return status, ours
            ours = mover if mover.startswith(CONSOLE) and mover != before["moved_by"] else ours
            busy = any(_is_busy(status[axis]) for axis in axes)
            begun, still = begun or busy, 0 if busy else still + 1
            if still >= (patience if begun else max(patience, begins)):
                return status, ours
            show("   ".join(_progress(status, axis) for axis in axes))
            time.sleep(LOOK_S)


def _is_busy(axis: BoxStatus) -> bool:
    on_its_way = axis["target_deg"] is not None and not axis["at_target"] and not axis["fault"]
    return bool(axis["moving"] or axis["homing"] or on_its_way)


def _progress(status: BoxStatus, axis: str) -> str:
    now = status[axis]
    angle = "---" if now["angle_deg"] is None else f"{now['angle_deg']:.1f}°"
    target = "" if now["target_deg"] is None else f" to {now['target_deg']:.1f}°"
    return f"{axis} {angle}{target}" + (" FAULT" if now["fault"] else "")


@contextmanager
def _row() -> Iterator[Callable[[str], None]]:
    """One row of a terminal that is written over; nothing where the errors go to no terminal."""
    shown = draws(sys.stderr)

    def show(text: str) -> None:
        if shown:
            click.echo(f"\r\x1b[K{text[: columns(err=True)]}", nl=False, err=True)

    try:
        yield show
    finally:
        show("")


@contextmanager
def _stops_on_ctrl_c(path: Path | None) -> Iterator[None]:
    """Ctrl-C meanwhile stops the antenna. Raises CommandFailed then."""
    try:
        yield
    except KeyboardInterrupt:
        _stop(path)
        raise CommandFailed(f"Ctrl-C. {STOPPED}") from None


@contextmanager
def _stops_unless_done(path: Path | None) -> Iterator[None]:
    """Every end but the expected one, and the box's own refusal, stops the antenna: a box that does not answer, too."""
    try:
        with _stops_on_ctrl_c(path):
            yield
    except Refused:
        raise
    except CommandFailed as fault:
        if STOPPED in str(fault):
            raise
        _stop(path)
        raise CommandFailed(f"{fault}. {STOPPED}") from None


def _stop(path: Path | None) -> None:
    """On a connection of its own: an answer may be under way on the other. Raises CommandFailed."""
    # A second Ctrl-C must not interrupt the stop.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        stop_boxes(consoles(path), all_of_them=path is None)
    except NoBox:
        raise CommandFailed(ENDED) from None
