"""What a message on a topic makes the box do, and what it does not."""

from __future__ import annotations

import json
import re
from typing import Any

import hypothesis.strategies as st
import pytest
from hypothesis import given
from pydantic import ValidationError

from rotator.config.mqtt import MqttTable
from rotator.exchange.orders import Aim, Order, Park, Stop
from rotator.exchange.sources import MQTT, Refusal, Source
from rotator.exchange.status import AxisStatus, Status
from rotator.mqtt.build import topics_of
from rotator.mqtt.desk import LONGEST, Desk
from rotator.mqtt.topics import Topics, discovery
from rotator.protocols.methods import METHODS
from rotator.protocols.operating import Operating
from tests.tables import every_row

AT_REST = Status(0.0, AxisStatus(0, 450, 0.0), AxisStatus(0, 180, 0.0))
POINT = b'{"azimuth_deg": 200, "elevation_deg": 30}'


class Box:
    """Takes orders, and does nothing with them."""

    def __init__(self, status: Status = AT_REST) -> None:
        self.orders: list[Order] = []
        self._status = status

    def status(self) -> Status:
        return self._status

    def note_refused(self, _refused: Refusal | bytes) -> None:
        """Nobody reads the log here."""

    def order(self, order: Order) -> Refusal | None:
        self.orders.append(order)
        return None


def desk(box: Box, may: str = "move") -> Desk:
    return Desk(Operating(box, None, Source(MQTT)), may)


def test_a_message_is_the_method_of_the_page() -> None:
    box = Box()
    assert desk(box).do("point", POINT, kept=False) == {"method": "point", "ok": True}
    assert box.orders == [Aim(200.0, 30.0)]


@every_row("payload", [b"", b"PRESS", b" ", b"no JSON", b"[1]", b"\xff"])
def test_a_stop_counts_whatever_the_message_says(payload: bytes) -> None:
    box = Box()
    assert desk(box, "stop").do("stop", payload, kept=False)["ok"] is True
    assert box.orders == [Stop(latch=True)]


def test_a_button_of_home_assistant_is_a_message_without_values() -> None:
    box = Box()
    assert desk(box).do("park", b"PRESS", kept=False)["ok"] is True
    assert box.orders == [Park(storm=True)]


@every_row("name", [method.name for method in METHODS])
def test_a_message_that_the_broker_has_kept_orders_nothing(name: str) -> None:
    box = Box()
    answer = desk(box).do(name, POINT, kept=True)
    assert answer["error"] == "the broker has kept this message: send it without retain"
    assert box.orders == []


@pytest.mark.parametrize(("may", "obeys"), [("look", set()), ("stop", {"stop"})])
def test_what_may_only_look_or_stop_does_no_more(may: str, obeys: set[str]) -> None:
    assert set(desk(Box(), may).methods) == obeys, "so many topics does it subscribe"
    for method in METHODS:
        box = Box()
        answer = desk(box, may).do(method.name, POINT, kept=False)
        assert answer["ok"] is (method.name in obeys), method.name
        assert bool(box.orders) is (method.name in obeys)


@every_row(
    ("name", "payload", "says"),
    [
        ("fly", b"", "there is no method 'fly': stop, resume"),
        ("point", b"", "point needs azimuth_deg"),
        ("point", b"{", "the message must be a JSON object"),
        ("point", b"[]", "the message must be a JSON object"),
        ("point", b"{" * 5000, "no message has more than"),
        ("point", b"[" * LONGEST, "the message must be a JSON object"),
        ("point", b'{"azimuth_deg": true, "elevation_deg": 1}', "azimuth_deg must be a number from -360 to 720"),
        ("point", b'{"azimuth_deg": 1, "elevation_deg": 1, "speed": 3}', "point has no value 'speed'"),
        ("track", b'{"target": ""}', "target must be a text"),
        ("jog", b'{"turn": "left", "seconds": 1}', "turn must be one of cw, ccw, up, down"),
        ("jog", b'{"turn": "cw", "seconds": 600}', "seconds must be a number from 0.05 to 5"),
    ],
)
def test_a_mistake_says_what_to_send_instead(name: str, payload: bytes, says: str) -> None:
    box = Box()
    assert says in desk(box).do(name, payload, kept=False)["error"]
    assert box.orders == []


@given(st.text(max_size=20), st.binary(max_size=200))
def test_any_message_is_answered(name: str, payload: bytes) -> None:
    assert isinstance(desk(Box()).do(name, payload, kept=False)["ok"], bool)


def found(may: str) -> dict[str, Any]:
    return {topic: json.loads(text or "null") for topic, text in discovery(Topics("shack/rotator"), may)}


def test_home_assistant_gets_only_buttons_that_do_something_and_forgets_the_others() -> None:
    assert [topic for topic, said in found("stop").items() if "/button/" in topic and said] == [
        "homeassistant/button/shack_rotator/stop/config"
    ]
    assert None not in found("move").values()


def test_an_axis_that_is_not_fitted_is_no_entity() -> None:
    said = dict(discovery(Topics("shack/rotator"), "move", ["azimuth"]))
    assert said["homeassistant/sensor/shack_rotator/elevation/config"] == ""
    assert json.loads(said["homeassistant/sensor/shack_rotator/azimuth/config"])["name"] == "Azimuth"


def test_each_entity_has_an_id_of_its_own_and_topics_of_the_box() -> None:
    said = found("move")
    assert len({each["unique_id"] for each in said.values()}) == len(said)
    for topic, each in said.items():
        assert each["availability_topic"] == "shack/rotator/availability"
        # Home Assistant warns of object_id since 2025.10, and drops it.
        assert "object_id" not in each
        _, kind, box, name, _ = topic.split("/")
        assert each["default_entity_id"] == f"{kind}.{box}_{name}"
        assert {each.get("state_topic"), each.get("command_topic")} & {
            "shack/rotator/status",
            f"shack/rotator/do/{topic.split('/')[-2]}",
        }


def test_the_method_of_a_topic_is_its_last_word() -> None:
    topics = Topics("shack/rotator")
    assert topics.method(topics.order("point")) == "point"


@pytest.mark.parametrize(
    ("keys", "base", "stops_all"),
    [
        ({"topic": "rotator"}, "rotator", None),
        ({"topic": "shack/north"}, "shack/north", None),
        ({"box": "north"}, "rotator/north", "rotator/all/stop"),
        ({"box": "north", "topic": "shack"}, "shack/north", "shack/all/stop"),
    ],
)
def test_a_topic_of_the_file_stays_as_it_was_and_a_name_has_its_own(
    keys: dict[str, str], base: str, stops_all: str | None
) -> None:
    topics = topics_of(MqttTable.model_validate({"broker": "127.0.0.1:1883"} | keys))
    assert (topics.base, topics.stops_all) == (base, stops_all)
    assert topics.orders(["stop", "park"])[:2] == [f"{base}/do/stop", f"{base}/do/park"]
    assert topics.orders(["stop"])[1:] == ([stops_all] if stops_all else [])
    assert topics.orders(["park"]) == [f"{base}/do/park"]
    assert stops_all is None or topics.method(stops_all) == "stop"


def test_without_either_the_machine_s_name_keeps_two_boxes_apart() -> None:
    topics = topics_of(MqttTable(broker="127.0.0.1:1883"))
    assert re.fullmatch(r"rotator/[A-Za-z0-9_-]+", topics.base)
    assert topics.base not in ("rotator/raspberrypi", "rotator/localhost", "rotator/all")


@every_row(
    ("keys", "says"),
    [
        ({"box": "all"}, '"all" is the name of every box: take another'),
        ({"box": "north/1"}, '"north/1" must be a word of letters, digits, - and _'),
        ({"box": "#"}, '"#" must be a word of letters, digits, - and _'),
        ({"box": ""}, '"" must be a word of letters, digits, - and _'),
        ({"topic": "+"}, '"+" must be words of letters'),
        ({"ca_file": "x"}, "ca_file goes with tls = true"),
        ({"cert_file": "x"}, "cert_file goes with tls = true"),
        ({"key_file": "x", "tls": True}, "key_file goes with cert_file"),
    ],
)
def test_keys_that_cannot_be_say_so(keys: dict[str, Any], says: str) -> None:
    with pytest.raises(ValidationError, match=re.escape(says)):
        MqttTable.model_validate({"broker": "127.0.0.1:1883"} | keys)
