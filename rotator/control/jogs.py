"""Who jogs which axis, and for how long: a jog without a time ends with the connection that ordered it.

An axis that is not commissioned has no limits that could stop it, and a program may press a thousand times. So the
presses of a link turn it for two seconds at most. Then it rests 0.8 s, and presses have no effect meanwhile. The same
holds for the page, which repeats the order several times a second while its button is held. A person at the console, at
the panel or in a calibration may press as often as needed. After three presses that moved nothing a program's presses
are ignored.

Knows both axes, the source of the last jog of each, and how long each has been driven. Knows no other order.
"""

from __future__ import annotations

from collections.abc import Mapping

from hw.ports import Axis, Direction
from rotator.control.axis.goals import UNCALIBRATED_JOG_S
from rotator.control.axis.port import ControlledAxis
from rotator.exchange.orders import Jog
from rotator.exchange.sources import PAGE, Source

REST_SHARE = 0.4
"""Rest after a turn, as a share of the turn's time."""


class Jogs:
    def __init__(self, axes: Mapping[Axis, ControlledAxis]) -> None:
        self._axes = axes
        self._by: dict[Axis, Source] = {}
        """The source of the last jog."""
        self._turned_s = dict.fromkeys(axes, 0.0)
        """How long each axis has turned, less what it has rested since."""
        self._noted_s: float | None = None

    def begin(self, jog: Jog, source: Source, now_s: float) -> None:
        axis, seconds = self._axes[jog.axis], jog.seconds
        if jog.direction is not Direction.OFF and axis.pressed_in_vain and not source.is_person:
            return
        by_link = jog.held or source.link == PAGE or not source.is_person
        if jog.direction is not Direction.OFF and axis.missing and by_link:
            turned_s = self._turned_s[jog.axis]
            left_s = UNCALIBRATED_JOG_S - turned_s if axis.driven or turned_s == 0.0 else 0.0
            if left_s <= 0.0:
                return
            seconds = left_s if seconds is None else min(seconds, left_s)
        axis.jog(jog.direction, seconds, now_s, held=jog.held)
        self._by[jog.axis] = source

    def note_driven(self, now_s: float) -> None:
        """After the cycle: how long each axis has turned and rested since the last one."""
        passed_s = 0.0 if self._noted_s is None else now_s - self._noted_s
        self._noted_s = now_s
        for name, axis in self._axes.items():
            gone_s = passed_s if axis.driven else -passed_s / REST_SHARE
            self._turned_s[name] = min(max(self._turned_s[name] + gone_s, 0.0), UNCALIBRATED_JOG_S)

    def end(self, source: Source) -> None:
        """`source` has let go, or its connection has ended: halt what it holds. A jog with a time ends by itself."""
        for axis, by in self._by.items():
            if by == source and self._axes[axis].jog_is_held:
                self._axes[axis].halt()
