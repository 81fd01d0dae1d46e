"""A line that changes its level at each beat, for a one-shot that cuts the motors' supply when the beats stop.

Knows one output. Does not know when to beat: the control loop does, after each good step.
"""

from __future__ import annotations

from hw.ports import OutputLines

HEARTBEAT = "heartbeat"


class Heartbeat:
    """Each beat changes the level, because the one-shot reacts to changes only (docs/heartbeat.md)."""

    def __init__(self, lines: OutputLines) -> None:
        self._lines = lines
        self._level = False

    def beat(self) -> None:
        """Change the level. Raises HardwareError when the line cannot be set."""
        self._level = not self._level
        self._lines.set({HEARTBEAT: self._level})
