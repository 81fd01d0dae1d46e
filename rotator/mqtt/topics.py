"""The topics of the box and the messages on them, and the description of the box for Home Assistant.

Knows names and values. Does not know a broker, nor the effect of a method.
"""

from __future__ import annotations

import json
import re
from collections.abc import Collection, Iterable, Iterator
from dataclasses import dataclass
from typing import Any

from rotator import __version__

ONLINE, OFFLINE = "online", "offline"
PREFIX = "homeassistant"
"""The topic on which Home Assistant searches for devices."""
_ANGLE = {"unit_of_measurement": "°", "state_class": "measurement", "suggested_display_precision": 1}
_SENSORS: dict[str, dict[str, Any]] = {
    "azimuth": {"name": "Azimuth", "value_template": "{{ value_json.azimuth.angle_deg }}", "icon": "mdi:compass"},
    "elevation": {
        "name": "Elevation", "value_template": "{{ value_json.elevation.angle_deg }}", "icon": "mdi:angle-acute",
    },
}  # fmt: skip
_EITHER = "{{{{ 'ON' if value_json.azimuth.{0} or value_json.elevation.{0} else 'OFF' }}}}"
_BINARY: dict[str, dict[str, Any]] = {
    "moving": {"name": "Moving", "value_template": _EITHER.format("moving"), "device_class": "moving"},
    "fault": {"name": "Fault", "value_template": _EITHER.format("fault"), "device_class": "problem"},
    "stopped": {"name": "Stopped", "value_template": "{{ 'ON' if value_json.stopped_by else 'OFF' }}"},
}
_BUTTONS = {
    "stop": ("Stop", "mdi:stop-circle", ("stop", "move")),
    "resume": ("Let it move again", "mdi:play-circle", ("move",)),
    "park": ("Park", "mdi:parking", ("move",)),
}
"""For each method: its name, its picture, and the rights that it needs."""


@dataclass(frozen=True, slots=True)
class Topics:
    """`base`: the first words of each topic. `stops_all`: the topic of a stop for every box; None: there is none."""

    base: str
    stops_all: str | None = None

    @property
    def status(self) -> str:
        return f"{self.base}/status"

    @property
    def availability(self) -> str:
        return f"{self.base}/availability"

    @property
    def answer(self) -> str:
        return f"{self.base}/answer"

    def orders(self, methods: Iterable[str]) -> list[str]:
        """The topics that the box listens to, where messages may do this."""
        found = {method: self.order(method) for method in methods}
        return [*found.values(), *([self.stops_all] if self.stops_all and "stop" in found else [])]

    def method(self, topic: str) -> str:
        """The name of the method of a message on this topic."""
        return "stop" if topic == self.stops_all else topic.removeprefix(f"{self.base}/do/")

    def order(self, method: str) -> str:
        return f"{self.base}/do/{method}"


def discovery(topics: Topics, may: str, axes: Collection[str] = tuple(_SENSORS)) -> Iterator[tuple[str, str]]:
    """Topics and messages by which Home Assistant finds the antenna. `may`: as in [mqtt]. `axes`: those that the rotor
    has.
    """
    box = re.sub(r"[^A-Za-z0-9_-]", "_", topics.base)
    device = {"identifiers": [box], "name": "Antenna rotator", "model": "gs232-rotator", "sw_version": __version__}
    common = {"availability_topic": topics.availability, "device": device, "origin": {"name": "gs232-rotator"}}

    def entity(kind: str, name: str, fields: dict[str, Any]) -> tuple[str, str]:
        whole = {**fields, "unique_id": f"{box}_{name}", "default_entity_id": f"{kind}.{box}_{name}".lower(), **common}
        return f"{PREFIX}/{kind}/{box}/{name}/config", json.dumps(whole, ensure_ascii=False)

    for name, fields in _SENSORS.items():
        if name in axes:
            yield entity("sensor", name, {**fields, **_ANGLE, "state_topic": topics.status})
        else:
            yield f"{PREFIX}/sensor/{box}/{name}/config", ""
    for name, fields in _BINARY.items():
        yield entity("binary_sensor", name, {**fields, "state_topic": topics.status})
    for method, (name, icon, rights) in _BUTTONS.items():
        if may in rights:
            yield entity("button", method, {"name": name, "icon": icon, "command_topic": topics.order(method)})
        else:
            # Remove what an earlier start, with more rights or another rotor, has told.
            yield f"{PREFIX}/button/{box}/{method}/config", ""
