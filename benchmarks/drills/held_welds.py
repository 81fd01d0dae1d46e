"""Drills about one cause: a relay welds, and something holds its axis soon after the relay was switched off.

A branch, a rope, or a stop that is nearer than a drifted sensor says holds the axis: the box must not take the relay
for open because the axis stands. `python -m benchmarks.drills.held_welds --seed N --count 100 [--kind relay-pulse]`;
with `--healthy` no relay welds, and the command counts the drills in which the box suspects one. Knows how such a drill
is drawn. Judges nothing.
"""

from __future__ import annotations

import argparse
import random
import sys
from collections import Counter
from pathlib import Path

from benchmarks.drills.boxes import BOTH, KINDS, Mast, draw_mast
from benchmarks.drills.play import play
from benchmarks.drills.script import COMMON_LINKS, PEOPLE, PROGRAM, WORLD, Arg, Drill, Event

WAYS = (("cw", "ccw"), ("up", "down"))
LONGEST_S = 1.5
"""The obstacle is at most as far away as the axis turns in this time at full speed."""
SUSPECTED = "relay not seen to open"
KEPT = Path("run/drills")


class HeldWeld:
    """The events of one drill: moves, a weld, something in the way, a stop, and orders the other way."""

    def __init__(self, seed: str, kind: str, *, healthy: bool) -> None:
        self._chance = random.Random(f"{seed} {kind}")
        self._mast = draw_mast(self._chance, KINDS[kind])
        self._axis, self._way = self._chance.randrange(2), self._chance.randrange(2)
        self._link, self._other = self._chance.sample(COMMON_LINKS, 2)
        self._person = self._chance.choice(PEOPLE)
        self._now_s = 0.2
        self._events: list[Event] = []
        self._tell(healthy=healthy)
        self.drill = self._drill(seed)

    def _tell(self, *, healthy: bool) -> None:
        chance, name = self._chance, BOTH[self._axis]
        if self._mast.rotor.kind == "relay-pulse":
            for axis in BOTH:
                self._add(self._person, "confirm", axis, 0.0)
        if chance.random() < 0.4:
            self._add(WORLD, "sticks", name, chance.uniform(0.02, 0.15))
        if self._mast.has_pots and chance.random() < 0.5:
            self._add(WORLD, "drift", name, chance.uniform(-0.1, 0.1), chance.uniform(1.0, 10.0))
            self._now_s += chance.choice((0.0, 20.0, 60.0, 100.0))
        for _ in range(chance.choice((0, 0, 1, 2))):
            self._move(chance.randrange(2))
            self._pass(0.3, 1.0, 3.0, 6.0)
            self._stop()
            self._pass(0.3, 1.0, 3.0, 6.0)
        self._move(self._way)
        self._pass(0.0, 0.5, 2.0, 4.0)
        if not healthy:
            self._add(WORLD, "weld", name, 1.0 if self._way == 0 else -1.0)
        self._pass(0.1, 0.3, 1.0, 2.0, 4.0, 8.0)
        if chance.random() < 0.6 and not healthy:
            self._add(WORLD, "obstacle", name, chance.uniform(0.0, LONGEST_S) * self._mast.speed_dps[self._axis])
            self._pass(0.0, 0.0, 0.05, 0.5)
        self._stop()
        self._pass(0.0, 0.1, 0.3, 1.0, 2.0, 4.0, 8.0, 20.0)
        if chance.random() < 0.15:
            self._add(PROGRAM, "restart", chance.choice((0.5, 2.0)))
            self._now_s += 5.0
        for _ in range(chance.choice((1, 2, 3))):
            self._add(self._person, "resume")
            self._pass(0.0, 0.1, 1.0)
            self._move(1 - self._way)
            self._pass(0.3, 1.0, 2.0, 5.0, 10.0)
            if chance.random() < 0.5:
                self._stop()
                self._pass(0.1, 1.0, 3.0, 10.0)

    def _add(self, who: str, what: str, *args: Arg) -> None:
        rounded = tuple(round(each, 3) if isinstance(each, float) else each for each in args)
        self._events.append(Event(round(self._now_s, 3), who, what, rounded))

    def _pass(self, *pauses_s: float) -> None:
        self._now_s += self._chance.choice(pauses_s)

    def _stop(self) -> None:
        self._add(self._chance.choice((self._link, self._other, self._person)), "stop")

    def _move(self, way: int) -> None:
        chance = self._chance
        aim_deg = [round(chance.uniform(0.1, 0.9) * top_deg) for top_deg in self._mast.top_deg]
        low, high = ((0.6, 1.0), (0.0, 0.4))[way]
        aim_deg[self._axis] = round(chance.uniform(low, high) * self._mast.top_deg[self._axis])
        match chance.randrange(4):
            case 0:
                self._add(self._link, "jog", WAYS[self._axis][way])
            case 1:
                self._add(self._person, "jog", WAYS[self._axis][way], chance.choice((0.5, 2.0, 5.0)))
            case 2:
                self._add(self._link, "aim", *aim_deg)
            case _:
                self._add(self._link, "stream", *aim_deg, 0.0, 0.0, 1.0, chance.choice((3.0, 10.0, 30.0)))

    def _drill(self, seed: str) -> Drill:
        mast: Mast = self._mast
        tables = {key: value for key, value in mast.tables.items() if key not in ("panel", "sky", "mount")}
        seconds, events = self._now_s + 5.0, tuple(sorted(self._events, key=lambda event: event.at_s))
        return Drill(mast.rotor.kind, mast.rotor.profile, seconds, mast.start_deg, tables, "", events, seed)


def main() -> None:
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.drills.held_welds", description=(__doc__ or "").splitlines()[0]
    )
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=100, help="number of drills")
    parser.add_argument("--kind", choices=("relay-pot", "relay-pulse"), default="relay-pot")
    parser.add_argument("--healthy", action="store_true", help="no relay welds: in how many drills is one suspected?")
    given = parser.parse_args()
    judged: Counter[str] = Counter()
    hours = 0.0
    for number in range(given.count):
        drill = HeldWeld(f"{given.seed}.{number}", given.kind, healthy=given.healthy).drill
        outcome, hours = play(drill), hours + drill.seconds / 3600.0
        judged[SUSPECTED] += any("FAULT" in line and SUSPECTED in line for line in outcome.said)
        for violation in outcome.violations[:1]:
            judged[violation.judge] += 1
            KEPT.mkdir(parents=True, exist_ok=True)
            path = KEPT / f"held-{drill.seed}-{drill.kind}.json"
            path.write_text(drill.to_json(), encoding="utf-8")
            print(f"{violation}; replay it: python -m benchmarks.drills --replay {path}", flush=True)
    print(f"{given.count} drills, {hours:.1f} hours:", ", ".join(f"{name} {n}" for name, n in judged.items()))
    sys.exit(sum(judged.values()) > judged[SUSPECTED])


if __name__ == "__main__":
    main()
