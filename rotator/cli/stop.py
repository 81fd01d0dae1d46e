"""`rotator stop`: stops the antenna without loading the rest of the program, not even the command line's parser.

A person who calls it sees the antenna run into something, and the whole program takes a second to load on a Pi. Without
a file it stops the box of this folder, the service, and this user's other boxes; for root every user's. A stop counts
also with more words behind it. Where an option or the file is unusual, it leaves the command to the slow way, which has
the error texts.
"""

from __future__ import annotations

import socket
from collections.abc import Sequence
from pathlib import Path

from rotator.cli.failed import CommandFailed
from rotator.cli.reach import connected, named, no_box, quick_monitors, with_announced
from rotator.config.places import console_path

STOP = b"stop\n"
"""The console's command."""
OK = b"ok\n"
ANSWER_S = 5.0
STOPPED = "Stopped. Nothing moves until `rotator resume`."


def stop_at_once(arguments: Sequence[str]) -> str:
    """`arguments`: those after `stop`. Returns what to say once it has stopped; empty: nothing has happened yet.

    Raises CommandFailed: there is no box, or it has not obeyed.
    """
    match arguments:
        case ["--config", name, *words]:
            path: Path | None = Path(name)
        case words:
            path = None
    if any(word.startswith("-") for word in words):
        return ""
    usual = quick_monitors(path)
    if not usual:
        return ""
    return stop_boxes([console_path(place) for place in with_announced(usual, path)], all_of_them=path is None)


def stop_boxes(places: Sequence[Path], *, all_of_them: bool) -> str:
    """Stop the box at the first of `places` where one answers, or the boxes at all of them. Returns what to say: of
    several boxes, which. Raises CommandFailed."""
    stopped: list[Path] = []
    failed: list[str] = []
    for place in places:
        try:
            if _stop(place):
                stopped.append(place)
        except CommandFailed as fault:
            failed.append(str(fault))
        if stopped and not all_of_them:
            return STOPPED
    if failed:
        also = f"; stopped: {_named(stopped)}" if stopped else ""
        raise CommandFailed(f"NOT STOPPED: {'; '.join(failed)}{also}")
    if not stopped:
        raise no_box(places)
    return STOPPED if len(stopped) == 1 else f"{STOPPED}\n{len(stopped)} boxes: {_named(stopped)}."


def _named(stopped: Sequence[Path]) -> str:
    return "; ".join(named(stopped))


def _stop(place: Path) -> bool:
    """Returns whether a box is there. Raises CommandFailed where it does not obey."""
    box = connected(place)
    if box is None:
        return False
    with box:
        answer = _answer(box)
    if answer != OK:
        raise CommandFailed(f"the box at {place}: {answer.decode('utf-8', 'replace').strip()}")
    return True


def _answer(box: socket.socket) -> bytes:
    """Up to its newline, or why none came."""
    answer = b""
    try:
        box.settimeout(ANSWER_S)
        box.sendall(STOP)
        while not answer.endswith(b"\n") and (received := box.recv(4096)):
            answer += received
    except TimeoutError:
        return f"it does not answer within {ANSWER_S:g} s".encode()
    except OSError:
        pass
    return answer or b"it has ended"
