"""MQTT's part of the composition root: from `[mqtt]` to a thread that is not started yet.

Knows the parts and the arguments of each. Does not speak with a broker.
"""

from __future__ import annotations

import hashlib
import re
import socket
from contextlib import suppress
from pathlib import Path

from rotator.config.model import Config
from rotator.config.mqtt import EVERY_BOX, PREFIX, MqttTable
from rotator.control.sky.mount import Mount
from rotator.exchange.sources import MQTT, Source
from rotator.mqtt.desk import Desk
from rotator.mqtt.thread import MqttThread
from rotator.mqtt.topics import Topics
from rotator.protocols.operating import Operating
from rotator.protocols.session import Tracking
from rotator.protocols.status_object import as_object
from rotator.runtime.client import Client
from rotator.runtime.loop import ControlLoop


def build_mqtt(config: Config, loop: ControlLoop, mount: Mount, tracking: Tracking | None) -> MqttThread | None:
    """None: the configuration has no broker."""
    table = config.mqtt
    if table.broker is None:
        return None
    source = Source(MQTT)
    client = Client(loop, mount, source)
    desk = Desk(Operating(client, tracking, source), table.may)
    return MqttThread(table, topics_of(table), desk, status=lambda: as_object(loop.status), left=client.left)


def topics_of(table: MqttTable) -> Topics:
    """A topic of the file alone is the whole beginning, as before boxes had names."""
    if table.topic and not table.box:
        return Topics(table.topic)
    prefix = table.topic or PREFIX
    return Topics(f"{prefix}/{table.box or _machine()}", f"{prefix}/{EVERY_BOX}/stop")


def _machine() -> str:
    """The machine's name; where it is the one that every new system has, with four digits of this system's own."""
    name = re.sub(r"[^A-Za-z0-9_-]", "_", socket.gethostname().partition(".")[0])
    with suppress(OSError):
        if name in ("raspberrypi", "localhost", EVERY_BOX):
            # The machine's id itself must not be published: see machine-id(5).
            own = hashlib.sha256(b"gs232-rotator mqtt" + Path("/etc/machine-id").read_bytes().strip())
            return f"{name}-{own.hexdigest()[:4]}"
    return name
