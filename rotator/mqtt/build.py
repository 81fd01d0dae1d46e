"""MQTT's part of the composition root: from `[mqtt]` to a thread that is not started yet.

Knows the parts and the arguments of each. Does not speak with a broker.
"""

from __future__ import annotations

from rotator.config.links import address
from rotator.config.model import Config
from rotator.control.sky.mount import Mount
from rotator.exchange.sources import MQTT, Source
from rotator.mqtt.desk import Desk
from rotator.mqtt.thread import Broker, MqttThread
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
    return MqttThread(
        Broker(*address(table.broker), table.user, table.password, table.tls),
        Topics(table.topic),
        Desk(Operating(client, tracking, source), table.may),
        may=table.may,
        announces=table.discovery,
        status=lambda: as_object(loop.status),
        left=client.left,
    )
