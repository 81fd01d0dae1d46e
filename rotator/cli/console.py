"""The commands that speak to the running box over its console: the questions before, and what is shown afterwards.

Knows the console's words and answers. Does not know whether the box will obey.
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
from rotator.cli.reach import monitor_places, reach
from rotator.links.console import console_path
from rotator.links.wire import LinkError
from rotator.orders import Confirm, Home, LetGo, Release, Stop
from rotator.protocols.console import Ask, ConsoleCommand, encode
from rotator.protocols.console_session import ERROR, OK

ANSWER_S = 5.0
LOOK_S = 0.25
STANDING_LOOKS = 12
"""Between two turns of a homing the axis stands, for fewer looks than this."""
CONSOLE = "console"
"""How the status names the users of the console."""

Lines = list[tuple[str, str]]
"""The lines of a status: a name and a value each."""


class Refused(LinkError):  # noqa: N818 - the box's answer, no failure of the program
    """The box refuses the order. The text says why."""


class ConsoleClient:
    """One connection to the console. Raises ConfigError; LinkError when no box answers."""

    def __init__(self, path: Path | None) -> None:
        self._box = reach([console_path(each) for each in monitor_places(path)], "console")
        self._box.settimeout(ANSWER_S)
        self._answers = self._box.makefile(encoding="utf-8", errors="replace", newline="\n")

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._answers.close()
        self._box.close()

    def send(self, said: ConsoleCommand) -> list[str]:
        """Send an order or a question. Returns the lines of the answer. Raises Refused, LinkError."""
        return self.line(encode(said))

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
        return [(what, how) for what, _, how in (line.partition(": ") for line in self.send(Ask.STATUS))]


def tell(path: Path | None, words: Sequence[str]) -> None:
    """Send words to the console. Without words: ask which words it knows."""
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
    click.echo("Stopped. Nothing moves until `rotator resume`.")


def resume(path: Path | None) -> None:
    with ConsoleClient(path) as box:
        box.send(Release())
    click.echo("Whoever may move the antenna can do so again.")


def let_go(path: Path | None, *, yes: bool) -> None:
    with ConsoleClient(path) as box:
        _ask("Without torque an antenna that is out of balance turns. Let go of both axes?", yes=yes)
        box.send(LetGo())
    click.echo("The motors are without torque. Nothing moves until `rotator resume`.")


def confirm(path: Path | None, axis: Axis, angle_deg: float) -> None:
    with ConsoleClient(path) as box:
        box.send(Confirm(axis, angle_deg))
    click.echo(f"{axis.value} stands at {angle_deg:g}°.")


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
    for what, how in lines:
        if what in ("fault", "missing") and how.startswith(axis.value):
            raise LinkError(how)
        if what == "moved by" and not how.startswith(CONSOLE):
            raise LinkError(f"{axis.value} is not homed: {how} moves the antenna")
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
            said = dict(lines)
            turns = axis.value in said.get("moving", "").split()
            still = 0 if turns else still + 1
            before, ours = ours, said["moved by"].startswith(CONSOLE)
            if still > STANDING_LOOKS or (before and not ours):
                return lines
            if turns or row:
                text = f"{axis.value} {said[axis.value]}"
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
