"""`rotator stop`, at once: it connects to the console and stops the antenna without loading the rest of the program.

A person who calls it sees the antenna run into something, and the whole program takes a second to load on a Pi. Knows
the two keys of the configuration that say where the console is. Does not check the file: where anything is unusual,
it leaves the command to the slow way, which has the error texts.
"""

from __future__ import annotations

import os
import socket
import tomllib
from collections.abc import Sequence
from importlib.resources import files
from pathlib import Path

from rotator.config.places import STATE, console_path, monitor_places

STOP = b"stop\n"
"""The console's command."""
OK = b"ok\n"
ANSWER_S = 5.0
STOPPED = "Stopped. Nothing moves until `rotator resume`."


def stop_at_once(arguments: Sequence[str]) -> bool:
    """`arguments`: those after `stop`. Returns whether a box has stopped; False: nothing has happened yet."""
    match arguments:
        case []:
            text = (files("rotator.config") / "simulated.toml").read_text(encoding="utf-8")
        case ["--config", name]:
            try:
                text = Path(name).read_text(encoding="utf-8-sig")
            except (OSError, ValueError):
                return False
        case _:
            return False
    return any(_stop(console_path(place)) for place in _places(text))


def _places(text: str) -> list[Path]:
    try:
        tables = tomllib.loads(text)
        return monitor_places(
            str(tables.get("state", {}).get("path", STATE)), tables.get("monitor", {}).get("path"), os.environ
        )
    except (ValueError, AttributeError, TypeError):
        return []


def _stop(place: Path) -> bool:
    try:
        with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as box:
            box.settimeout(ANSWER_S)
            box.connect(str(place))
            box.sendall(STOP)
            answer = b""
            while not answer.endswith(b"\n") and (received := box.recv(4096)):
                answer += received
    except OSError:
        return False
    return answer == OK
