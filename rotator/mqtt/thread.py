"""The thread that speaks with the broker: it logs in, sends the status, passes messages on, and tries again.

Knows the library and the connection. No other part of the box waits for it. When the broker is lost no message can
come, so motion that a message began without an end is ended.
"""

from __future__ import annotations

import json
import logging
import ssl
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from rotator.config.links import address
from rotator.config.mqtt import MqttTable
from rotator.links.wire import Wire, reason
from rotator.mqtt.desk import LONGEST, Desk
from rotator.mqtt.topics import OFFLINE, ONLINE, Topics, discovery
from rotator.runtime.own_thread import OwnThread

if TYPE_CHECKING:
    from rotator.mqtt.bounded import BoundedClient, TooLong

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


class MqttThread(OwnThread):
    """`table` names a broker. `status` gives the status to send, as an object. `desk` carries out messages. `left`:
    called when the connection has ended."""

    def __init__(
        self,
        table: MqttTable,
        topics: Topics,
        desk: Desk,
        *,
        status: Callable[[], Any],
        left: Callable[[], None],
    ) -> None:
        super().__init__(MQTT_THREAD, JOIN_S)
        self._table = table
        self._host, self._port = address(table.broker or "")
        self._topics = topics
        self._desk = desk
        self._status = status
        self._left = left
        self.wire = Wire(MQTT_THREAD, MQTT_THREAD, f"{self._host}:{self._port}")
        self._let_in = False
        self._refused = ""
        self._trouble = ""
        """Why the last connection failed. The log has each new reason once."""
        self._told: set[str] = set()
        """What the log has of messages that are too long. Their topics are few: those that were subscribed."""
        self._kept_too_long: set[str] = set()
        """The topics on which the broker keeps such a message."""

    def start(self) -> None:
        self.wire.state = "connecting"
        super().start()

    def stop(self) -> None:
        """Returns when the thread has ended, or hangs."""
        super().stop()
        self.wire.state = "closed"

    def _run(self) -> None:
        wait_s = FIRST_WAIT_S
        while not self._stopping.is_set():
            try:
                self._connection()
            except ImportError:
                log.warning(NO_LIBRARY)
                self.wire.state = "closed"
                return
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
        why = _why(fault)
        if why != self._trouble:
            log.warning("mqtt: %s: %s; it is tried again", self.wire.where, why)
        self._trouble = why

    def _connection(self) -> None:
        """From the login to the end of the connection. Raises OSError, and what the library raises."""
        client = self._new_client()
        self._let_in, self._refused = False, ""
        client.connect(self._host, self._port, keepalive=KEEP_ALIVE_S)
        begun_s = sent_s = time.monotonic()
        sent = ""
        while not self._stopping.is_set():
            if (result := client.loop(LOOK_S)) != 0:
                if client.too_long:
                    self._hang_up(client.too_long)
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

    def _hang_up(self, message: TooLong) -> None:
        """Raises ConnectionError. A stop counts with any content. A topic that keeps this is not subscribed again."""
        why = f"a message on {message.topic[:100]!a} is too long to be read"
        if message.kept:
            why += ", and the broker keeps it: from now on no order is taken there; empty it, and start the box again"
            self._kept_too_long.add(message.topic)
        else:
            self._desk.do(self._topics.method(message.topic), bytes(LONGEST + 1), kept=False)
        if why in self._told:
            self._trouble = why
        self._told.add(why)
        raise ConnectionError(why)

    def _send(self, client: BoundedClient, sent: str) -> str:
        """Send the status if it has changed. Returns the status that was sent last."""
        text = json.dumps(self._status(), ensure_ascii=False)
        if text != sent:
            client.publish(self._topics.status, text, retain=True)
        return text

    def _new_client(self) -> BoundedClient:
        """Raises ImportError, OSError."""
        from rotator.mqtt.bounded import BoundedClient  # noqa: PLC0415 - its library is an extra

        client = BoundedClient()
        client.connect_timeout = CONNECT_S
        client.username_pw_set(self._table.user, self._table.password)
        if self._table.tls:
            client.tls_set_context(_context(self._table))
        client.will_set(self._topics.availability, OFFLINE, retain=True)
        client.on_connect = self._on_connect
        client.on_message = self._on_message
        return client

    def _on_connect(self, client: Any, _data: object, _flags: object, code: Any, _properties: object) -> None:
        if code.is_failure:
            self._refused = f"it refuses the box: {code}"
            return
        self._let_in, self._trouble = True, ""
        self.wire.state = "connected"
        log.info("mqtt: %s: connected, as %s", self.wire.where, self._topics.base)
        for topic in self._topics.orders(self._desk.methods):
            if topic not in self._kept_too_long:
                client.subscribe(topic, qos=0)
        client.publish(self._topics.availability, ONLINE, retain=True)
        if not self._table.discovery:
            return
        status = self._status()
        axes = [axis for axis in ("azimuth", "elevation") if status[axis]["fitted"]]
        for topic, text in discovery(self._topics, self._table.may, axes):
            client.publish(topic, text, retain=True)

    def _on_message(self, client: Any, _data: object, message: Any) -> None:
        self.wire.came(message.payload[:200])
        answer = self._desk.do(self._topics.method(message.topic), message.payload, kept=message.retain)
        client.publish(self._topics.answer, json.dumps(answer, ensure_ascii=False))


def _context(table: MqttTable) -> ssl.SSLContext:
    """Raises OSError with the name of the key."""
    try:
        key = "ca_file"
        made = ssl.create_default_context(cafile=table.ca_file)
        if table.cert_file is not None:
            key = "cert_file, key_file"
            made.load_cert_chain(table.cert_file, table.key_file, password="")  # else it would ask the terminal
    except OSError as fault:
        raise OSError(f"{key}: {_why(fault)}") from fault
    return made


def _why(fault: Exception) -> str:
    match fault:
        case ssl.SSLCertVerificationError():
            return f"its certificate is not good: {fault.verify_message} (ca_file names the authority that signed it)"
        case ssl.SSLError():
            return f"TLS: {(fault.reason or str(fault)).lower().replace('_', ' ')}"
        case OSError(errno=int()):
            return reason(fault)
        case _:
            return str(fault)
