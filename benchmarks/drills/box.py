"""The box of a drill: the real drivers on simulated chips, the control loop and sessions, in simulated time.

Knows how to build it from a configuration, to run a cycle, to hand bytes to a link, and to end it: properly, as with
SIGTERM, or killed. The simulated world and the state folder outlive it. Does not know what is right or wrong.
"""

from __future__ import annotations

import itertools
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import tomlkit

from benchmarks.drills.browser import Browser
from benchmarks.drills.script import PAGE, Drill
from benchmarks.drills.sentinel import DrilledSentinel
from benchmarks.drills.speech import PROTOCOLS
from benchmarks.drills.tracking import DrilledTracking
from firmware_sim.clock import SimClock
from firmware_sim.rotors.rotor import SimRotor
from hw.ports import Axis
from hw.safety.lines_off import switch_off
from rotator.assembly.hands import hands
from rotator.assembly.kept_files import build_learnt, build_relays_file, build_tries_file
from rotator.assembly.panel import panel_thread
from rotator.assembly.sessions import session_maker
from rotator.assembly.settings import build_controller, build_mount, build_offsets
from rotator.assembly.station import Station
from rotator.cli.rehearse import simulated
from rotator.config.links import Link
from rotator.config.load import parse, shipped
from rotator.config.model import Config
from rotator.exchange.sources import Source
from rotator.panel.thread import PanelThread
from rotator.protocols.console_session import ConsoleSession
from rotator.protocols.panel_words import parse_hand
from rotator.protocols.session import Session
from rotator.runtime.autosave import CALIBRATIONS_EVERY_S, Autosave
from rotator.runtime.client import Client
from rotator.runtime.event_watch import EventWatch
from rotator.runtime.loop import ControlLoop
from rotator.store import counts, knobs, latch
from rotator.store.latch import LatchFile

SENTINEL_S = 0.04
"""Seconds after the death of the program until its sentinel has opened the relays (docs/safety.md)."""
PANEL = Source("panel")


def configured(drill: Drill, folder: Path) -> Config:
    """The shipped configuration with the drill's keys, on a simulated rotor that outlives the program."""
    values = tomllib.loads(shipped(drill.profile))
    for table in ("link", "lcd", "panel", "limits"):
        values.pop(table, None)
    _merge(values, drill.tables)
    _merge(
        values, {"lcd": {"kind": "none"}, "rotor": {"hardware": "sim"}, "state": {"path": str(folder / "state.json")}}
    )
    # With a world file the box keeps files of its own and trusts them. The drill itself keeps the world in memory.
    _merge(values, {"sim": {"world": str(folder / "world.json"), "bus_takes_time": False}})
    return simulated(parse(tomlkit.dumps(values), drill.profile))


def _merge(values: dict[str, Any], more: dict[str, Any]) -> None:
    for key, value in more.items():
        if isinstance(value, dict):
            _merge(values.setdefault(key, {}), value)
        else:
            values[key] = value


class Box:
    """One run of the program. `world`: the simulated rotor that an earlier run has left; None: a new one."""

    def __init__(
        self, drill: Drill, config: Config, folder: Path, clock: SimClock, world: SimRotor | None, *, begun_s: float
    ) -> None:
        """`begun_s`: when the drill began, on the clock."""
        self.config = config
        self._clock = clock
        self._folder = folder
        self.alive = True
        self.sentinel = DrilledSentinel(clock)
        if world is not None:
            world.bus.open()
        self.station = Station(
            config,
            clock,
            clock.sleep,
            drill.start_deg,
            add_alarm=self._add_alarm,
            counts=folder / counts.FILE_NAME,
            world=world,
            watch=self.sentinel,
        )
        assert self.station.world is not None
        self.world: SimRotor = self.station.world
        memory = folder.with_name("memory")
        memory.mkdir(exist_ok=True)
        learnt, relays = build_learnt(config), build_relays_file(config, memory)
        commissioning = Axis(drill.commissioning) if drill.commissioning else None
        trusts = relays.begin() if relays else None
        kept, tried = LatchFile(folder / latch.FILE_NAME, memory), build_tries_file(config, memory)
        assert tried is not None, "the rotor of a drill outlives its program"
        stopped, tries = kept.load(), tried.load()
        controller = build_controller(
            config, learnt.load(), commissioning, trusts=trusts, tries=tries, latch=stopped, panel=config.panel.fitted
        )
        self.events = EventWatch(clock)
        """The watch over the event loop that serves the links; the drill ticks for it."""
        self.loop = ControlLoop(
            controller,
            self.station.rotor,
            clock,
            1 / config.control.rate_hz,
            after_good_step=self.station.beat,
            events=self.events,
            keep_latch=kept.save,  # the thread that writes it takes no simulated time
            keep_tries=tried.save,
        )
        tried.save(tries)
        self._autosave = Autosave(self.loop, None, build_offsets(config), learnt, relays, tries=tried)
        self._kept_s = clock()
        self._mount = build_mount(config)
        self._numbers = itertools.count(1)
        self._sessions: dict[str, tuple[Session, Client]] = {}
        self._sources: dict[str, Source] = {}
        """By link or person: the source of its session."""
        self.tracking = DrilledTracking(config, self.loop, self._mount, clock, begun_s)
        self.panel = self._panel() if config.panel.fitted else None

    def cycle(self, *, blind: bool = False) -> None:
        """One turn of the control loop; `blind`: the reading thread hangs."""
        if blind:
            self.loop.act()
        else:
            self.loop.cycle()
        if self.panel:
            self.panel.cycle(self._clock())
        if self._clock() - self._kept_s >= CALIBRATIONS_EVERY_S:
            self._kept_s = self._clock()
            self._autosave.keep_relays()

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

    def recognise(self, who: str, words: str) -> None:
        """The orders of this program have been recognised as an arc."""
        if who in self._sources:
            self.tracking.recognise(self._sources[who], words)

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
        if self.panel:
            self.panel.dark()
        self.station.close()
        self._autosave.close()
        self.alive = False

    def die(self) -> None:
        """SIGKILL: the program sends nothing more to any chip, and its sentinel opens the relays."""
        self.alive = False
        self.tracking.end()
        self.world.gpio.bury_process()
        self._clock.sleep(SENTINEL_S)
        if self.station.lines:
            switch_off(self.world.gpio, self.station.lines, self._clock, self._clock.sleep, 0.0)

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
        return session_maker(Link.model_validate({"protocol": PROTOCOLS[who], **place, **calibrates}), client)

    def _panel(self) -> PanelThread:
        parts = self.station.panel
        assert parts is not None
        return panel_thread(
            self.config,
            parts,
            lambda: self.loop.status,
            lambda order: self.loop.post(PANEL, order),
            self._clock,
            knobs=self._folder / knobs.FILE_NAME,
            pulses=self.station.rotor.closed_contacts,
        )

    def _add_alarm(self, due_s: Callable[[], float | None], ring: Callable[[float], None]) -> None:
        """Let the clock call the guard as long as the program lives."""
        self._clock.add_alarm(lambda: due_s() if self.alive else None, ring)
