"""Which source may move the antenna: latched stops, the panel's mode switch, and streams that have lost the antenna.

Knows sources and moments. Of an order it knows whether it stops, releases or moves, and where it points.
"""

from __future__ import annotations

import math

from rotator.control.rights import Deed, State, at_mode, hindrance, mode_words
from rotator.control.senders import PAUSE_S, Pair, Senders
from rotator.orders import CONSOLE, PAGE, PANEL, Mode, Source
from rotator.spoken import held_by
from rotator.status import Latch

AGREE_DEG = 4.0
LET_GO_S = 0.5
"""A jog switch that is held sends orders closer together than this: a stop ends them until it was let go."""
KNOB_S = 1.0
"""A knob's order comes within this after the knob was turned: one that follows a stop sooner began before it."""
MOST_SHOWN = 4
"""So many ignored sources are named at a time, the latest first."""
SWITCH_HELD = "a stop came while the jog switch was held: release the switch first"
KNOB_TURNED = "a stop came while the knob was turned: turn it again"


class Authority:
    """Every order that would move an axis asks here first. `agree_deg`: so far apart, two directions are the same."""

    def __init__(self, mode: Mode = Mode.AUTO, agree_deg: float = AGREE_DEG, latch: Latch | None = None) -> None:
        """`latch`: what was in force when the program ended. A storm park is not driven on: a person orders it anew."""
        self.latched = latch.by if latch else ""
        """The source of a stop or storm park that only a person releases; empty: there is none."""
        self.storm = latch is not None and latch.storm
        """The latch is a storm park that goes on."""
        self.mode = mode
        self.controlled_by: Source | None = None
        self.held_by: Source | None = None
        """The person who has taken the antenna, and has not given it back."""
        self._panel: Source | None = None
        """Who switched to this mode: the panel, or a person. In MANUAL and JOG nobody else moves the antenna."""
        self._held_on_s = -math.inf
        """When somebody else last stopped it, or the panel's jog switch, held on since then, sent an order."""
        self._senders = Senders(agree_deg)
        self._ignored: dict[str, tuple[str, float]] = {}
        """By the name of a source: why its latest order had no effect, and when that was. The latest is the last."""

    def stopped(self, source: Source, now_s: float, *, latch: bool) -> None:
        """`source` stopped the antenna. Other sources that send have no effect until they pause or reconnect."""
        self._senders.stop(source, now_s)
        self.controlled_by = None
        self.stopped_axis(source, now_s)
        if latch:
            self.latched = str(source)

    def begin_storm(self, source: Source) -> None:
        """A person parks the antenna before a storm: only a stop or the mode switch ends that."""
        self.latched, self.storm = str(source), True
        self.controlled_by = source

    def stopped_axis(self, source: Source, now_s: float) -> None:
        """`source` stopped an axis or both. A jog switch that is held has no effect until it is let go."""
        if source != self._panel:
            self._held_on_s = now_s
        self._end_storm(source)

    def _end_storm(self, source: Source) -> None:
        """What a storm park has latched stays so, and says that it is no park now."""
        if self.storm:
            self.latched, self.storm = f"{source}, in a storm park", False

    def released(self) -> None:
        """A person lets the box move again. No source stays silenced."""
        self.latched, self.storm = "", False
        self._senders.free_all()
        self._ignored.clear()

    def switch(self, panel: Source, mode: Mode) -> None:
        """A person turns the mode switch."""
        self.mode, self._panel = mode, panel
        self.controlled_by = self.held_by = None
        self._end_storm(panel)

    @property
    def mode_by(self) -> str:
        return str(self._panel or "")

    @property
    def _has_mode_of_a_person(self) -> bool:
        """The mode was set on the page or in the terminal, and not at a panel's switch."""
        return self._panel is not None and self._panel.link != PANEL

    def _end_mode_of_a_person(self) -> None:
        """What is set at no switch ends when somebody takes the antenna, or gives it back."""
        if self._has_mode_of_a_person:
            self.mode, self._panel = Mode.AUTO, None

    def _set_this_mode(self, source: Source) -> bool:
        """Whether this is who set the mode: on the console, which has a connection for each command, any of them.

        A person at the panel is held off by its own switch alone.
        """
        if self._panel is None or source == self._panel:
            return self._panel is not None
        return source.link == CONSOLE == self._panel.link or (source.link == PANEL and self._panel.link == PAGE)

    def take(self, source: Source, *, stopped: bool) -> None:
        """A person takes the antenna. `stopped`: its motors have been stopped for that."""
        if source != self._panel:
            self._end_mode_of_a_person()
        self.held_by = source
        if stopped:
            self.controlled_by = None

    def give_back(self, source: Source) -> None:
        """A person gives back what was taken: the next order of a program counts, unless another one's stop silences
        it. Another person on the page takes the antenna over first."""
        if self.held_by is None and not self._has_mode_of_a_person:
            return
        if self.held_by not in (None, source) and source.may_be_held_off:
            return
        self._end_mode_of_a_person()
        self.held_by = None
        self._senders.free_taken()
        self._ignored.clear()

    def left(self, source: Source, now_s: float) -> bool:
        """The connection of `source` has ended. Returns whether the stream that moved the antenna ended with it."""
        streamed = source == self.controlled_by and self._senders.streams(source)
        self._senders.left(source, now_s)
        if (ignored := self._ignored.pop(str(source), None)) is not None:
            # The next connection of a program that connects for every order has another number.
            self._ignored[source.link] = ignored
        return streamed

    def may_move(
        self, source: Source, now_s: float, aims: Pair | None = None, *, deed: Deed = Deed.AIM, homing: bool = False
    ) -> bool:
        """Whether an order from `source` that moves an axis has an effect now. The source counts as sending.

        `aims`: where the order points; None: it is no order for a direction. When it has an effect, the streams of
        other sources that point elsewhere lose the antenna. `homing`: an axis homes for another source.
        """
        self._senders.note(source, now_s, aims)
        if not self.allows(source, now_s, deed, homing=homing):
            if source == self._panel and self.mode is Mode.JOG and self._holds_on(now_s):
                self._held_on_s = now_s
            return False
        self._senders.take(source, now_s)
        self.controlled_by = source
        if source.holds:
            self.held_by = source
        return True

    def allows(self, source: Source, now_s: float, deed: Deed, *, homing: bool = False) -> bool:
        """Whether this order from `source` has an effect now; if not, `ignored` tells why."""
        self._ignored.pop(str(source), None)
        held = self._holds(source, now_s) | ({State.HOMING: "an axis is homing"} if homing else {})
        if (state := hindrance(held, deed)) is None:
            return True
        self._ignored.pop(source.link, None)
        self._ignored[str(source)] = (held[state], now_s)
        return False

    def ignored(self, now_s: float) -> tuple[str, ...]:
        """A sentence for each source whose orders have had no effect lately: which source, why, and what ends that."""
        lately = [(name, why) for name, (why, at_s) in self._ignored.items() if now_s - at_s < PAUSE_S]
        self._ignored = {name: self._ignored[name] for name, _ in lately}
        return tuple(f"orders from {name} are ignored: {why}" for name, why in reversed(lately[-MOST_SHOWN:]))

    def _holds_on(self, now_s: float) -> bool:
        """Whether what a person does at the panel began before the stop: in each mode its own parts count."""
        return now_s - self._held_on_s < (LET_GO_S if self.mode is Mode.JOG else KNOB_S)

    def _holds(self, source: Source, now_s: float) -> dict[State, str]:
        """The states that hold the antenna back from `source`, the strongest first, and the words for each."""
        held = {}
        if self.latched:
            held[State.STORM if self.storm else State.STOPPED] = held_by(self.latched, storm=self.storm)
        own = self._set_this_mode(source)
        # The switches and knobs of a panel are themselves what each mode allows.
        at_panel = own and source.link == PANEL and self.mode in (Mode.MANUAL, Mode.JOG)
        if not at_panel and (state := at_mode(self.mode, own=own)):
            held[state] = mode_words(self.mode, self.mode_by)
        if at_panel and self._holds_on(now_s):
            held[State.SILENCED] = SWITCH_HELD if self.mode is Mode.JOG else KNOB_TURNED
        if self.held_by is not None and self.held_by != source and source.may_be_held_off:
            held[State.HELD] = f"{self.held_by} holds the antenna until it is given back there"
        # A stop that comes over a link does not silence the person at the panel for longer.
        if self.mode is Mode.AUTO and (silence := self._senders.silence(source)):
            held[State.SILENCED] = silence
        return held
