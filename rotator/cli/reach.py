"""Finds the running box, and connects to its sockets.

Knows the two keys of the configuration that say where the sockets are, and reads them without the model: a command
that stops or asks must be quick, and its box may have been started before a mistake came into the file. Only where the
keys cannot be read is the whole file checked, for the error text. Does not know what goes over the sockets.
"""

from __future__ import annotations

import os
import socket
import tomllib
from collections.abc import Callable, Sequence
from importlib.resources import files
from pathlib import Path

from rotator.cli.failed import CommandFailed
from rotator.config.places import INSTALLED, STATE, console_path, monitor_places


def monitors(path: Path | None) -> list[Path]:
    """The paths at which the box with this configuration may have its monitor. Raises ConfigError."""
    if places := quick_monitors(path):
        return places
    from rotator.config.load import load  # noqa: PLC0415 - slow, and rarely needed

    config = load(path)
    return monitor_places(config.state.path, config.monitor.path, os.environ)


def quick_monitors(path: Path | None) -> list[Path]:
    """The same without the model; empty: the keys cannot be read."""
    try:
        tables = tomllib.loads(_text(path))
        state, monitor = tables.get("state", {}).get("path", STATE), tables.get("monitor", {}).get("path")
    except (OSError, ValueError, AttributeError):
        return []
    usual = isinstance(state, str) and isinstance(monitor, str | None)
    return monitor_places(state, monitor, os.environ) if usual else []


def consoles(path: Path | None) -> list[Path]:
    """The paths at which it may have its console. Raises ConfigError."""
    return [console_path(place) for place in monitors(path)]


def reach(path: Path | None, places: Callable[[Path | None], Sequence[Path]]) -> socket.socket:
    """Connect to the box. `places`: `monitors` or `consoles`. Raises CommandFailed, ConfigError.

    With a file, its own box comes before the service. Without one, two boxes that run are one too many: an order for
    one antenna must not turn the other.
    """
    tried = places(path)
    found = [(place, box) for place in tried if (box := connected(place))]
    if not found:
        raise no_box(tried)
    for _, other in found[1:]:
        other.close()
    (place, box), *others = found
    if others and path is None:
        box.close()
        raise CommandFailed(
            f"two boxes run: one started in this folder ({place}), and the service. For the service add "
            f"--config {INSTALLED}; for the other end the service first: sudo systemctl stop rotator"
        )
    return box


def connected(place: Path) -> socket.socket | None:
    """A connection to the box that listens there; None: no box does. Raises CommandFailed where it may not be asked."""
    box = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
    try:
        box.connect(str(place))
        return box
    except PermissionError:
        box.close()
        raise CommandFailed(f"you may not use {place}: use sudo, or join its group") from None
    except OSError:
        box.close()
    return None


def no_box(tried: Sequence[Path]) -> CommandFailed:
    places = " or ".join(map(str, tried))
    return CommandFailed(
        f"no box runs here: nothing answers at {places}. Start it with `rotator run`, or name its file with --config"
    )


def _text(path: Path | None) -> str:
    """Raises OSError, UnicodeDecodeError."""
    if path is None:
        return (files("rotator.config") / "simulated.toml").read_text(encoding="utf-8")
    return path.read_text(encoding="utf-8-sig")
