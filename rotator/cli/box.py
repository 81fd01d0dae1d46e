"""The running box as a command sees it: one connection to its console, orders in words, and its status as an object.

Knows the form of the console's answers (`rotator.protocols.console_session`), and loads nothing of the box itself, for
its commands must be quick. The box decides whether it obeys.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, Self

from rotator.cli.failed import CommandFailed
from rotator.cli.reach import consoles, reach
from rotator.exchange.foreign import json_of

LOOK_S = 0.02
ANSWER_S = 5.0
"""The longest wait for an answer, in seconds."""
OK, ERROR = "ok", "error: "
ENDED = "the box has ended"
AXES = ("azimuth", "elevation")

BoxStatus = dict[str, Any]
"""The fields of `rotator.protocols.status_object`."""


class Refused(CommandFailed):
    """The box refuses the order. The text says why."""


class DoesNotAnswer(CommandFailed):
    """The box runs, and stands still. The text says how long it was asked."""


class RunningBox:
    """One connection to the console; `sockets`: where it may be. Raises CommandFailed when no box answers;
    ConfigError."""

    def __init__(self, path: Path | None, sockets: Callable[[Path | None], Sequence[Path]] = consoles) -> None:
        self._box = reach(path, sockets)
        self._box.settimeout(ANSWER_S)
        self._answers = self._box.makefile(encoding="utf-8", errors="replace", newline="\n")

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._answers.close()
        self._box.close()

    def order(self, words: str) -> list[str]:
        """Send one line. Returns the lines of the answer before its `ok`. Raises Refused, CommandFailed."""
        answers: list[str] = []
        try:
            self._box.sendall(" ".join(words.split()).encode("utf-8", "replace") + b"\n")
            while (answer := self._answers.readline()).endswith("\n"):
                answer = answer.rstrip("\n")
                if answer == OK:
                    return answers
                if answer.startswith(ERROR):
                    raise Refused(answer.removeprefix(ERROR))
                answers.append(answer)
        except TimeoutError:
            raise DoesNotAnswer(f"the box does not answer within {ANSWER_S:g} s") from None
        except OSError:
            pass
        raise CommandFailed(ENDED)

    def done(self, words: str) -> list[str]:
        """The same, and return when the box has acted on it: what is asked next, by any program, is told so."""
        answers = self.order(words)
        until_s = time.monotonic() + ANSWER_S
        # A box that runs since before an update does not say it.
        while self.status().get("orders_wait"):
            if time.monotonic() > until_s:
                raise DoesNotAnswer(f"the box has the order, and has done nothing with it for {ANSWER_S:g} s")
            time.sleep(LOOK_S)
        return answers

    def status(self) -> BoxStatus:
        (line,) = self.order("status json")
        return dict(json_of(line))


def fitted(status: BoxStatus) -> list[str]:
    """The axes that the rotor has."""
    return [axis for axis in AXES if status[axis]["fitted"]]


def faults(status: BoxStatus, axes: Sequence[str] = AXES) -> list[str]:
    """The faults of these axes, each as a sentence."""
    return [str(status[axis]["fault"]["text"]) for axis in axes if status[axis]["fault"]]


def all_stand(status: BoxStatus) -> str:
    """Where the antenna is, in a few words."""
    return ", ".join(stands(status, axis) for axis in fitted(status))


def stands(status: BoxStatus, axis: str) -> str:
    """The same of one axis."""
    now = status[axis]
    if now["angle_deg"] is None:
        return f"{axis} not known"
    source = now["angle_source"] if now["angle_is_current"] else "when last seen, no reading now"
    return f"{axis} {now['angle_deg']:.1f}° {source}"


def typed(number: float) -> str:
    """A number as the console reads it, and as a person would type it."""
    return f"{number:.4f}".rstrip("0").rstrip(".")
