"""A simulated controller at the end of a line: bytes go in and come out at the line's rate, after its own delay.

Knows a dialect and the axes behind it, the line's speed, and the faults of the line. Offers `read`, `write` and
`close`, as a port does. Not simulated: echo, flow control, parity.
"""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable, Sequence

from firmware_sim.controllers.brain import SimBrain
from firmware_sim.controllers.dialects import DIALECTS, Act, Heard, Place

BITS = 10
"""Of a byte on the line, with its start and its stop."""
LOOK_S = 0.005
"""A reader that waits in real time looks this often."""


class SimLine:
    """`brains`: its azimuth and its elevation; a controller that turns one axis has nothing at the other, and speaks of
    it all the same. `wraps`: it tells azimuths of one turn, from this angle up. `delay_s`: before an answer."""

    def __init__(
        self,
        protocol: str,
        brains: Sequence[SimBrain],
        clock: Callable[[], float],
        lock: threading.RLock,
        *,
        baud: int,
        wraps: float | None = None,
        delay_s: float = 0.01,
    ) -> None:
        self._dialect = DIALECTS[protocol]
        self.brains = tuple(brains)
        self._clock = clock
        self._lock = lock
        self._byte_s = BITS / baud
        self._wraps = wraps
        self.delay_s = delay_s
        """Fault: a slow controller has a longer one."""
        self.deaf = False
        """Fault: it does not hear, and does not answer."""
        self.garbled = False
        """Fault: the two ends have different rates."""
        self.ignores_stop = False
        """Fault: it goes on after its stop."""
        self.unplugged = False
        """Fault: the line is cut."""
        self.stops = 0
        """How many stops it has heard."""
        self.moves_s: deque[float] = deque(maxlen=64)
        """When it was told a target."""
        self._in: deque[tuple[float, bytes]] = deque()
        self._out: deque[tuple[float, bytes]] = deque()
        self._in_free_s = self._out_free_s = clock()
        self._buffer = b""
        self._preset: Place = (None, None)

    # --- the port

    def open(self) -> SimLine:
        """The line itself. Raises OSError while it is cut."""
        self._check()
        return self

    def write(self, data: bytes) -> None:
        with self._lock:
            self._check()
            self.advance(self._clock())
            self._in_free_s = max(self._in_free_s, self._clock()) + len(data) * self._byte_s
            self._in.append((self._in_free_s, data))

    def read(self, patience_s: float) -> bytes:
        if patience_s <= 0.0:
            return self._take()
        pause = threading.Event()
        for _ in range(max(1, round(patience_s / LOOK_S))):
            if data := self._take():
                return data
            pause.wait(LOOK_S)
        return b""

    def close(self) -> None:
        """A simulated line stays where it is."""

    def due_s(self) -> float | None:
        """When bytes arrive at either end."""
        with self._lock:
            return min((queue[0][0] for queue in (self._in, self._out) if queue), default=None)

    def _take(self) -> bytes:
        with self._lock:
            self._check()
            self.advance(self._clock())
            data = b""
            while self._out and self._out[0][0] <= self._clock():
                data += self._out.popleft()[1]
            return data

    def _check(self) -> None:
        if self.unplugged:
            self._in.clear()
            self._out.clear()
            raise OSError("the adapter is gone")

    # --- the controller

    def advance(self, now_s: float) -> None:
        """Hear what has come by then, and turn."""
        while self._in and self._in[0][0] <= now_s:
            at_s, data = self._in.popleft()
            for brain in self.brains:
                brain.advance(at_s)
            self._hear(data, at_s)
        for brain in self.brains:
            brain.advance(now_s)

    def _hear(self, data: bytes, at_s: float) -> None:
        if self.deaf:
            return
        if self.garbled:
            self._answer(bytes(0x80 | octet ^ 0x55 for octet in data), at_s)
            return
        self._buffer += data
        while self._buffer:
            heard, self._buffer = self._dialect.take(self._buffer)
            if heard is None:
                return
            self._obey(heard, at_s)

    def _obey(self, heard: Heard, at_s: float) -> None:
        match heard.act:
            case Act.GO:
                self._go(heard.angles_deg, at_s)
            case Act.PRESET:
                self._preset = heard.angles_deg
            case Act.START:
                self._go(self._preset, at_s)
            case Act.STOP:
                self.stops += 1
                if not self.ignores_stop:
                    for brain in self.brains:
                        brain.stop()
        if heard.tells:
            self._answer(self._dialect.position(*self._told(), heard.tells), at_s)
        if heard.reply:
            self._answer(heard.reply, at_s)

    def _go(self, angles_deg: Place, at_s: float) -> None:
        self.moves_s.append(at_s)
        for place, (brain, angle_deg) in enumerate(zip(self.brains, angles_deg, strict=True)):
            if angle_deg is None:
                continue
            target_deg = round(angle_deg / brain.step_deg) * brain.step_deg
            brain.go(target_deg if self._wraps is None or place else self._turn(brain, target_deg))

    @staticmethod
    def _turn(brain: SimBrain, angle_deg: float) -> float:
        """Told of one turn only, it goes to that angle where its rotor can: rather on the turn on which it is."""
        turns = round((brain.motor.shaft_deg - angle_deg) / 360.0)
        reach_deg = [angle_deg + 360.0 * each for each in (turns, turns - 1, turns + 1)]
        low_deg, high_deg = brain.motor.stop_low_deg, brain.motor.stop_high_deg
        return next((each for each in reach_deg if low_deg <= each <= high_deg), angle_deg)

    def _told(self) -> tuple[float, float]:
        azimuth_deg, elevation_deg = (brain.angle_deg for brain in self.brains)
        if self._wraps is not None:
            azimuth_deg = self._wraps + (azimuth_deg - self._wraps) % 360.0
        return azimuth_deg, elevation_deg

    def _answer(self, data: bytes, at_s: float) -> None:
        begins_s = max(self._out_free_s, at_s + self.delay_s)
        self._out_free_s = begins_s + len(data) * self._byte_s
        self._out.append((self._out_free_s, data))
