"""A line that changes level at every beat, for a one-shot that lets the motors' supply go when the beats stop.

Knows one output. Does not know when a beat is deserved: the control loop beats after a step that went well.
"""

from __future__ import annotations

from hw.ports import OutputLines

HEARTBEAT = "heartbeat"


class Heartbeat:
    """Frozen at either level it means nothing: the one-shot hears changes only (docs/wiring.md)."""

    def __init__(self, lines: OutputLines) -> None:
        self._lines = lines
        self._level = False

    def beat(self) -> None:
        """Raises HardwareError when the line cannot be set."""
        self._level = not self._level
        self._lines.set({HEARTBEAT: self._level})
