"""The angle of an axis by counting the closures of a cam contact: rotors of the Alliance U-100 kind.

Knows two streams of events, changes of the motor relays and changes of the contact, and puts them in order of time.
Does not know what they mean: `hw.sensors.cam_count` does. It never changes a level of a relay itself.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass

from hw.drives.relays import RELAYS
from hw.ports import AngleSource, Axis, ContactChange, ContactInput, Direction, HardwareError, OutputLines
from hw.sensors.cam import Cam
from hw.sensors.cam_count import CamCount

DEBOUNCE_SHARE = 0.6
"""The debounce may take at most this share of the shortest time between two changes of the contact."""


@dataclass(frozen=True, slots=True)
class _Driven:
    at_s: float
    direction: Direction


class TappedLines:
    """The motor relays' lines, with a record of each change and its time.

    It stands between the relay bank and the lines, so that it records each switching: by a command, by its expiry, by
    `off` from another thread, by a cut supply.
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
        """The changes of this axis's relays since the last call. Each axis may have one caller only."""
        heard = self._heard[axis]
        return [heard.popleft() for _ in range(len(heard))]


class PulseCounter:
    """One axis as a `hw.ports.AngleSensor`. `read` gives degrees; before the first `place`, from an arbitrary angle.

    `clock` is the kernel's monotonic time. Raises HardwareError if the debounce would hide whole closures.
    """

    source = AngleSource.COUNTED
    travelled_deg = 0.0
    error_deg: float | None = None
    worn = False
    """A count grows no worse with the way."""

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
        self._count.trouble = "it has not been placed yet"

    def read(self) -> float:
        """Degrees on the rotor's own scale. Raises HardwareError when the contact cannot be read."""
        now_s = self._clock()
        self._waiting += self._lines.heard(self._axis)
        self._waiting += [
            ContactChange(change.at_s - self._debounce_s, change.closed, change.lost)
            for change in self._contact.changes()
        ]
        self._waiting.sort(key=lambda event: event.at_s)
        # The kernel reports a change after its debounce. So all changes older than the debounce have arrived.
        settled_s = now_s - self._debounce_s
        while self._waiting and self._waiting[0].at_s <= settled_s:
            self._take(self._count, self._waiting.pop(0))
        self._count.advance(settled_s)
        driven = [(event.at_s, event.direction) for event in self._waiting if isinstance(event, _Driven)]
        return self._count.ahead_deg(driven, now_s)

    def place(self, angle_deg: float, within_deg: float = 0.0) -> bool:
        """The axis stands at that angle: a stored count, or an end stop. False: the contact's state contradicts it.

        `within_deg`: possible error of the angle; the contact decides within it. Call it only at rest. Forgets the
        former count. Raises HardwareError if the contact cannot be read.
        """
        self.read()
        closed = self._contact.closed()
        return self._count.place(self._clock() - self._debounce_s, angle_deg, closed=closed, within_deg=within_deg)

    def reaches(self, angle_deg: float) -> bool:
        """Whether the shaft may stand at that angle of the rotor's own scale."""
        return self._count.cam.reaches(angle_deg)

    @property
    def changes(self) -> int:
        """The number of changes of the contact since the start; two of them make one pulse."""
        return self._count.changes

    @property
    def in_closure(self) -> bool:
        """Whether the contact is closed, by the last counted change or the last `place`."""
        return self._count.zone % 2 == 0

    @property
    def ahead(self) -> frozenset[Direction]:
        """The directions in which the contact would change again before the stop."""
        return self._count.cam.ahead(self._count.zone)

    @property
    def at_rest(self) -> bool:
        """Whether no relay is on and the motor has stopped coasting."""
        return self._count.at_rest and not self._waiting

    @property
    def zone(self) -> int:
        """The number of the cam's present zone; see `hw.sensors.cam`."""
        return self._count.zone

    @property
    def trouble(self) -> str:
        """Why the count is unreliable until the axis is homed or placed; empty while the count is right."""
        return self._count.trouble

    @property
    def closed(self) -> bool:
        """Whether the contact is closed now, from any thread. Raises HardwareError."""
        return self._contact.closed()

    @property
    def turning(self) -> bool:
        """Whether the motor runs at its speed though no relay is on."""
        return self._count.turning

    @property
    def quiet(self) -> bool:
        """Whether the shaft was driven for three periods without a pulse."""
        return self._count.quiet

    @staticmethod
    def _take(count: CamCount, event: _Driven | ContactChange) -> None:
        match event:
            case _Driven(at_s, direction):
                count.drive(at_s, direction)
            case ContactChange(at_s, closed, lost):
                count.change(at_s, closed=closed, lost=lost)
