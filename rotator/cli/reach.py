"""Connects a command to a socket of the running box.

Knows where the socket may be: at the path of the configuration, beside the state file, or in the service's folder.
Knows the error texts. Does not know what goes over the sockets.
"""

from __future__ import annotations

import os
import socket
from collections.abc import Sequence
from pathlib import Path

from rotator.config.load import load
from rotator.links.wire import LinkError
from rotator.monitor.places import monitor_path

MONITOR_OF_THE_SERVICE = Path("/run/rotator/monitor")


def monitor_places(path: Path | None) -> list[Path]:
    """The paths at which the box with this configuration may have its monitor. Raises ConfigError."""
    config = load(path)
    beside = monitor_path(config, os.environ)
    return [beside] if config.monitor.path else [beside, MONITOR_OF_THE_SERVICE]


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
