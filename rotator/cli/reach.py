"""Connects a command to a socket of the running box.

Knows the error texts. Does not know what goes over the sockets.
"""

from __future__ import annotations

import os
import socket
from collections.abc import Sequence
from pathlib import Path

from rotator.config.load import load
from rotator.config.places import monitor_places
from rotator.links.wire import LinkError


def monitors(path: Path | None) -> list[Path]:
    """The paths at which the box with this configuration may have its monitor. Raises ConfigError."""
    config = load(path)
    return monitor_places(config.state.path, config.monitor.path, os.environ)


def reach(places: Sequence[Path], what: str) -> socket.socket:
    """Connect to the first of `places` where a box listens. `what`: the socket's name in an error. Raises LinkError."""
    for place in places:
        box = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        try:
            box.connect(str(place))
            return box
        except PermissionError:
            box.close()
            raise LinkError(f"you may not use {place}: use sudo, or join its group") from None
        except OSError:
            box.close()
    tried = " or ".join(map(str, places))
    raise LinkError(f"no box is running with a {what} at {tried}: start it, or name its file with --config")
