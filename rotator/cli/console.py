"""The work of the commands that use the console of the running box: connect, confirm with the user, send, print.

Knows the form of the console's answers. The box decides whether it obeys. `home` also waits for the end, and stops the
antenna if it is interrupted.
"""

from __future__ import annotations

import signal
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Self

import click

from hw.ports import Axis
from rotator.cli.reach import monitors, reach
from rotator.cli.stop import STOPPED
from rotator.config.places import console_path
from rotator.links.wire import LinkError
from rotator.orders import Confirm, Home, LetGo, RelaysChecked, Release, Stop
from rotator.protocols.console import Ask, ConsoleCommand, encode
from rotator.protocols.console_session import ERROR, OK
from rotator.protocols.panel_words import Hand

ANSWER_S = 5.0
"""The longest wait for an answer, in seconds."""
LOOK_S = 0.25
"""The time between two looks at a homing axis, in seconds."""
STANDING_LOOKS = 12
"""The axis has stopped for good after more looks than this without a turn. Pauses within a homing are shorter."""
CONSOLE = "console"
"""The prefix of a console user's name in a status."""

Lines = list[tuple[str, str]]
"""The lines of a status: (name, value)."""


class Refused(LinkError):  # noqa: N818 - the box's answer, no failure of the program
    """The box refuses the order. The text says why."""


class ConsoleClient:
    """One connection to the console. Raises ConfigError; LinkError when no box answers."""

    def __init__(self, path: Path | None) -> None:
        self._box = reach([console_path(each) for each in monitors(path)], "console")
        self._box.settimeout(ANSWER_S)
        self._answers = self._box.makefile(encoding="utf-8", errors="replace", newline="\n")

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._answers.close()
        self._box.close()

    def send(self, command: ConsoleCommand) -> list[str]:
        """Send an order or a question. Returns the lines of the answer. Raises Refused, LinkError."""
        return self.line(encode(command))

    def line(self, line: bytes) -> list[str]:
        """Send one line. Returns the lines of the answer before its `ok`. Raises Refused, LinkError."""
        answers: list[str] = []
        try:
            self._box.sendall(line)
            while (answer := self._answers.readline()).endswith("\n"):
                answer = answer.rstrip("\n")
                if answer == OK:
                    return answers
                if answer.startswith(ERROR):
                    raise Refused(answer.removeprefix(ERROR))
                answers.append(answer)
        except TimeoutError:
            raise LinkError("the box does not answer") from None
        except OSError:
            pass
        raise LinkError("the box has ended")

    def status(self) -> Lines:
        return [(name, value) for name, _, value in (line.partition(": ") for line in self.send(Ask.STATUS))]


def tell(path: Path | None, words: Sequence[str]) -> None:
    """Send words to the console and print the answer. Without words: print the list of its words."""
    line = " ".join(" ".join(words).split()) or Ask.HELP.value
    with ConsoleClient(path) as box:
        for answer in box.line(line.encode("utf-8", "replace") + b"\n") or [OK]:
            click.echo(answer)


def where(path: Path | None) -> None:
    with ConsoleClient(path) as box:
        for line in box.send(Ask.STATUS):
            click.echo(line)


def stop(path: Path | None) -> None:
    with ConsoleClient(path) as box:
        box.send(Stop(latch=True))
    click.echo(STOPPED)


def resume(path: Path | None) -> None:
    with ConsoleClient(path) as box:
        box.send(Release())
    click.echo("The antenna may move again.")


def let_go(path: Path | None, *, yes: bool) -> None:
    with ConsoleClient(path) as box:
        _ask("Without torque an antenna that is out of balance turns. Let go of both axes?", yes=yes)
        box.send(LetGo())
    click.echo("The motors are without torque. Nothing moves until `rotator resume`.")


def confirm(path: Path | None, axis: Axis, angle_deg: float) -> None:
    with ConsoleClient(path) as box:
        box.send(Confirm(axis, angle_deg))
    click.echo(f"{axis.value} stands at {angle_deg:g}°.")


def relays_checked(path: Path | None, axis: Axis, *, yes: bool) -> None:
    with ConsoleClient(path) as box:
        question = (
            f"With both relays of {axis.value} switched off: does its motor have no current, from either of them?"
        )
        _ask(question, yes=yes)
        box.send(RelaysChecked(axis))
    click.echo(f"The relays of {axis.value} count as open. Acknowledge the fault with `rotator resume`.")


def hand(path: Path | None, move: Hand) -> None:
    """Move a part of the simulated panel. Raises Refused where there is none."""
    with ConsoleClient(path) as box:
        box.send(move)


def home(path: Path | None, axis: Axis, *, yes: bool) -> None:
    """Home an axis, and return when it stands. Any other end stops the antenna. Raises LinkError if it is not homed."""
    for signum in (signal.SIGTERM, signal.SIGHUP):
        # A closed terminal means that the user no longer watches: the same as Ctrl-C.
        signal.signal(signum, signal.default_int_handler)
    with ConsoleClient(path) as box:
        _ask(f"Watch the antenna: {axis.value} turns to its low end. Ctrl-C stops it. Begin?", yes=yes)
        over = False
        try:
            box.send(Home(axis))
            lines = _until_it_stands(box, axis)
            over = True
        except Refused:
            over = True
            raise
        except KeyboardInterrupt:
            raise LinkError(f"{axis.value} is not homed") from None
        finally:
            if not over:
                # A second Ctrl-C must not interrupt the stop.
                signal.signal(signal.SIGINT, signal.SIG_IGN)
                stop(path)
    for name, value in lines:
        if name in ("fault", "missing") and value.startswith(axis.value):
            raise LinkError(value)
        if name == "moved by" and not value.startswith(CONSOLE):
            raise LinkError(f"{axis.value} is not homed: {value} moves the antenna")
    click.echo(f"{axis.value} stands: {dict(lines)[axis.value]}")


def _until_it_stands(box: ConsoleClient, axis: Axis) -> Lines:
    """Wait until the axis stands, or until another source moves it. Returns the last status.

    Shows the angle meanwhile: in a terminal on one row, else line by line while the axis turns.
    """
    row = sys.stdout.isatty()
    still, ours = 0, False
    try:
        while True:
            lines = box.status()
            values = dict(lines)
            turns = axis.value in values.get("moving", "").split()
            still = 0 if turns else still + 1
            before, ours = ours, values["moved by"].startswith(CONSOLE)
            if still > STANDING_LOOKS or (before and not ours):
                return lines
            if turns or row:
                text = f"{axis.value} {values[axis.value]}"
                click.echo(f"\r\x1b[K{text}" if row else text, nl=not row)
            time.sleep(LOOK_S)
    finally:
        if row:
            click.echo()


def _ask(question: str, *, yes: bool) -> None:
    if yes:
        return
    try:
        click.confirm(question, abort=True)
    except click.Abort:
        raise LinkError("nothing was done (--yes does it without asking)") from None
