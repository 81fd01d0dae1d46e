"""Which source may move the antenna: latched stops, the panel's mode switch, and streams that have lost the antenna.

Knows sources and moments. Of an order it knows whether it stops, releases or moves, and where it points. Knows no axis
and no motor.
"""

from __future__ import annotations

import math

from rotator.control.rights import Deed, State, hindrance, standing_holds
from rotator.control.senders import PAUSE_S, Senders
from rotator.control.sky.angles import Coordinates
from rotator.exchange.orders import Mode
from rotator.exchange.sources import CONSOLE, PAGE, PANEL, TRACKER, Source
from rotator.exchange.status import Latch

AGREE_DEG = 4.0
LET_GO_S = 0.5
"""A held jog switch sends orders closer together than this. After a stop they have no effect until it is released."""
KNOB_S = 1.0
"""The longest time from the turn of a knob to its order. If an order follows a stop sooner, its turn was earlier."""
MOST_SHOWN = 4
"""The most ignored sources that are named at a time, the latest first."""
SWITCH_HELD = "a stop came while the jog switch was held: release the switch first"
KNOB_TURNED = "a stop came while the knob was turned: turn it again"


class Authority:
    """Every order that would move an axis asks here first.

    `agree_deg`: two directions closer than this count as equal.
    """

    def __init__(
        self,
        mode: Mode = Mode.AUTO,
        agree_deg: float = AGREE_DEG,
        latch: Latch | None = None,
        *,
        attended: bool = False,
    ) -> None:
        """`latch`: what was in force when the program ended. A storm park is not continued by itself.

        `attended`: an axis is calibrated, and a person may stand at the rotor: only persons move it.
        """
        self._attended = attended
        self.latched = latch.by if latch else ""
        """The source of a stop or storm park that only a person releases; empty: nothing is latched."""
        self.storm = latch is not None and latch.storm
        """What is latched is a storm park in progress."""
        self.mode = mode
        self.controlled_by: Source | None = None
        self.held_by: Source | None = None
        """The person who has taken the antenna, and has not given it back."""
        self._panel: Source | None = None
        """Who has set the mode: the panel, or a person. In MANUAL and JOG only this source may move the antenna."""
        self._held_on_s = -math.inf
        """Time of the last stop by another source; later, of the last jog order while that switch is still held."""
        self._senders = Senders(agree_deg)
        self._ignored: dict[str, tuple[str, float]] = {}
        """By the name of a source: why its latest order had no effect, and the moment. In order of time."""

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
        """`source` stopped an axis or both. A held jog switch has no effect until it is released."""
        if source != self._panel:
            self._held_on_s = now_s
        self._end_storm(source)

    def _end_storm(self, source: Source) -> None:
        """End the storm park. The stop stays latched; its text names the storm park."""
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
    def moves_by_itself(self) -> bool:
        """Whether an idle antenna may park: not in a mode of a person, nor while a person stands at the rotor."""
        return not self.latched and self.mode is Mode.AUTO and not self._attended

    @property
    def moved_by_page(self) -> bool:
        """Whether a person on the page moves the antenna, or holds it while it tracks."""
        by, holder = self.controlled_by, self.held_by
        mover = holder if by is not None and by.link == TRACKER else by
        return mover is not None and mover.link == PAGE

    def program_sends(self, now_s: float) -> bool:
        """Whether the antenna belongs to a program that sends: one whose pause is shorter than that of a stream."""
        by = self.controlled_by
        return by is not None and not by.is_person and by.link != TRACKER and self._senders.sends(by, now_s)

    @property
    def mode_by(self) -> str:
        return str(self._panel or "")

    @property
    def _has_mode_of_a_person(self) -> bool:
        """The mode was set on the page or in the terminal, and not at a panel's switch."""
        return self._panel is not None and self._panel.link != PANEL

    def _end_mode_of_a_person(self) -> None:
        """A mode set on the page or console ends when a person takes or gives back the antenna."""
        if self._has_mode_of_a_person:
            self.mode, self._panel = Mode.AUTO, None

    def _set_this_mode(self, source: Source) -> bool:
        """Whether this source set the mode. All console connections count as one.

        A person at the panel is held off only by the panel's own switch.
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
        """A person gives the antenna back: the next order of a program counts, unless the stop of another program
        silences it. Another person on the page must take the antenna over first."""
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

    def hear(self, source: Source, now_s: float, aims: Coordinates | None) -> None:
        """`source` sends an order that was refused: it counts as sending."""
        self._senders.note(source, now_s, aims)

    def may_move(
        self,
        source: Source,
        now_s: float,
        aims: Coordinates | None = None,
        *,
        deed: Deed = Deed.AIM,
        homing: bool = False,
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
        """Whether this order from `source` has an effect now. If not, `ignored` gives the reason."""
        self._ignored.pop(str(source), None)
        held = self._holds(source, now_s) | ({State.HOMING: "an axis is homing"} if homing else {})
        if (state := hindrance(held, deed)) is None:
            return True
        self._ignored.pop(source.link, None)
        self._ignored[str(source)] = (held[state], now_s)
        return False

    def ignored(self, now_s: float) -> tuple[str, ...]:
        """A sentence for each source whose orders have had no effect lately: which source, why, and what ends that."""
        if not self._ignored:
            return ()
        lately = [(name, why) for name, (why, at_s) in self._ignored.items() if now_s - at_s < PAUSE_S]
        self._ignored = {name: self._ignored[name] for name, _ in lately}
        return tuple(f"orders from {name} are ignored: {why}" for name, why in reversed(lately[-MOST_SHOWN:]))

    def _holds_on(self, now_s: float) -> bool:
        """Whether the jog switch (JOG) or knob (MANUAL) was already in use when the stop came."""
        return now_s - self._held_on_s < (LET_GO_S if self.mode is Mode.JOG else KNOB_S)

    def _holds(self, source: Source, now_s: float) -> dict[State, str]:
        """The states that hold the antenna back from `source`, the strongest first, and the words for each."""
        own = self._set_this_mode(source)
        # In MANUAL and JOG a panel sends only what its own switch allows.
        at_panel = own and source.link == PANEL and self.mode in (Mode.MANUAL, Mode.JOG)
        mode = Mode.AUTO if at_panel else self.mode
        held = standing_holds(self.latched, mode, self.mode_by, storm=self.storm, own=own)
        if at_panel and self._holds_on(now_s):
            held[State.SILENCED] = SWITCH_HELD if self.mode is Mode.JOG else KNOB_TURNED
        if self.held_by is not None and self.held_by != source and source.may_be_held_off:
            held[State.HELD] = f"{self.held_by} holds the antenna until it is given back there"
        # A stop that comes over a link does not silence the person at the panel for longer.
        if self.mode is Mode.AUTO and (silence := self._senders.silence(source)):
            held[State.SILENCED] = silence
        if self._attended and not source.is_person:
            held[State.CALIBRATING] = "an axis is being calibrated"
        return held
