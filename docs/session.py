"""The session that docs/paths/termite.md shows: lines typed at the simulated G-5500, and what it answers.

Plays it through the protocol, the controller and the simulated chips, in simulated time: the same answers everywhere.
"""

from __future__ import annotations

from firmware_sim.clock import SimClock
from rotator.assembly.settings import build_controller, build_mount
from rotator.assembly.station import Station
from rotator.config.load import parse
from rotator.exchange.sources import Source
from rotator.protocols.gs232 import Dialect
from rotator.protocols.gs232_session import Gs232Session
from rotator.runtime.client import Client
from rotator.runtime.loop import ControlLoop

TYPED: tuple[tuple[str, float], ...] = (("c2", 1), ("w235 025", 4), ("c2", 1), ("hello", 1), ("s", 2), ("c2", 1))
"""Each line, and how many seconds pass after it."""


def session() -> str:
    config, clock = parse("", "session"), SimClock()
    period_s = 1 / config.control.rate_hz
    station = Station(config, clock, clock.sleep, (0.0, 0.0), add_alarm=clock.add_alarm)
    loop = ControlLoop(build_controller(config), station.rotor, clock, period_s)
    talk = Gs232Session(Client(loop, build_mount(config), Source("gs232b"), clock=clock), Dialect.B)
    cycles = 0

    def wait(seconds: float) -> None:
        nonlocal cycles
        for _ in range(round(seconds / period_s)):
            cycles += 1
            clock.sleep_until(cycles * period_s)
            loop.cycle()

    wait(1)
    lines = []
    for typed, then_s in TYPED:
        lines.append(f"> {typed}")
        lines += [answer.decode("ascii").rstrip() for answer in talk.receive(f"{typed}\r".encode("ascii"))]
        wait(then_s)
    return "\n".join(lines)


def block() -> str:
    """As it stands on the page."""
    return f"```text\n{session()}\n```\n"
