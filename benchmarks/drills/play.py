"""Plays a drill: the box in simulated time, the events at their moments, and the judges after every cycle.

Knows time, and what ends and begins the program. Does not know how an event changes the world (`befall`), nor what the
judges forbid.
"""

from __future__ import annotations

import logging
import math
import random
import tempfile
import traceback
from collections import deque
from dataclasses import dataclass, field, replace
from pathlib import Path

from benchmarks.drills.accusations import Violation
from benchmarks.drills.befall import WorldEvents
from benchmarks.drills.box import Box
from benchmarks.drills.card import WORKS, Card
from benchmarks.drills.claims import Claims
from benchmarks.drills.configured import configured
from benchmarks.drills.hearing import Hearing
from benchmarks.drills.judges import Judges
from benchmarks.drills.scene import KEEP_THEIR_ORDER, axis_cases, begins_anew, build_orders, lapse
from benchmarks.drills.script import CLOCK, PANEL, PROGRAM, WORLD, Drill, Event
from benchmarks.drills.sectors import Sectors
from benchmarks.drills.silence import Silence, Words
from benchmarks.drills.trouble import Troubles
from benchmarks.drills.world import World
from firmware_sim.clock import SimClock

STARTED_S = 1000.0
STEP_S = 0.05
"""How often the world is looked at while no control cycle comes."""
FAILS = "the program ends with an exception, or its sentinel kills it"


@dataclass(slots=True)
class Outcome:
    """The result of a drill."""

    violations: list[Violation] = field(default_factory=list)
    said: list[str] = field(default_factory=list)
    """The box's log, for a person who examines a violation."""


def play(drill: Drill) -> Outcome:
    """Play the drill to its end, or to the first violation."""
    log = logging.getLogger()
    handlers, level = log.handlers, log.level
    with tempfile.TemporaryDirectory(prefix="drill-") as folder:
        try:
            return _Play(drill, Path(folder)).run()
        finally:
            log.handlers, log.level = handlers, level


class _Play:
    def __init__(self, drill: Drill, folder: Path) -> None:
        self._drill = drill
        now, memory = folder / "now", folder / "memory"
        now.mkdir()
        memory.mkdir()
        self._card = Card(now, memory)
        self._clock = SimClock(STARTED_S)
        self._words = Words(lambda: self._now_s)
        log = logging.getLogger()
        log.handlers, log.level = [self._words], logging.WARNING
        self._chance = random.Random(drill.seed)
        self._config = configured(drill, now)
        self._box = Box(drill, self._config, self._card, self._clock, None, begun_s=STARTED_S)
        self._world = World(self._box.world, self._clock)
        self._troubles = Troubles(self._box.world, self._clock, drill.seed)
        self._cases = axis_cases(self._config, self._world.axes)
        self._orders = build_orders(
            self._config, self._world.axes, self._cases, lacking=drill.commissioning, left_alone=drill.left_alone
        )
        has_master = self._config.rotor.switched and self._config.relays.master is not None
        self._judges = Judges(self._cases, self._orders, master=has_master)
        self._silence = Silence(self._words, self._cases)
        self._claims = Claims(self._cases)
        self._sectors = Sectors(self._config, self._cases)
        self._judges.goes_round = self._orders.goes_round = bool(self._sectors)
        self._world_events = WorldEvents(
            self._config,
            self._cases,
            judges=self._judges,
            silence=self._silence,
            troubles=self._troubles,
            card=self._card,
        )
        self._period_s = 1 / self._config.control.rate_hz
        self._blind = False
        """The reading thread hangs."""
        self._blind_until_s = self._jitter_until_s = self._jitter_s = 0.0
        self._hearing = Hearing(self._box, self._world, self._orders, self._cases)
        self._acknowledged_s = 0.0
        self._back_s = 0.0
        """When the program last started: events that were sent before are lost."""

    @property
    def _now_s(self) -> float:
        return self._clock() - STARTED_S

    def run(self) -> Outcome:
        outcome = Outcome()
        try:
            self._run()
        except Exception as failure:
            where = traceback.extract_tb(failure.__traceback__)[-1]
            text = f"{type(failure).__name__}: {failure} ({Path(where.filename).name}:{where.lineno})"
            outcome.violations.append(Violation(self._now_s, FAILS, "program", text))
        outcome.violations += self._found()
        outcome.said = [f"{at_s:9.2f} s  {line}" for at_s, line in self._words.lines]
        if self._box.alive:
            self._card.become(WORKS)
            self._box.end()
        return outcome

    def _run(self) -> None:
        events = deque(sorted(lapse(self._drill), key=lambda event: event.at_s))
        next_s = 0.0
        while self._now_s < self._drill.seconds and not self._found():
            if events and events[0].at_s <= next_s:
                event = events.popleft()
                self._sleep_until(event.at_s)
                before_s = self._now_s
                self._happen(replace(event, at_s=before_s), late_s=before_s - event.at_s)
                if self._now_s > before_s + self._period_s:  # the control thread did not run meanwhile
                    next_s = self._now_s
                continue
            self._sleep_until(next_s)
            self._hearing.tick(self._now_s)
            self._box.tracking.turn()
            self._cycle()
            self._look()
            late_s = self._chance.uniform(0.0, self._jitter_s) if self._now_s < self._jitter_until_s else 0.0
            next_s += self._period_s
            next_s = max(next_s, self._now_s + late_s)

    def _cycle(self) -> None:
        blind = self._now_s < self._blind_until_s
        if self._blind and not blind:
            self._silence.end("hung")
        self._blind = blind
        self._box.cycle(blind=blind)

    def _found(self) -> list[Violation]:
        found = [*self._judges.found, *self._sectors.found, *self._claims.found, *self._silence.found]
        if self._box.alive and self._box.sentinel.kills:
            found.append(Violation(self._now_s, FAILS, "program", "its sentinel hears nothing while a relay is closed"))
        return found

    def _sleep_until(self, at_s: float) -> None:
        self._clock.sleep_until(STARTED_S + at_s)

    def _look(self) -> None:
        now_s = self._now_s
        self._troubles.look()
        self._world.look()
        self._orders.expire(now_s)
        self._judges.look(now_s, self._world.axes)
        self._judges.count(self._world.relay_starts)
        self._sectors.look(now_s, self._world.axes)
        fitted = [axis.value for axis in self._config.fitted]
        ordered = self._orders.sure and any(map(self._orders.holds, fitted))
        there = self._judges.there(self._world.axes)
        if self._orders.stops.acknowledged_s != self._acknowledged_s:
            self._acknowledged_s = self._orders.stops.acknowledged_s
            self._silence.acknowledged()
        elsewhere = self._judges.elsewhere(self._world.axes) if self._orders.sure else frozenset()
        coming = self._judges.coming(self._world.axes)
        self._world_events.look(now_s)
        status = self._box.loop.status
        self._claims.look(now_s, self._world.axes, status)
        places = {"there": there, "elsewhere": elsewhere, "coming": coming}
        self._silence.look(now_s, self._world.axes, status, ordered=ordered, **places)

    def _happen(self, event: Event, late_s: float) -> None:
        match event.who:
            case str(who) if who == WORLD:
                self._world_events.befall(event)
            case str(who) if who == CLOCK:
                self._be_late(event)
            case str(who) if who == PROGRAM:
                self._restart(event)
            case str(who) if who == PANEL:
                self._orders.note(event)
                words = [f"{word:.3f}" if isinstance(word, float) else str(word) for word in (event.what, *event.args)]
                self._box.hand(words)
            case _ if event.at_s - late_s >= self._back_s:
                self._hearing.hear(event)

    def _be_late(self, event: Event) -> None:
        seconds = event.number(0)
        match event.what:
            case "late":
                self._pass(seconds, dead=False)
            case "hung":
                self._blind, self._blind_until_s = True, self._now_s + seconds
                self._silence.begin("hung", self._now_s)
            case "stalled" | "page-stalled":
                self._hearing.stall(self._now_s, seconds, page=event.what == "page-stalled")
            case "plans":
                self._box.tracking.planner.takes_s = seconds
            case "plans-fail":
                self._box.tracking.planner.fails = bool(seconds)
            case "set":
                self._box.tracking.ahead_s += seconds
            case "jitter":
                self._jitter_until_s, self._jitter_s = self._now_s + seconds, event.number(1)

    def _restart(self, event: Event) -> None:
        """The program ends, and starts again after the seconds that the event gives. Only the files in its folder
        remain."""
        killed = event.what == "kill"
        self._judges.ends_at_once = not killed or self._config.rotor.type not in KEEP_THEIR_ORDER
        self._card.end_program(self._now_s, self._box.die if killed else self._box.end, killed=killed)
        self._orders.forget_all(self._now_s)
        self._pass(event.number(0), dead=True)
        self._box = Box(self._drill, self._config, self._card, self._clock, self._box.world, begun_s=STARTED_S)
        self._hearing.begin_anew(self._box)
        self._card.program_begins()
        self._back_s = self._now_s
        begins_anew(self._config, self._cases, self._world.axes, killed=killed)

    def _pass(self, seconds: float, *, dead: bool) -> None:
        """The world goes on, and the control thread does not run."""
        self._judges.unattended_s = self._now_s
        # While only the control thread stands still, the guard ends every command. A dead program leaves its chips as
        # they are.
        self._judges.ends_at_once = not dead or self._config.rotor.type not in KEEP_THEIR_ORDER
        for _ in range(math.ceil(seconds / STEP_S)):
            self._clock.sleep(STEP_S)
            self._troubles.look()
            self._world.look()
            self._judges.look(self._now_s, self._world.axes)
            self._sectors.look(self._now_s, self._world.axes)
        self._judges.unattended_s = math.inf
        self._silence.pause(self._now_s)
