"""The box of a drill: the real drivers on simulated chips, the control loop and sessions, in simulated time.

Knows how to build it, to run a cycle, to hand bytes to a link, and to end it: properly, as with SIGTERM, or killed. Its
sentinel opens no relay: a drill in which it would have killed the program has shown a bug. The simulated world and the
state folder outlive it. Does not know what is right or wrong.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Collection
from functools import partial

from benchmarks.drills.browser import Browser
from benchmarks.drills.card import STATE, Card, StateLane
from benchmarks.drills.script import PAGE, Drill
from benchmarks.drills.speech import PROTOCOLS
from benchmarks.drills.tracking import DrilledTracking
from firmware_sim.clock import SimClock
from firmware_sim.rotors.rotor import SimRotor
from hw.ports import Axis
from hw.safety.lines_off import switch_off
from hw.safety.off_at_once import BRAKE_AFTER_S
from rotator.assembly.hands import hands
from rotator.assembly.kept_files import build_learnt, build_relays, build_tries
from rotator.assembly.panel import panel_thread
from rotator.assembly.sessions import session_maker
from rotator.assembly.settings import build_controller, build_mount, build_offsets
from rotator.assembly.station import Station
from rotator.config.links import Link
from rotator.config.model import Config
from rotator.exchange.sources import Source
from rotator.panel.thread import PanelThread
from rotator.protocols.console_session import ConsoleSession
from rotator.protocols.panel_words import parse_hand
from rotator.protocols.session import Session
from rotator.rotors.relays import RelayRotor
from rotator.runtime.autosave import Autosave
from rotator.runtime.client import Client
from rotator.runtime.event_watch import EventWatch
from rotator.runtime.keeping import CardWatch, Keeping
from rotator.runtime.loop import ControlLoop
from rotator.store import counts
from rotator.store.latch import KeptLatch
from rotator.store.state import State

SILENCE_S = 0.7
"""Seconds of silence after which the real sentinel opens the relays (docs/safety.md)."""


class DrilledSentinel:
    def __init__(self, clock: SimClock) -> None:
        self._clock = clock
        self._leased_s: float | None = None
        """When a lease was last renewed; None: all relays are open."""
        self.brakes_off: Collection[str] = ()

    def renew(self) -> None:
        self._leased_s = self._clock()

    def rest(self) -> None:
        self._leased_s = None

    def unbraked(self, lines: Collection[str]) -> None:
        self.brakes_off = lines

    @property
    def kills(self) -> bool:
        """Whether the program has been silent for too long while a relay is closed."""
        return self._leased_s is not None and self._clock() > self._leased_s + SILENCE_S


SENTINEL_S = 0.04
"""Seconds after the death of the program until its sentinel has opened the relays (docs/safety.md)."""
PANEL = Source("panel")
LOOKS_S = 1.0
"""How often the threads that write files look whether something is unwritten."""
BEGINS_S = 0.05
"""A new run waits no longer for a card that hangs. In real time it waits for seconds, and nothing moves yet."""


class Box:
    """One run of the program. `world`: the simulated rotor that an earlier run has left; None: a new one."""

    def __init__(
        self, drill: Drill, config: Config, card: Card, clock: SimClock, world: SimRotor | None, *, begun_s: float
    ) -> None:
        """`card`: with the state files. `begun_s`: when the drill began, on the clock."""
        self.config = config
        self._clock = clock
        self._card, folder, memory = card, card.folder, card.memory
        self.alive = True
        self.sentinel = DrilledSentinel(clock)
        if world is not None:
            world.open_buses()
        self.station = Station(
            config,
            clock,
            clock.sleep,
            drill.start_deg,
            add_alarm=self._add_alarm,
            counts=folder / counts.FILE_NAME,
            world=world,
            watch=self.sentinel,
            write=card.lane(counts.FILE_NAME),
        )
        assert self.station.world is not None
        self.world: SimRotor = self.station.world
        self._state = state = State(folder / STATE, memory)
        learnt, relays, tried = build_learnt(config, state), build_relays(config, state), build_tries(config, state)
        assert tried is not None, "the rotor of a drill outlives its program"
        commissioning = Axis(drill.commissioning) if drill.commissioning else None
        kept = KeptLatch(state)
        stopped, tries = kept.load(), tried.load()
        kept.note(stopped)
        tried.note(tries)
        trusts = relays.begin(BEGINS_S) if relays else None
        controller = build_controller(
            config,
            learnt.load(),
            commissioning,
            attended=not drill.left_alone,
            trusts=trusts,
            tries=tries,
            latch=stopped,
            panel=config.panel.fitted,
        )
        self.events, self.page_events = EventWatch(clock), EventWatch(clock)
        """The watches over the event loops that serve the links and the page; the drill ticks for them."""
        self._lane = StateLane(card.lane(STATE), state)
        after = self._lane.after
        self.loop = ControlLoop(
            controller,
            self.station.rotor,
            clock,
            1 / config.control.rate_hz,
            after_good_step=self.station.beat,
            events=self.events,
            page_events=self.page_events,
            keeping=Keeping(
                latch=after(kept.note),
                tries=after(tried.note),
                trusts=after(relays.note) if relays else lambda _trusts: None,
            ),
            card=CardWatch(lambda: [state.trouble]),
        )
        self._lane.save()
        self._relays = relays
        self._autosave = Autosave(self.loop, None, build_offsets(config), learnt)
        self._learns, self._knobs = card.lane(STATE), card.lane(STATE)
        self._looked_s = clock()
        self._mount = build_mount(config)
        self._numbers = itertools.count(1)
        self._sessions: dict[str, tuple[Session, Client]] = {}
        self._sources: dict[str, Source] = {}
        """By link or person: the source of its session."""
        self.tracking = DrilledTracking(config, self.loop, self._mount, clock, begun_s)
        self.panel = self._panel(state) if config.panel.fitted else None

    def cycle(self, *, blind: bool = False) -> None:
        """One turn of the control loop; `blind`: the reading thread hangs."""
        if blind:
            self.loop.act()
        else:
            self.loop.cycle()
        now_s = self._clock()
        if self.panel:
            self.panel.cycle(now_s)
        if self._card.hangs:
            self._lane.work()
            self._card.work()
        if now_s - self._looked_s < LOOKS_S:
            return
        self._looked_s = now_s
        self._lane.look(now_s)
        if self.panel and not self._knobs.busy:
            self._knobs(partial(self.panel.save, now_s))

    def hear(self, who: str, data: bytes) -> list[bytes]:
        """Bytes from a program or a person. They act at once."""
        session, _ = self._session(who)
        replies = session.receive(data)
        if session.closed:
            self.leave(who)
        return replies

    def leave(self, who: str) -> None:
        """The connection ends; the next bytes come on a new one."""
        if who in self._sessions:
            self._sessions.pop(who)[1].left()
            del self._sources[who]

    def recognise(self, who: str, words: str, *, waits: bool) -> None:
        """The orders of this program have been recognised as an arc; `waits`: for its rise."""
        if who in self._sources:
            self.tracking.recognise(self._sources[who], words, waits=waits)

    def act(self) -> None:
        """The control thread is woken by an order."""
        self.loop.act()

    def hand(self, words: list[str]) -> None:
        """A person moves a part of the front panel, where it has that part."""
        hands(self.world)(parse_hand(words))

    def end(self) -> None:
        """SIGTERM: a proper end. Raises HardwareError."""
        self.tracking.end()
        for who in list(self._sessions):
            self.leave(who)
        self.loop.stop()
        self.station.rotor.off()
        if isinstance(rotor := self.station.rotor, RelayRotor):
            # In real time the guard's thread engages the brakes, and the end waits for it.
            rotor.bank.leave(BRAKE_AFTER_S)
            self._clock.sleep(BRAKE_AFTER_S if rotor.bank.released else 0.0)
        if self.panel:
            self.panel.dark()
        self.station.close()
        if self._relays:
            self._relays.note({axis: self.loop.status.axis(axis).trusts for axis in Axis}, ending=True)
        self._lane.save()
        self._learns(self._autosave.close)
        self.alive = False

    def die(self) -> None:
        """SIGKILL: the program sends nothing more to any chip, and its sentinel opens the relays."""
        self.alive = False
        self.tracking.end()
        self.world.gpio.bury_process()
        self._clock.sleep(SENTINEL_S)
        if self.station.lines:
            clock, brakes = self._clock, self.sentinel.brakes_off
            switch_off(self.world.gpio, self.station.lines, clock, clock.sleep, 0.0, unbraked=brakes)

    def _session(self, who: str) -> tuple[Session, Client]:
        if who not in self._sessions:
            self._sources[who] = source = Source(who, next(self._numbers))
            client = Client(self.loop, self._mount, source, clock=self._clock)
            self._sessions[who] = self._speaks(who, client), client
        return self._sessions[who]

    def _speaks(self, who: str, client: Client) -> Session:
        if who == PAGE:
            return Browser(client, self.tracking.tracker, self._sources[who])
        if who.startswith("console"):
            return ConsoleSession(client, hands(self.world), self.tracking.tracker)
        place = {"udp": "127.0.0.1:12000"} if who == "pstrotator" else {"tcp": "127.0.0.1:4000"}
        calibrates = {"may_calibrate": True} if who == "gs232a" else {}
        return session_maker(Link.model_validate({"protocol": PROTOCOLS[who], **place, **calibrates}))(client)

    def _panel(self, state: State) -> PanelThread:
        parts = self.station.panel
        assert parts is not None
        return panel_thread(
            self.config,
            parts,
            lambda: self.loop.status,
            lambda order: self.loop.post(PANEL, order),
            self._clock,
            state=state,
            pulses=self.station.rotor.closed_contacts,
        )

    def _add_alarm(self, due_s: Callable[[], float | None], ring: Callable[[float], None]) -> None:
        """Let the clock call the guard as long as the program lives."""
        self._clock.add_alarm(lambda: due_s() if self.alive else None, ring)
