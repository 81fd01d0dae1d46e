"""A drill at random from a seed: a box, programs and people that give it orders, and a world that fails it.

Knows how often each event happens. The same seed and number draw the same drill. Does not judge.
"""

from __future__ import annotations

import random

from benchmarks.drills.arcs import draw_arc
from benchmarks.drills.boxes import BOTH, KINDS, ROTORS, Mast, draw_mast
from benchmarks.drills.browser import draw_browser
from benchmarks.drills.mounts import mounted
from benchmarks.drills.outages import draw_outages
from benchmarks.drills.script import CLOCK, COMMON_LINKS, PANEL, PEOPLE, PROGRAM, WORLD, Arg, Drill, Event
from benchmarks.drills.stories import stories
from benchmarks.drills.unusual import prolonged, relinked, tabled, unusual

STORIES = 0.9
SHORTEST_S, LONGEST_S = 30.0, 900.0
WAYS = ("cw", "ccw", "up", "down")
BADS = ("zero", "full", "far", "near", "last")
JUNK = ("W1", "\x00\xff", "P nan nan\n", "AZ EL 12\n", "M 99 99\r", "stop?", ";;;", "<PST>", "\r\n", "W999 999\r")


def draw(seed: str, kind: str = "") -> Drill:
    """`kind`: of the rotor; empty: any."""
    chance = random.Random(seed)
    rotor = KINDS[kind] if kind else chance.choice(ROTORS)
    mast = mounted(random.Random(f"{seed} mount"), draw_mast(chance, rotor))
    mast = unusual(random.Random(f"{seed} unusual"), mast)
    if chance.random() < STORIES:
        told, ends_s = stories(chance, mast, lambda: _trouble(chance, mast))
        return _drill(mast, ends_s, told, seed)
    seconds = round(SHORTEST_S * (LONGEST_S / SHORTEST_S) ** chance.random(), 1)
    events: list[Event] = []
    for who in chance.sample(COMMON_LINKS, chance.choice((1, 1, 1, 2, 3))):
        events += _program(chance, mast, who, seconds)
    for who in PEOPLE:
        if chance.random() < 0.4:
            events += _person(chance, mast, who, seconds)
    if mast.has_panel:
        events += _panel(chance, seconds)
    moments_s = [event.at_s for event in events] or [0.0]
    events += _troubles(chance, mast, seconds, moments_s)
    events += _time(chance, seconds, moments_s)
    events = [event for event in events if event.at_s < seconds]
    return _drill(mast, seconds, events, seed)


def _drill(mast: Mast, seconds: float, events: list[Event], seed: str) -> Drill:
    events = events + draw_browser(seed, mast, seconds, [event.at_s for event in events] or [0.0])
    other = random.Random(f"{seed} other")
    events, seconds = prolonged(other, mast, tabled(other, relinked(other, events)), seconds)
    outages, seconds = draw_outages(seed, mast, seconds)
    return Drill(
        kind=mast.rotor.kind,
        profile=mast.rotor.profile,
        seconds=seconds,
        start_deg=mast.start_deg,
        tables=mast.tables,
        commissioning=mast.commissioning,
        events=tuple(sorted(events + outages, key=lambda event: event.at_s)),
        seed=seed,
    )


def _event(at_s: float, who: str, what: str, *args: Arg) -> Event:
    return Event(round(max(0.0, at_s), 3), who, what, tuple(round(a, 3) if isinstance(a, float) else a for a in args))


def _moments(chance: random.Random, seconds: float) -> list[float]:
    """The moments of one sender's orders: from one an hour to many a second, at even intervals or at random."""
    rate_hz = 10.0 ** chance.uniform(-3.5, 0.5)
    count = min(200, max(1, round(rate_hz * seconds)))
    return sorted(chance.uniform(0.0, seconds) for _ in range(count))


def _azimuth(chance: random.Random, mast: Mast) -> float:
    """An azimuth at random, often at an end of the range, beyond it, or across north."""
    match chance.randrange(8):
        case 0:
            return chance.choice((0.0, 1.0, 359.0, 360.0))
        case 1:
            return min(450.0, mast.top_deg[0] - chance.uniform(-5.0, 5.0))
        case _:
            return float(chance.randrange(round(mast.top_deg[0])))


def _elevation(chance: random.Random, mast: Mast) -> float:
    return chance.choice((0.0, mast.top_deg[1], float(chance.randrange(round(mast.top_deg[1]))), 45.0))


def _program(chance: random.Random, mast: Mast, who: str, seconds: float) -> list[Event]:
    style = chance.choice(("aims", "stream", "stream", "jogs", "mixed", "mixed", "flood", "flicker"))
    if style == "stream":
        return _stream(chance, mast, who, seconds)
    if style == "flood":
        at_s, rate_hz = chance.uniform(0.0, seconds), chance.choice((10.0, 50.0, 200.0, 1000.0))
        count = min(2000.0, rate_hz * chance.uniform(0.5, 10.0))
        aim_deg = _azimuth(chance, mast), _elevation(chance, mast)
        spread_deg = chance.choice((0.0, 1.0, 20.0, 180.0))
        orders = _event(at_s, who, "flood", *aim_deg, spread_deg, rate_hz, float(round(count)))
        return [orders, _stop(chance, who, at_s + 12.0)]
    if style == "flicker":
        at_s, around_deg = chance.uniform(0.0, seconds / 2), chance.choice((0.0, 180.0, _azimuth(chance, mast)))
        count = float(chance.randrange(5, 120))
        rate_hz, aim_deg = chance.choice((0.2, 1.0)), ((around_deg - 2.0) % 360.0, _elevation(chance, mast))
        return [_event(at_s, who, "flood", *aim_deg, 4.0, rate_hz, count)]
    events = []
    for at_s in _moments(chance, seconds):
        what = style[:-1] if style != "mixed" else chance.choice(("aim", "aim", "aim", "jog", "jog", "other", "stop"))
        events.append(_order(chance, mast, who, at_s, what))
        if chance.random() < 0.15:
            events.append(_stop(chance, who, at_s + chance.choice((0.05, 0.3, 1.0, 2.0, 5.0, 20.0))))
    return events


def _stop(chance: random.Random, who: str, at_s: float) -> Event:
    if chance.random() < 0.2:
        return _event(at_s, who, "stop-axis", chance.choice(BOTH))
    return _event(at_s, who, "stop")


def _order(chance: random.Random, mast: Mast, who: str, at_s: float, what: str) -> Event:
    match what:
        case "aim":
            if chance.random() < 0.2:
                return _event(at_s, who, "aim-azimuth", _azimuth(chance, mast))
            if chance.random() < 0.1:
                return _event(at_s, who, "aim-elevation", _elevation(chance, mast))
            return _event(at_s, who, "aim", _azimuth(chance, mast), _elevation(chance, mast))
        case "jog":
            return _event(at_s, who, "jog", chance.choice(WAYS))
        case "stop":
            return _stop(chance, who, at_s)
    match chance.randrange(9):
        case 0:
            return _event(at_s, who, "park")
        case 1:
            points = [float(chance.randrange(round(top))) for _ in range(3) for top in mast.top_deg]
            return _event(at_s, who, "list", float(chance.choice((1, 5, 30))), *points)
        case 2:
            return _event(at_s, who, "run-list")
        case 3:
            return _event(at_s, who, "leave")
        case 4:
            return _event(at_s, who, "calibrate", chance.choice(BOTH), chance.choice(("low", "high")))
        case 5:
            return _event(at_s, who, "speed", float(chance.randrange(1, 5)))
        case 6:
            return _event(at_s, who, "junk", chance.choice(JUNK))
        case _:
            return _event(at_s, who, "ask")


def _stream(chance: random.Random, mast: Mast, who: str, seconds: float) -> list[Event]:
    """A program that tracks: orders at even intervals along a path, then perhaps a stop."""
    at_s, every_s = chance.uniform(0.0, seconds / 2), chance.choice((0.1, 0.5, 1.0, 1.0, 2.0, 5.0))
    lasts_s = chance.uniform(10.0, max(20.0, seconds - at_s))
    rates_dps = chance.choice((0.0, 0.1, 0.5, 2.0)) * chance.choice((-1, 1)), chance.uniform(-0.5, 0.5)
    aim_deg = _azimuth(chance, mast), _elevation(chance, mast)
    count = float(max(1, min(1000, round(lasts_s / every_s))))
    events = [_event(at_s, who, "stream", *aim_deg, *rates_dps, every_s, count)]
    if chance.random() < 0.5:
        events.append(_stop(chance, who, at_s + count * every_s * chance.uniform(0.2, 1.1)))
    return events


def _person(chance: random.Random, mast: Mast, who: str, seconds: float) -> list[Event]:
    events = []
    for _ in range(chance.randrange(1, 8)):
        at_s = chance.uniform(0.0, seconds)
        match chance.randrange(12):
            case 10:
                events.append(_event(at_s, CLOCK, "plans", chance.choice((0.1, 1.0, 10.0))))
                events.append(_event(at_s, who, "track", draw_arc(chance, at_s)))
            case 11:
                events.append(_event(at_s, who, "track", chance.choice(("off", "plan"))))
            case 0 | 1:
                events.append(_event(at_s, who, "stop"))
                if chance.random() < 0.7:
                    events.append(_event(at_s + chance.uniform(0.5, 60.0), who, "resume"))
            case 2:
                events.append(_event(at_s, who, "resume"))
            case 3:
                events.append(_event(at_s, who, "storm"))
                if chance.random() < 0.7:
                    events.append(_event(at_s + chance.uniform(5.0, 120.0), who, "resume"))
            case 4 if mast.rotor.kind == "relay-pulse":
                events.append(_event(at_s, who, "home", chance.choice(BOTH)))
            case 5 if mast.rotor.kind in ("relay-pulse", "moteus", "servo"):
                events.append(_event(at_s, who, "confirm", chance.choice(BOTH), chance.choice((0.0, 0.0, 1.0, -2.0))))
            case 6 if chance.random() < 0.3:
                events.append(_event(at_s, who, "let-go"))
            case 7:
                events.append(_event(at_s, who, "aim", _azimuth(chance, mast), _elevation(chance, mast)))
            case 8:
                events.append(_event(at_s, who, "leave"))
            case _:
                events.append(_event(at_s, who, "jog", chance.choice(WAYS), chance.choice((0.1, 0.5, 1.0, 2.0, 5.0))))
    return events


def _panel(chance: random.Random, seconds: float) -> list[Event]:
    events = [_event(0.5, PANEL, "mode", "auto")] if chance.random() < 0.8 else []
    for _ in range(chance.randrange(0, 6)):
        at_s = chance.uniform(0.0, seconds)
        match chance.randrange(5):
            case 0:
                events.append(_event(at_s, PANEL, "mode", chance.choice(("auto", "manual", "jog", "park"))))
                events.append(_event(at_s + chance.uniform(3.0, 90.0), PANEL, "mode", "auto"))
            case 1:
                events.append(_event(at_s, PANEL, "stop", "press"))
                events.append(_event(at_s + chance.uniform(0.1, 60.0), PANEL, "stop", "release"))
            case 2:
                events.append(_event(at_s, PANEL, "knob", chance.choice(BOTH), chance.random()))
            case _:
                events.append(_event(at_s, PANEL, "jog", chance.choice(WAYS), chance.choice((0.1, 0.5, 3.0))))
    return events


def _when(chance: random.Random, seconds: float, moments_s: list[float]) -> float:
    """A moment at random, often within seconds of an order: while the motor starts, runs, stops, or waits."""
    if chance.random() < 0.6:
        return chance.choice(moments_s) + chance.uniform(-0.3, 6.0)
    return chance.choice((0.0, chance.uniform(0.0, seconds)))


def _troubles(chance: random.Random, mast: Mast, seconds: float, moments_s: list[float]) -> list[Event]:
    """Faults, one or several at a time, and their ends."""
    events: list[Event] = []
    for _ in range(chance.choice((0, 0, 1, 1, 1, 2, 2, 3, 4))):
        at_s, lasts_s = _when(chance, seconds, moments_s), 10.0 ** chance.uniform(-1.0, 2.5)
        begins, ends = _trouble(chance, mast)
        events.append(_event(at_s, WORLD, *begins))
        if ends and chance.random() < 0.7:
            events.append(_event(at_s + lasts_s, WORLD, *ends))
    return events


Happening = tuple[Arg, ...]


def _trouble(chance: random.Random, mast: Mast) -> tuple[tuple[str, *Happening], tuple[str, *Happening] | None]:
    rotor, axis = mast.rotor, chance.choice(BOTH)
    choices = ["fault", "fault"]
    if rotor.relays:
        choices += ["weld", "weld", "pace", "push", "sticks"]
    if mast.has_pots:
        choices += ["every", "burst", "noise", "drift", "stands"]
    if rotor.sporadic or rotor.shared_sporadic:
        choices += ["sporadic", "sporadic"]
    match chance.choice(choices):
        case "weld":
            return ("weld", axis, float(chance.choice((-1, 1)))), ("unweld", axis)
        case "pace":
            return ("pace", axis, chance.uniform(0.3, 1.5)), ("pace", axis, 1.0)
        case "sticks":
            return ("sticks", axis, chance.uniform(0.02, 0.15)), ("sticks", axis, 0.0)
        case "push":
            return ("push", axis, chance.choice((-1, 1)) * chance.uniform(0.05, 0.5)), ("push", axis, 0.0)
        case "every":
            return ("every", axis, float(chance.randrange(2, 33)), chance.choice(BADS)), ("every", axis, 0.0, "zero")
        case "burst":
            return ("burst", axis, chance.uniform(0.05, 3.0), chance.choice(BADS)), None
        case "noise":
            return ("noise", axis, chance.uniform(0.1, 1.0)), ("noise", axis, 0.0)
        case "drift":
            return ("drift", axis, chance.uniform(-0.1, 0.1), chance.uniform(1.0, 10.0)), None
        case "stands":
            return ("stands", axis, 1.0), ("stands", axis, 0.0)
        case "sporadic":
            name = chance.choice([*(f"{axis}-{name}" for name in rotor.sporadic), *rotor.shared_sporadic])
            return ("fault", f"{name}:{chance.randrange(2, 40)}"), ("clear", name)
    names = [f"{axis}-{name}" for name in rotor.faults] + list(rotor.shared)
    if mast.has_switches:
        names += [f"{axis}-low-switch-open", f"{axis}-high-switch-open"]
    name = chance.choice(names)
    return ("fault", name), ("clear", name)


def _time(chance: random.Random, seconds: float, moments_s: list[float]) -> list[Event]:
    """Late cycles, a bus that hangs, and ends of the program while the world goes on."""
    events: list[Event] = []
    for _ in range(chance.choice((0, 0, 0, 1, 2))):
        at_s = _when(chance, seconds, moments_s)
        match chance.randrange(4):
            case 0:
                events.append(_event(at_s, CLOCK, "stalled", chance.choice((0.5, 1.5, 5.0, 20.0))))
            case 1:
                events.append(_event(at_s, CLOCK, "late", chance.choice((0.1, 0.3, 0.6, 1.0, 5.0))))
            case 2:
                events.append(_event(at_s, CLOCK, "hung", chance.choice((0.1, 0.2, 0.5, 3.0))))
            case _:
                events.append(_event(at_s, CLOCK, "jitter", chance.uniform(1.0, 60.0), chance.choice((0.02, 0.1, 0.3))))
    for _ in range(chance.choice((0, 0, 0, 0, 1, 2))):
        what = chance.choice(("restart", "kill"))
        events.append(_event(_when(chance, seconds, moments_s), PROGRAM, what, chance.choice((0.5, 2.0, 5.0, 30.0))))
    return events
