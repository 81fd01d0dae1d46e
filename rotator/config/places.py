"""Where the files and the sockets of a running box are, for the box and for the commands that connect to it.

Knows names and folders. Imports nothing of the model, for `rotator stop` must not wait for it. Opens nothing.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

STATE = "run/state.json"
"""The state file, where the configuration names none."""
INSTALLED = Path("/etc/rotator/rotator.toml")
"""The service's configuration file."""
MONITOR = "monitor"
MONITOR_OF_THE_SERVICE = Path("/run/rotator/monitor")
STATE_OF_THE_SERVICE = Path("/var/lib/rotator")
"""The folder of the service's state file."""


def runtime_folder(environment: Mapping[str, str]) -> Path | None:
    """The folder that the service manager has made for this run; None without a service manager."""
    folder = environment.get("RUNTIME_DIRECTORY", "").split(":")[0]
    return Path(folder) if folder else None


def memory_folder(state: str, config: Path | None, environment: Mapping[str, str]) -> Path | None:
    """The folder in memory with what a card has refused, the same for all programs that use these files; None: none.

    `state`: the key state.path. `config`: the configuration file. A command that a person starts has no service
    manager, and yet must know the stop that the service has kept there.
    """
    if folder := runtime_folder(environment):
        return folder
    service = config is not None and config.resolve() == INSTALLED
    return MONITOR_OF_THE_SERVICE.parent if service or Path(state).absolute().parent == STATE_OF_THE_SERVICE else None


def monitor_path(state: str, monitor: str | None, environment: Mapping[str, str]) -> Path:
    """The monitor's socket: the key monitor.path; else in the service manager's folder, or beside the state file.

    `state` and `monitor`: the keys state.path and monitor.path.
    """
    if monitor:
        return Path(monitor)
    return (runtime_folder(environment) or Path(state).parent) / MONITOR


def monitor_places(state: str, monitor: str | None, environment: Mapping[str, str]) -> list[Path]:
    """Where a command looks for the monitor of a box with these keys: the box may run as the service."""
    own = monitor_path(state, monitor, environment)
    return [own] if monitor else [own, MONITOR_OF_THE_SERVICE]


def console_path(monitor: Path) -> Path:
    """The console's path: in the folder of the monitor's socket, with a name made from the monitor's name."""
    return monitor.with_name("console" if monitor.name == MONITOR else f"{monitor.name}-console")
