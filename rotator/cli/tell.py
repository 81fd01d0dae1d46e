"""What a person says to the running box, over its console: the questions asked first, and what is shown afterwards.

Knows the console's words and answers. Whether the box obeys is the box's.
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
"""Homing stands between its turns, for less than this many looks."""
CONSOLE = "console"
"""How the box calls those who speak to it here."""

Lines = list[tuple[str, str]]
"""What the box says of itself: what, and how."""


class Refused(LinkError):  # noqa: N818 - the box's answer, no failure of the program
    """The box has heard it, and says why not."""


class Talk:
    """One connection to the console. Raises ConfigError; LinkError, where no box answers."""

    def __init__(self, path: Path | None) -> None:
        self._box = reach([console_path(each) for each in monitor_places(path)], "console")
        self._box.settimeout(ANSWER_S)
        self._answers = self._box.makefile(encoding="utf-8", errors="replace", newline="\n")

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._answers.close()
        self._box.close()

    def say(self, said: ConsoleCommand) -> list[str]:
        return self.line(encode(said))

    def line(self, line: bytes) -> list[str]:
        """The lines of the answer before its `ok`. Raises Refused, LinkError."""
        told: list[str] = []
        try:
            self._box.sendall(line)
            while (answer := self._answers.readline()).endswith("\n"):
                answer = answer.rstrip("\n")
                if answer == OK:
                    return told
                if answer.startswith(ERROR):
                    raise Refused(answer.removeprefix(ERROR))
                told.append(answer)
        except TimeoutError:
            raise LinkError("the box does not answer") from None
        except OSError:
            pass
        raise LinkError("the box has ended")

    def status(self) -> Lines:
        return [(what, how) for what, _, how in (line.partition(": ") for line in self.say(Ask.STATUS))]


def tell(path: Path | None, words: Sequence[str]) -> None:
    """Anything the console knows. Without words: what that is."""
    line = " ".join(" ".join(words).split()) or Ask.HELP.value
    with Talk(path) as box:
        for told in box.line(line.encode("utf-8", "replace") + b"\n") or [OK]:
            click.echo(told)


def where(path: Path | None) -> None:
    with Talk(path) as box:
        for told in box.say(Ask.STATUS):
            click.echo(told)


def stop(path: Path | None) -> None:
    with Talk(path) as box:
        box.say(Stop(latch=True))
    click.echo("Stopped. Nothing moves until `rotator resume`.")


def resume(path: Path | None) -> None:
    with Talk(path) as box:
        box.say(Release())
    click.echo("Whoever may move the antenna can do so again.")


def let_go(path: Path | None, *, yes: bool) -> None:
    with Talk(path) as box:
        _ask("Without torque an antenna that is out of balance turns. Let go of both axes?", yes=yes)
        box.say(LetGo())
    click.echo("The motors are without torque. Nothing moves until `rotator resume`.")


def confirm(path: Path | None, axis: Axis, angle_deg: float) -> None:
    with Talk(path) as box:
        box.say(Confirm(axis, angle_deg))
    click.echo(f"{axis.value} stands at {angle_deg:g}°.")


def home(path: Path | None, axis: Axis, *, yes: bool) -> None:
    """Ends when the axis stands. Whatever else ends it stops the antenna. Raises LinkError where it is not homed."""
    for signum in (signal.SIGTERM, signal.SIGHUP):
        # The person who watches has gone: as good as Ctrl-C.
        signal.signal(signum, signal.default_int_handler)
    with Talk(path) as box:
        _ask(f"Watch the antenna: {axis.value} turns to its low end. Ctrl-C stops it. Begin?", yes=yes)
        over = False
        try:
            box.say(Home(axis))
            lines = _until_it_stands(box, axis)
            over = True
        except Refused:
            over = True
            raise
        except KeyboardInterrupt:
            raise LinkError(f"{axis.value} is not homed") from None
        finally:
            if not over:
                # A second Ctrl-C is not to keep the first one from being heard.
                signal.signal(signal.SIGINT, signal.SIG_IGN)
                stop(path)
    for what, how in lines:
        if what in ("fault", "missing") and how.startswith(axis.value):
            raise LinkError(how)
        if what == "moved by" and not how.startswith(CONSOLE):
            raise LinkError(f"{axis.value} is not homed: {how} moves the antenna")
    click.echo(f"{axis.value} stands: {dict(lines)[axis.value]}")


def _until_it_stands(box: Talk, axis: Axis) -> Lines:
    """Or until somebody else has it. Shows where it is: in a terminal on one row, else line by line while it turns."""
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
