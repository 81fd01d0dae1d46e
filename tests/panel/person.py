"""A person at the front panel with time in hand: what they throw, turn and press, and what is ordered then."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

import pytest

from hw.ports import AngleSource, Axis, Direction
from rotator.exchange.orders import Mode, Order, SetMode
from rotator.exchange.status import AxisStatus, Status
from rotator.panel.ladder import level
from rotator.panel.panel import Panel, PanelInputs, PanelOutput, PanelSettings

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
PLUS, MINUS, OFF = Direction.PLUS, Direction.MINUS, Direction.OFF
LOOK_S = 0.05
about: Any = pytest.approx
"""An angle in an order that is compared, to a float's last digits."""
MANUAL, PARK, AUTO, JOG = (False, False), (False, True), (True, False), (True, True)
BITS = {MANUAL: Mode.MANUAL, PARK: Mode.PARK, AUTO: Mode.AUTO, JOG: Mode.JOG}
STILL = Status(
    0.0, AxisStatus(0.0, 360.0, angle_deg=90.0, source=AngleSource.COUNTED), AxisStatus(0.0, 180.0, angle_deg=45.0)
)
LATCHED = replace(STILL, latched="panel")
CENTRE, CW, CCW, UP, DOWN = (level(way) for way in ((OFF, OFF), (PLUS, OFF), (MINUS, OFF), (OFF, PLUS), (OFF, MINUS)))
CW_AND_UP = level((PLUS, PLUS))


@dataclass
class Person:
    """At the panel, with time in hand."""

    panel: Panel = field(default_factory=lambda: Panel(PanelSettings()))
    look: PanelInputs = field(
        default_factory=lambda: PanelInputs(mode_bits=AUTO, jog=CENTRE, azimuth_knob=0.0, elevation_knob=0.0)
    )
    status: Status = STILL
    looks: int = 0
    act: PanelOutput = field(default_factory=lambda: PanelOutput((), {}, {}))

    def sees(self, **parts: object) -> list[Order]:
        """One step of the panel, with these inputs changed."""
        self.look = replace(self.look, **parts)  # type: ignore[arg-type]
        self.looks += 1
        self.act = self.panel.step(100.0 + self.looks * LOOK_S, self.look, self.status)
        return list(self.act.orders)

    def waits(self, seconds: float, **parts: object) -> list[Order]:
        """What is ordered meanwhile."""
        return [order for _ in range(round(seconds / LOOK_S)) for order in self.sees(**parts)]

    def lit(self) -> set[str]:
        return {name for name, on in self.act.lamps.items() if on}


def at_the_panel(bits: tuple[bool, bool], settings: PanelSettings | None = None) -> Person:
    """With the mode set, and every switch released."""
    person = Person(Panel(settings or PanelSettings()))
    assert person.waits(1.5, mode_bits=bits) == [SetMode(BITS[bits])]
    return person


def presses(person: Person, share: float, count: int) -> list[Order]:
    return [order for _ in range(count) for jog in (CENTRE, share, CENTRE) for order in person.waits(0.15, jog=jog)]
