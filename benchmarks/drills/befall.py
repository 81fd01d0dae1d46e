"""What befalls the world of a drill: troubles of its parts, and the faults of which a message is due from then on.

Knows which event begins or ends which fault. Does not know how a part fails (`trouble`, `card`), nor when a message is
due (`silence`).
"""

from __future__ import annotations

from benchmarks.drills.axis_case import AxisCase
from benchmarks.drills.card import Card
from benchmarks.drills.judges import Judges
from benchmarks.drills.scene import spoil
from benchmarks.drills.script import Event
from benchmarks.drills.silence import Silence
from benchmarks.drills.trouble import Troubles
from rotator.config.model import Config

OUTSIDE = ("zero", "full")
"""Kinds of bad readings that no healthy sensor can show."""
CARD_HANGS = "card-hangs"


class WorldEvents:
    """Call `look` after every cycle."""

    def __init__(
        self,
        config: Config,
        cases: tuple[AxisCase, AxisCase],
        *,
        judges: Judges,
        silence: Silence,
        troubles: Troubles,
        card: Card,
    ) -> None:
        self._config, self._cases, self._judges = config, cases, judges
        self._silence, self._troubles, self._card = silence, troubles, card
        self._stand: frozenset[str] = frozenset()
        """The axes whose readings stand still."""
        self._waited = False
        """A write that a program has begun does not return."""

    def look(self, now_s: float) -> None:
        waited, self._waited = self._waited, self._card.waited_for
        if self._waited and not waited:
            self._silence.begin(CARD_HANGS, now_s)
        elif waited and not self._waited:
            self._silence.end(CARD_HANGS)

    def befall(self, event: Event) -> None:
        now_s = event.at_s
        if event.what == "card":
            self._card.become(event.number(0))
            return
        if event.what == "file":
            self._card.change(event.text(0), event.text(1), now_s)
            return
        spoil(self._config, self._cases, self._judges, event)
        self._troubles.begin(event.what, event.args)
        if event.what == "fault":
            self._silence.begin(event.text(0), now_s)
        elif event.what == "clear":
            self._silence.end(event.text(0))
        elif event.what == "weld":
            self._silence.begin(f"{event.text(0)}-relay-welded", now_s)
        elif event.what == "unweld":
            self._silence.end(f"{event.text(0)}-relay-welded")
        elif event.what in ("every", "stands"):
            self._silence.end("every")
            if event.what == "stands":
                self._silence.end("pot-crackles")
                self._stand = self._stand | {event.text(0)} if event.number(1) else self._stand - {event.text(0)}
            elif event.text(0) in self._stand:
                pass  # its reading stands still, so a bad reading does not show
            elif self._config.rotor.type == "relay-pot" and event.number(1) and event.text(2) in OUTSIDE:
                self._silence.begin(f"{event.text(0)}-every:{event.number(1):.0f}", now_s)
