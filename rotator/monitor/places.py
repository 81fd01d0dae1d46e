"""The path of the monitor's socket, for the box that opens it and for the commands that connect to it.

Knows the configuration and the folder of the service manager. Opens no socket.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from rotator.config.model import Config
from rotator.runtime.service_manager import runtime_folder


def monitor_path(config: Config, environment: Mapping[str, str]) -> Path:
    """The key monitor.path; else `monitor` in the service manager's folder, or beside the state file without one."""
    beside = runtime_folder(environment) or Path(config.state.path).parent
    return Path(config.monitor.path) if config.monitor.path else beside / "monitor"
