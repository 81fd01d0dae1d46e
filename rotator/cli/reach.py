"""Finds the running box, and connects to its sockets.

Knows the two keys of the configuration that say where the sockets are, and reads them without the model: a command
that stops or asks must be quick, and its box may have been started before a mistake came into the file. Only where the
keys cannot be read is the whole file checked, for the error text. Does not know what goes over the sockets.
"""

from __future__ import annotations

import os
import socket
from collections.abc import Callable, Sequence
from importlib.resources import files
from pathlib import Path

from rotator.cli.announced import boxes
from rotator.cli.failed import CommandFailed, NoBox
from rotator.config import places
from rotator.config.places import INSTALLED, STATE, console_path, monitor_places
from rotator.exchange.foreign import toml_of
from rotator.links.unix import short
from rotator.store.plain import read_plain


def monitors(path: Path | None) -> list[Path]:
    """The paths at which the box with this configuration may have its monitor. Raises ConfigError.

    The sockets of a box stand in the folder in which it was started. With a file: the box that runs with this file,
    wherever that is. Without: the box of this folder, the service, and then this user's other boxes.
    """
    if usual := quick_monitors(path):
        return with_announced(usual, path)
    from rotator.config.load import load  # noqa: PLC0415 - slow, and rarely needed

    config = load(path)
    return with_announced(monitor_places(config.state.path, config.monitor.path, os.environ), path)


def quick_monitors(path: Path | None) -> list[Path]:
    """The same places without the model of the configuration. Empty: the keys cannot be read, and no running box was
    started with this file."""
    try:
        tables = toml_of(_text(path))
        state, monitor = tables.get("state", {}).get("path", STATE), tables.get("monitor", {}).get("path")
    except (OSError, ValueError, AttributeError):
        return _started_with(path)
    usual = isinstance(state, str) and (monitor is None or (isinstance(monitor, str) and bool(Path(monitor).name)))
    return monitor_places(state, monitor, os.environ) if usual else _started_with(path)


def _started_with(path: Path | None) -> list[Path]:
    """The boxes that run with a file that has a mistake now, or is gone: they can be stopped all the same."""
    if path is None:
        return []
    file, service = path.resolve(), places.MONITOR_OF_THE_SERVICE
    running = [box.monitor for box in boxes() if box.config == file]
    return [*running, service] if file == INSTALLED and service.exists() else running


def with_announced(usual: Sequence[Path], path: Path | None) -> list[Path]:
    """These paths, and those of the boxes that this user has started in other folders."""
    running = boxes()
    if path is not None:
        file = path.resolve()
        return list(dict.fromkeys((*(box.monitor for box in running if box.config == file), *usual)))
    here = {place.absolute() for place in usual}
    return [*usual, *(box.monitor for box in running if box.monitor not in here)]


def consoles(path: Path | None) -> list[Path]:
    """The paths at which it may have its console. Raises ConfigError."""
    return [console_path(place) for place in monitors(path)]


def reach(path: Path | None, sockets: Callable[[Path | None], Sequence[Path]]) -> socket.socket:
    """Connect to the box. `sockets`: `monitors` or `consoles`. Raises CommandFailed, ConfigError.

    With a file, its own box comes before the service. Without one, the service and another box are one too many: an
    order for one antenna must not turn the other. So are two boxes in other folders.
    """
    tried = sockets(path)
    found = [(place, box) for place in tried if (box := connected(place))]
    if not found:
        raise no_box(tried)
    for _, other in found[1:]:
        other.close()
    (place, box), *others = found
    if path is None:
        rivals = [other for other, _ in others if place != tried[0] or other in _of_the_service()]
        if rivals:
            box.close()
            names = named((place, *rivals), tried[0])
            raise CommandFailed(
                f"{len(names)} boxes run: {'; '.join(names)}. Say which: name its file with --config, or go into its "
                "folder"
            )
    return box


def _of_the_service() -> tuple[Path, Path]:
    return places.MONITOR_OF_THE_SERVICE, console_path(places.MONITOR_OF_THE_SERVICE)


def named(running: Sequence[Path], here: Path | None = None) -> list[str]:
    """The boxes with these sockets, as a person finds them. `here`: the socket of the box of this folder."""
    names = {} if here is None else {here: "the box of this folder"}
    names |= {socket_path: each.named for each in boxes() for socket_path in (each.monitor, console_path(each.monitor))}
    names |= dict.fromkeys(_of_the_service(), f"the service (--config {INSTALLED})")
    return [names.get(place, str(place)) for place in running]


def connected(place: Path) -> socket.socket | None:
    """A connection to the box that listens there; None: no box does. Raises CommandFailed where it may not be asked."""
    box = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
    try:
        with short(place) as name:
            box.connect(name)
        return box
    except PermissionError:
        box.close()
        raise CommandFailed(f"you may not use {place}: use sudo, or join its group") from None
    except OSError:
        box.close()
    return None


def no_box(tried: Sequence[Path]) -> NoBox:
    where = " or ".join(map(str, tried))
    return NoBox(
        f"no box runs here: nothing answers at {where}. Start it with `rotator run`, or name its file with --config"
    )


def _text(path: Path | None) -> str:
    """Raises OSError, UnicodeDecodeError."""
    if path is None:
        return (files("rotator.config") / "simulated.toml").read_text(encoding="utf-8")
    return read_plain(path).decode("utf-8-sig")
