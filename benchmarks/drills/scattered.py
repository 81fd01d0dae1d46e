"""Orders at random moments: of programs in several styles, of people at a console, and of a front panel.

Knows how often each order is given. Does not know troubles, nor the seed.
"""

from __future__ import annotations

import random

from benchmarks.drills.arcs import draw_arc
from benchmarks.drills.boxes import BOTH, Mast
from benchmarks.drills.script import CLOCK, PANEL, Arg, Event

WAYS = ("cw", "ccw", "up", "down")
JUNK = ("W1", "\x00\xff", "P nan nan\n", "AZ EL 12\n", "M 99 99\r", "stop?", ";;;", "<PST>", "\r\n", "W999 999\r")


def at(at_s: float, who: str, what: str, *args: Arg) -> Event:
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


def program(chance: random.Random, mast: Mast, who: str, seconds: float) -> list[Event]:
    style = chance.choice(("aims", "stream", "stream", "jogs", "mixed", "mixed", "flood", "flicker"))
    if style == "stream":
        return _stream(chance, mast, who, seconds)
    if style == "flood":
        at_s, rate_hz = chance.uniform(0.0, seconds), chance.choice((10.0, 50.0, 200.0, 1000.0))
        count = min(2000.0, rate_hz * chance.uniform(0.5, 10.0))
        aim_deg = _azimuth(chance, mast), _elevation(chance, mast)
        spread_deg = chance.choice((0.0, 1.0, 20.0, 180.0))
        orders = at(at_s, who, "flood", *aim_deg, spread_deg, rate_hz, float(round(count)))
        return [orders, _stop(chance, who, at_s + 12.0)]
    if style == "flicker":
        at_s, around_deg = chance.uniform(0.0, seconds / 2), chance.choice((0.0, 180.0, _azimuth(chance, mast)))
        count = float(chance.randrange(5, 120))
        rate_hz, aim_deg = chance.choice((0.2, 1.0)), ((around_deg - 2.0) % 360.0, _elevation(chance, mast))
        return [at(at_s, who, "flood", *aim_deg, 4.0, rate_hz, count)]
    events = []
    for at_s in _moments(chance, seconds):
        what = style[:-1] if style != "mixed" else chance.choice(("aim", "aim", "aim", "jog", "jog", "other", "stop"))
        events.append(_order(chance, mast, who, at_s, what))
        if chance.random() < 0.15:
            events.append(_stop(chance, who, at_s + chance.choice((0.05, 0.3, 1.0, 2.0, 5.0, 20.0))))
    return events


def _stop(chance: random.Random, who: str, at_s: float) -> Event:
    if chance.random() < 0.2:
        return at(at_s, who, "stop-axis", chance.choice(BOTH))
    return at(at_s, who, "stop")


def _order(chance: random.Random, mast: Mast, who: str, at_s: float, what: str) -> Event:
    match what:
        case "aim":
            if chance.random() < 0.2:
                return at(at_s, who, "aim-azimuth", _azimuth(chance, mast))
            if chance.random() < 0.1:
                return at(at_s, who, "aim-elevation", _elevation(chance, mast))
            return at(at_s, who, "aim", _azimuth(chance, mast), _elevation(chance, mast))
        case "jog":
            return at(at_s, who, "jog", chance.choice(WAYS))
        case "stop":
            return _stop(chance, who, at_s)
    match chance.randrange(9):
        case 0:
            return at(at_s, who, "park")
        case 1:
            points = [float(chance.randrange(round(top))) for _ in range(3) for top in mast.top_deg]
            return at(at_s, who, "list", float(chance.choice((1, 5, 30))), *points)
        case 2:
            return at(at_s, who, "run-list")
        case 3:
            return at(at_s, who, "leave")
        case 4:
            return at(at_s, who, "calibrate", chance.choice(BOTH), chance.choice(("low", "high")))
        case 5:
            return at(at_s, who, "speed", float(chance.randrange(1, 5)))
        case 6:
            return at(at_s, who, "junk", chance.choice(JUNK))
        case _:
            return at(at_s, who, "ask")


def _stream(chance: random.Random, mast: Mast, who: str, seconds: float) -> list[Event]:
    """A program that tracks: orders at even intervals along a path, then perhaps a stop."""
    at_s, every_s = chance.uniform(0.0, seconds / 2), chance.choice((0.1, 0.5, 1.0, 1.0, 2.0, 5.0))
    lasts_s = chance.uniform(10.0, max(20.0, seconds - at_s))
    rates_dps = chance.choice((0.0, 0.1, 0.5, 2.0)) * chance.choice((-1, 1)), chance.uniform(-0.5, 0.5)
    aim_deg = _azimuth(chance, mast), _elevation(chance, mast)
    count = float(max(1, min(1000, round(lasts_s / every_s))))
    events = [at(at_s, who, "stream", *aim_deg, *rates_dps, every_s, count)]
    if chance.random() < 0.5:
        events.append(_stop(chance, who, at_s + count * every_s * chance.uniform(0.2, 1.1)))
    return events


def person(chance: random.Random, mast: Mast, who: str, seconds: float) -> list[Event]:
    events = []
    for _ in range(chance.randrange(1, 8)):
        at_s = chance.uniform(0.0, seconds)
        match chance.randrange(12):
            case 10:
                events.append(at(at_s, CLOCK, "plans", chance.choice((0.1, 1.0, 10.0))))
                events.append(at(at_s, who, "track", draw_arc(chance, at_s)))
            case 11:
                events.append(at(at_s, who, "track", chance.choice(("off", "plan"))))
            case 0 | 1:
                events.append(at(at_s, who, "stop"))
                if chance.random() < 0.7:
                    events.append(at(at_s + chance.uniform(0.5, 60.0), who, "resume"))
            case 2:
                events.append(at(at_s, who, "resume"))
            case 3:
                events.append(at(at_s, who, "storm"))
                if chance.random() < 0.7:
                    events.append(at(at_s + chance.uniform(5.0, 120.0), who, "resume"))
            case 4 if mast.rotor.kind == "relay-pulse":
                events.append(at(at_s, who, "home", chance.choice(BOTH)))
            case 5 if mast.rotor.kind in ("relay-pulse", "moteus", "servo"):
                events.append(at(at_s, who, "confirm", chance.choice(BOTH), chance.choice((0.0, 0.0, 1.0, -2.0))))
            case 6 if chance.random() < 0.3:
                events.append(at(at_s, who, "let-go"))
            case 7:
                events.append(at(at_s, who, "aim", _azimuth(chance, mast), _elevation(chance, mast)))
            case 8:
                events.append(at(at_s, who, "leave"))
            case _:
                events.append(at(at_s, who, "jog", chance.choice(WAYS), chance.choice((0.1, 0.5, 1.0, 2.0, 5.0))))
    return events


def panel(chance: random.Random, seconds: float) -> list[Event]:
    events = [at(0.5, PANEL, "mode", "auto")] if chance.random() < 0.8 else []
    for _ in range(chance.randrange(0, 6)):
        at_s = chance.uniform(0.0, seconds)
        match chance.randrange(5):
            case 0:
                events.append(at(at_s, PANEL, "mode", chance.choice(("auto", "manual", "jog", "park"))))
                events.append(at(at_s + chance.uniform(3.0, 90.0), PANEL, "mode", "auto"))
            case 1:
                events.append(at(at_s, PANEL, "stop", "press"))
                events.append(at(at_s + chance.uniform(0.1, 60.0), PANEL, "stop", "release"))
            case 2:
                events.append(at(at_s, PANEL, "knob", chance.choice(BOTH), chance.random()))
            case _:
                events.append(at(at_s, PANEL, "jog", chance.choice(WAYS), chance.choice((0.1, 0.5, 3.0))))
    return events
