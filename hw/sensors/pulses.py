"""Where an axis is by counting the closures of a cam contact: rotors of the Alliance U-100 kind.

Knows two streams of moments, what the relays were told and what the contact did, and puts them in order of time. What
they mean is `hw.sensors.cam_count`'s business. Reads no relay and drives none.
"""

from __future__ import annotations

import copy
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass

from hw.drives.relays import RELAYS
from hw.ports import AngleSource, Axis, ContactChange, ContactInput, Direction, HardwareError, OutputLines
from hw.sensors.cam import Cam
from hw.sensors.cam_count import CamCount

DEBOUNCE_SHARE = 0.6
"""The debounce must be over well before the contact changes again."""


@dataclass(frozen=True, slots=True)
class _Driven:
    at_s: float
    direction: Direction


class TappedLines:
    """The motor relays' lines, with a note of every change and its moment: who counts must know exactly.

    It stands between the relay bank and the lines, so that nothing is switched unheard: commands that expire, `off` of
    another thread, a supply that is cut.
    """

    def __init__(self, lines: OutputLines, clock: Callable[[], float]) -> None:
        self._lines = lines
        self._clock = clock
        self._on: set[str] = set()
        self._heard: dict[Axis, deque[_Driven]] = {axis: deque() for axis in Axis}
        self._last = dict.fromkeys(Axis, Direction.OFF)

    def set(self, levels: dict[str, bool]) -> None:
        self._lines.set(levels)
        now_s = self._clock()
        for name, on in levels.items():
            (self._on.add if on else self._on.discard)(name)
        for axis in Axis:
            fed = [way for way in (Direction.PLUS, Direction.MINUS) if RELAYS[axis, way] in self._on]
            direction = fed[0] if fed else Direction.OFF
            if direction is not self._last[axis]:
                self._last[axis] = direction
                self._heard[axis].append(_Driven(now_s, direction))

    def close(self) -> None:
        self._lines.close()

    def heard(self, axis: Axis) -> list[_Driven]:
        """What has been switched on this axis since this was asked the last time. For one listener an axis."""
        heard = self._heard[axis]
        return [heard.popleft() for _ in range(len(heard))]


class PulseCounter:
    """One axis. `read` is in degrees already; before the first `place` it counts from an arbitrary angle.

    `clock` is the kernel's monotonic time. Raises HardwareError where the debounce would swallow whole closures.
    """

    source = AngleSource.COUNTED

    def __init__(
        self,
        axis: Axis,
        contact: ContactInput,
        lines: TappedLines,
        cam: Cam,
        clock: Callable[[], float],
        *,
        debounce_s: float = 0.02,
    ) -> None:
        if debounce_s > DEBOUNCE_SHARE * cam.shortest_s:
            raise HardwareError(
                f"{axis.value}: a debounce of {debounce_s * 1000:.0f} ms swallows closures that last "
                f"{cam.shortest_s * 1000:.0f} ms: make it shorter, or correct closed_deg"
            )
        self._axis = axis
        self._contact = contact
        self._lines = lines
        self._clock = clock
        self._debounce_s = debounce_s
        self._count = CamCount(cam)
        self._waiting: list[_Driven | ContactChange] = []
        self._count.place(clock(), cam.closes_at_deg, closed=contact.closed())
        self._count.trouble = "its place has not been told yet"

    def read(self) -> float:
        now_s = self._clock()
        self._waiting += self._lines.heard(self._axis)
        self._waiting += [
            ContactChange(change.at_s - self._debounce_s, change.closed, change.lost)
            for change in self._contact.changes()
        ]
        self._waiting.sort(key=lambda event: event.at_s)
        # A change is told when its debounce is over. What is older than that has all been told.
        settled_s = now_s - self._debounce_s
        while self._waiting and self._waiting[0].at_s <= settled_s:
            self._take(self._count, self._waiting.pop(0))
        self._count.advance(settled_s)
        ahead = copy.copy(self._count)
        for event in self._waiting:
            if isinstance(event, _Driven):
                ahead.drive(event.at_s, event.direction)
        ahead.advance(now_s)
        return ahead.angle_deg()

    def place(self, angle_deg: float) -> bool:
        """The axis stands at that angle: a count that was kept, or an end stop. False: the contact contradicts.

        Only at rest. Whatever was counted before is forgotten. Raises HardwareError.
        """
        self.read()
        return self._count.place(self._clock() - self._debounce_s, angle_deg, closed=self._contact.closed())

    @property
    def changes(self) -> int:
        """How often the contact has changed so far: half of them are pulses."""
        return self._count.changes

    @property
    def at_rest(self) -> bool:
        """No relay is on, and it has stopped coasting."""
        return self._count.at_rest and not self._waiting

    @property
    def zone(self) -> int:
        """The cam's zone, counted."""
        return self._count.zone

    @property
    def trouble(self) -> str:
        """Why the count is not to be relied on until the axis is homed; empty: it is right."""
        return self._count.trouble

    @property
    def closed(self) -> bool:
        """Whether the contact is closed now, from any thread. Raises HardwareError."""
        return self._contact.closed()

    @property
    def turning(self) -> bool:
        """It runs at its speed though no relay is on."""
        return self._count.turning

    @property
    def quiet(self) -> bool:
        """Driven for three periods without a pulse."""
        return self._count.quiet

    @staticmethod
    def _take(count: CamCount, event: _Driven | ContactChange) -> None:
        match event:
            case _Driven(at_s, direction):
                count.drive(at_s, direction)
            case ContactChange(at_s, closed, lost):
                count.change(at_s, closed=closed, lost=lost)
