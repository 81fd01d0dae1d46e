"""The thread that speaks with the broker: it logs in, sends the status, passes messages on, and tries again.

Knows the library and the connection. No other part of the box waits for it. When the broker is lost no message can
come, so motion that a message began without an end is ended.
"""

from __future__ import annotations

import json
import logging
import ssl
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from rotator.links.wire import Wire, reason
from rotator.mqtt.desk import Desk
from rotator.mqtt.topics import OFFLINE, ONLINE, Topics, discovery

if TYPE_CHECKING:
    from paho.mqtt.client import Client

log = logging.getLogger(__name__)

MQTT_THREAD = "mqtt"
LOOK_S, TELL_EVERY_S = 0.1, 1.0
KEEP_ALIVE_S = 15
CONNECT_S = 5.0
ANSWERED_S = 10.0
"""Seconds: longest wait for the broker's answer to the login."""
FIRST_WAIT_S, LONGEST_WAIT_S = 1.0, 60.0
JOIN_S = 2.0
NO_LIBRARY = (
    "[mqtt] needs paho-mqtt: on a Pi run sudo ./install.sh again; beside make run, .venv/bin/pip install paho-mqtt"
)


@dataclass(frozen=True, slots=True)
class Broker:
    host: str
    port: int
    user: str | None
    password: str | None
    tls: bool


class MqttThread:
    """`status` gives the status to send, as an object. `desk` carries out messages. `left`: called when the connection
    has ended."""

    def __init__(
        self,
        broker: Broker,
        topics: Topics,
        desk: Desk,
        *,
        may: str,
        announces: bool,
        status: Callable[[], Any],
        left: Callable[[], None],
    ) -> None:
        self._broker = broker
        self._topics = topics
        self._desk = desk
        self._may = may
        self._announces = announces
        self._status = status
        self._left = left
        self.wire = Wire(MQTT_THREAD, MQTT_THREAD, f"{broker.host}:{broker.port}")
        self._stopping = threading.Event()
        self._thread = threading.Thread(target=self._run, name=MQTT_THREAD, daemon=True)
        self._let_in = False
        self._refused = ""
        self._trouble = ""
        """Why the last connection failed. The log has each new reason once."""

    def start(self) -> None:
        self.wire.state = "connecting"
        self._thread.start()

    def stop(self) -> None:
        """Returns when the thread has ended, or hangs."""
        self._stopping.set()
        if self._thread.is_alive():
            self._thread.join(JOIN_S)
        self.wire.state = "closed"

    def _run(self) -> None:
        try:
            from paho.mqtt.client import Client  # noqa: F401, PLC0415 - an extra
        except ImportError:
            log.warning(NO_LIBRARY)
            self.wire.state = "closed"
            return
        wait_s = FIRST_WAIT_S
        while not self._stopping.is_set():
            try:
                self._connection()
            except Exception as fault:
                self._complain(fault)
            finally:
                if self._let_in:
                    wait_s = FIRST_WAIT_S
                    self._left()
            self.wire.state = "waiting for it"
            self._stopping.wait(wait_s)
            wait_s = min(2 * wait_s, LONGEST_WAIT_S)

    def _complain(self, fault: Exception) -> None:
        why = reason(fault) if isinstance(fault, OSError) else str(fault)
        if why != self._trouble:
            log.warning("mqtt: %s: %s; it is tried again", self.wire.where, why)
        self._trouble = why

    def _connection(self) -> None:
        """From the login to the end of the connection. Raises OSError, and what the library raises."""
        client = self._new_client()
        self._let_in, self._refused = False, ""
        client.connect(self._broker.host, self._broker.port, keepalive=KEEP_ALIVE_S)
        begun_s = sent_s = time.monotonic()
        sent = ""
        while not self._stopping.is_set():
            if (result := client.loop(LOOK_S)) != 0:
                raise ConnectionError(self._refused or f"the connection was lost ({result.name})")
            now_s = time.monotonic()
            if not self._let_in:
                if now_s - begun_s > ANSWERED_S:
                    raise ConnectionError("it does not let the box in")
            elif not sent or now_s - sent_s >= TELL_EVERY_S:
                sent, sent_s = self._send(client, sent), now_s
        if self._let_in:
            client.publish(self._topics.availability, OFFLINE, retain=True)
            client.loop(LOOK_S)
        client.disconnect()
        client.loop(LOOK_S)

    def _send(self, client: Client, sent: str) -> str:
        """Send the status if it has changed. Returns the status that was sent last."""
        text = json.dumps(self._status(), ensure_ascii=False)
        if text != sent:
            client.publish(self._topics.status, text, retain=True)
        return text

    def _new_client(self) -> Client:
        from paho.mqtt.client import Client  # noqa: PLC0415 - an extra
        from paho.mqtt.enums import CallbackAPIVersion  # noqa: PLC0415

        # A clean session at QoS 0: the broker keeps no order for a box that is away.
        client = Client(CallbackAPIVersion.VERSION2, clean_session=True, reconnect_on_failure=False)
        client.connect_timeout = CONNECT_S
        client.username_pw_set(self._broker.user, self._broker.password)
        if self._broker.tls:
            client.tls_set_context(ssl.create_default_context())
        client.will_set(self._topics.availability, OFFLINE, retain=True)
        client.on_connect = self._on_connect
        client.on_message = self._on_message
        return client

    def _on_connect(self, client: Client, _data: object, _flags: object, code: Any, _properties: object) -> None:
        if code.is_failure:
            self._refused = f"it refuses the box: {code}"
            return
        self._let_in, self._trouble = True, ""
        self.wire.state = "connected"
        log.info("mqtt: %s: connected", self.wire.where)
        client.subscribe(self._topics.orders, qos=0)
        client.publish(self._topics.availability, ONLINE, retain=True)
        for topic, text in discovery(self._topics, self._may) if self._announces else ():
            client.publish(topic, text, retain=True)

    def _on_message(self, client: Client, _data: object, message: Any) -> None:
        self.wire.came(message.payload[:200])
        answer = self._desk.do(self._topics.method(message.topic), message.payload, kept=message.retain)
        client.publish(self._topics.answer, json.dumps(answer, ensure_ascii=False))
