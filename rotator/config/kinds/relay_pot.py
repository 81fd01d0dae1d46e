"""`rotor.type = "relay-pot"`: motors on relays, a pot on a converter for each angle. The G-5500 is one.

Knows the lines of its table [relays], and the answers of this kind to the questions in `kind.py`. Knows no driver, and
not the converter: its table [adc] serves pots of every kind of rotor.
"""

from __future__ import annotations

from dataclasses import dataclass

from hw.ports import AngleSource
from rotator.config.angle import Angle
from rotator.config.devices import Relays
from rotator.config.kinds.kind import Kind, OffLine


@dataclass(frozen=True, slots=True)
class RelayPot(Kind):
    relays: Relays

    switched = True
    own = Angle(AngleSource.MEASURED, in_degrees=False, pot=True)

    def pins(self) -> list[tuple[int, str]]:
        return [(pin, f"relays.{key}") for key, pin in self.relays.outputs.items()]

    def off_lines(self) -> tuple[OffLine, ...]:
        return relay_lines(self.relays)


def relay_lines(relays: Relays) -> tuple[OffLine, ...]:
    """The relays, the master, and the heartbeat. A heartbeat is off when it stands still, at either level."""
    off_high = relays.active == "low"
    lines = [OffLine(key, f"relays.{key}", pin, off_high) for key, pin in relays.contacts.items()]
    if relays.heartbeat is not None:
        lines.append(OffLine("heartbeat", "relays.heartbeat", relays.heartbeat, switches=False))
    return tuple(lines)
