"""The senders of orders: their names, which of them are persons, and why an order of theirs is refused.

Knows links, connections and the addresses of other machines. Does not know the orders, nor who may give which:
`control/rights.py` knows that.
"""

from __future__ import annotations

from dataclasses import dataclass, field

PAGE = "page"
"""The page of the box: each of its paired browsers is a connection of this link."""
CONSOLE, PANEL = "console", "panel"
KEYBOARD = "keyboard"
"""The keys of `rotator run`, the space bar among them."""
PERSONS = (CONSOLE, KEYBOARD, PANEL, "calibrate", PAGE)
"""The links of persons at the box, in a source. No link of the configuration has one of these names."""
MQTT = "mqtt"
"""The broker of [mqtt], as the link of a source. It counts as one program, even if many use the broker."""
TRACKER = "track"
"""The tracker, which follows a target for a person, as the link of a source."""


@dataclass(frozen=True, slots=True)
class Source:
    """The sender of an order: a link, and the connection on it. A reconnect is a new source."""

    link: str
    connection: int = 0
    host: str = field(default="", compare=False)
    """The address of the machine at the other end; empty: not known, or no network."""

    @property
    def is_person(self) -> bool:
        """Whether a person gives these orders: at the console, at the panel, on the page, in a calibration."""
        return self.link in PERSONS

    @property
    def holds(self) -> bool:
        """Whether this person's motion holds the antenna until it is given back: on the page a person may look away."""
        return self.link == PAGE

    @property
    def may_be_held_off(self) -> bool:
        """Whether its orders have no effect while a person holds the antenna: programs, and the page of another."""
        return self.link == PAGE or not (self.is_person or self.link == TRACKER)

    def __str__(self) -> str:
        return f"{self.link}#{self.connection}" if self.connection else self.link


@dataclass(frozen=True, slots=True)
class Refusal:
    """Why an order is refused, for the log. The protocol answers in its own words."""

    reason: str
    forbidden: bool = False
    """Whether the sender may give no orders at all."""
    faulty: bool = False
    """Whether an axis that the order needs is stopped by a fault."""
    out_of_range: bool = False
    """Whether the order has an angle outside a range. A tracking program repeats such an order for a long time."""
