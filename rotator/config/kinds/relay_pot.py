"""`rotor.type = "relay-pot"`: motors on relays, a pot on a converter for each angle. The G-5500 is one.

Knows what its tables [relays] and [adc] mean for the rest of the program. Knows no driver.
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
    """The relays, the master, and the heartbeat: that one is off when it stands still, at either level."""
    off_high = relays.active == "low"
    lines = [OffLine(key, f"relays.{key}", pin, off_high) for key, pin in relays.contacts.items()]
    if relays.heartbeat is not None:
        lines.append(OffLine("heartbeat", "relays.heartbeat", relays.heartbeat, switches=False))
    return tuple(lines)
