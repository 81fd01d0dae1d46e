"""What the guides share with which a person steers the whole antenna, by presses for either axis.

Knows when a press was ordered, and that an answer waits until the antenna stands again. Does not know what is asked.
"""

from __future__ import annotations

from rotator.calibrating.entries import TAP_S, Entry, Press, StopNow
from rotator.calibrating.guide import ORDER_TAKEN_S, Guide
from rotator.exchange.orders import Jog
from rotator.exchange.status import AxisStatus


class SteeringGuide(Guide):
    """`tap_s`: how long one key press turns an axis."""

    def __init__(self, keys: str, tap_s: float = TAP_S) -> None:
        super().__init__(keys, -360.0, 720.0)
        self._tap_s = tap_s
        self._pressed_s: float | None = None
        """When the latest press was ordered; None: there was none."""

    def ready(self, entry: Entry) -> bool:
        if isinstance(entry, StopNow):
            return True
        pressed = self._pressed_s is not None and self._now_s - self._pressed_s < ORDER_TAKEN_S
        return self._asking and not (pressed or self._latest is None or self._latest.moving)

    @property
    def _axis(self) -> AxisStatus:
        return self._status.azimuth

    def _press(self, press: Press, *, may_turn: bool) -> None:
        if not may_turn:
            self._say(f"It turns again after your answer. {self._accepts}")
        elif press.seconds > 0:
            self._pressed_s = self._now_s
            seconds = self._tap_s if press.seconds == TAP_S else press.seconds
            self._orders.append(Jog(press.axis, press.direction, seconds))
