"""How soon the box lets go when something breaks: run `python -m benchmarks.faults`.

Every named fault is injected into the simulated station, with the real drivers, the real control loop and the guard, in
simulated time: the same figures on every machine. Prints the table of docs/safety.md, in Markdown.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache

from firmware_sim.clock import SimClock
from firmware_sim.rotors.relay_pot import SimRelayPotRotor
from hw.ports import Axis, Direction
from rotator.assembly.settings import build_controller
from rotator.assembly.station import Station
from rotator.config.load import parse
from rotator.exchange.orders import Jog, Order, Stop
from rotator.exchange.sources import Source
from rotator.exchange.status import Status
from rotator.runtime.loop import ControlLoop

MASTER = "[relays]\nmaster = 16\n"
SLOW = "[azimuth]\nspeed_dps = 0.5\n[elevation]\nspeed_dps = 0.5\n[sim.azimuth]\nspeed_dps = 0.5\n"
SLOW += "[sim.elevation]\nspeed_dps = 0.5\n"
START_DEG = (30.0, 15.0)
OFFSETS_S = (0.0, 0.013, 0.029)
"""A fault may strike at any moment of a cycle."""
AT_THE_ORDER = ("starting", "dragging", "stop")
"""Scenes in which it is there before the motor runs: they have no such moment."""
PATIENCE_S = 1500.0


class Mast:
    """The box on a simulated station, with the guard as an alarm of the clock, run by hand."""

    def __init__(self, text: str = "", start_deg: tuple[float, float] = START_DEG) -> None:
        config = parse(text, "drill")
        self.clock = SimClock()
        self._period_s = 1 / config.control.rate_hz
        self._station = Station(config, self.clock, self.clock.sleep, start_deg, add_alarm=self.clock.add_alarm)
        assert isinstance(self._station.world, SimRelayPotRotor)
        self.world = self._station.world
        self._loop = ControlLoop(build_controller(config), self._station.rotor, self.clock, self._period_s)
        self._cycles = 0
        self.blind = False
        """The reading thread hangs on the bus: the loop goes on with what it last read."""
        self.started_s = self.ended_s = 0.0
        """When the motors' relays last began, and last ended, to be on."""
        self.cut_s: float | None = None
        """When the supply last went."""
        self._on = self._supply = False
        self.world.gpio.on_edges.append(self._see)

    @property
    def status(self) -> Status:
        return self._loop.status

    def order(self, order: Order) -> None:
        self._loop.post(Source("drill"), order)

    def run(self, seconds: float) -> None:
        """Cycles at their rate until that much time has passed."""
        end_s = self.clock() + seconds
        while self.clock() < end_s:
            self._cycle(end_s)

    def run_until(self, done: Callable[[], bool]) -> bool:
        """Whether it came to pass while a person would wait for it."""
        end_s = self.clock() + PATIENCE_S
        while not done() and self.clock() < end_s:
            self._cycle(end_s)
        return done()

    def hold(self, seconds: float) -> None:
        """The control thread does not get a turn; the guard does."""
        self.clock.sleep(seconds)
        self._cycles = int(self.clock() / self._period_s)

    def close(self) -> None:
        self._station.close()

    def _cycle(self, end_s: float) -> None:
        due_s = self._cycles * self._period_s
        if due_s > end_s:
            self.clock.sleep_until(end_s)
            return
        self._cycles += 1
        self.clock.sleep_until(due_s)
        if self.blind:
            self._loop.act()
        else:
            self._loop.cycle()

    def _see(self, now_s: float, _changes: Mapping[int, bool]) -> None:
        on, supply = self.world.drives() != (0, 0), self.world.azimuth.motor.supply
        if on != self._on:
            self.started_s, self.ended_s = (now_s, self.ended_s) if on else (self.started_s, now_s)
        if self._supply and not supply:
            self.cut_s = now_s
        self._on, self._supply = on, supply


@dataclass(frozen=True, slots=True)
class Drill:
    """`fault`: what the box must call it. `scene`: what goes on when `sim` (a fault of the simulator) strikes."""

    fault: str
    injected: str
    scene: str
    sim: str
    limit_s: float
    config: str = ""
    notice: bool = False


DRILLS = (
    Drill("motor runs and pot stands still", "the motor is stuck and does not start", "starting", "motor-stalled", 2.0),
    Drill("motor runs and pot stands still", "the motor gets stuck while it runs", "running", "motor-stalled", 2.0),
    Drill("motor runs and pot stands still", "the pot sticks while the motor runs", "running", "pot-stuck", 2.0),
    Drill("pot moves the wrong way", "the motor's wires are swapped", "starting", "motor-reversed", 1.0),
    Drill("pot moves the wrong way", "the pot's ends are swapped while the motor runs", "running", "pot-reversed", 1.0),
    Drill("pot open or shorted", "the wiper comes off", "running", "pot-open", 0.3),
    Drill("pot open or shorted", "the wiper touches the supply", "running", "pot-shorted", 0.3),
    Drill("pot jumps", "a loose wire: every reading is somewhere else", "running", "pot-loose", 0.3),
    Drill("bad readings", "the wiper lifts at each tenth reading", "running", "pot-crackles", 5.0),
    Drill("sensor silent", "the converter is gone from the bus", "running", "adc-gone", 0.3),
    Drill("sensor late", "the bus hangs", "hung", "bus-hung", 0.3),
    Drill("control thread late", "the control thread gets no turn for 1 s", "held", "", 0.3),
    Drill("relay welded", "a relay stays closed when switched off; master wired", "ending", "welded", 2.0, MASTER),
    Drill("relay welded", "the same without a master: until it says so", "ending", "welded", 2.0),
    Drill("turning with no relay on", "the motor runs by another switch; master wired", "resting", "hand-turns", 2.0),
    Drill("turning with no relay on", "wind turns it, at 0.3 of its speed", "resting", "wind-turns", 2.0, "", True),
    Drill("end stop reached", "a stop 4° inside the range", "stop", "stop-early", 2.0),
    Drill(
        "motor on longer than the travel takes", "the motor turns at 0.4 of its speed", "dragging", "motor-slow", 105
    ),
    Drill("motor hot", "a slow rotor runs and runs", "starting", "", 300.1, SLOW, True),
)


def strike(drill: Drill, axis: Axis, offset_s: float = 0.0, more: str = "") -> float:
    """Seconds until the relays are off (the supply, where they cannot help), or until it is said where none is on.

    Raises AssertionError where the box calls it something else, or goes on for ever.
    """
    return _strike(drill, axis, 0.0 if drill.scene in AT_THE_ORDER else offset_s, more)


@cache
def _strike(drill: Drill, axis: Axis, offset_s: float, more: str) -> float:
    config = drill.config or (MASTER if drill.sim == "hand-turns" else "")
    mast = Mast(config + more)
    try:
        from_s = _play(mast, drill, axis, offset_s)
        told = mast.run_until(lambda: _told(mast.status, drill, axis) or bool(mast.status.axis(axis).fault))
        said_s = mast.clock()
        assert told, f"{drill.fault}: it says nothing"
        assert _told(mast.status, drill, axis), f"{drill.fault}: it says {mast.status.faults}"
        mast.run(0.3)
        assert mast.world.drives() == (0, 0), f"{drill.fault}: a relay is still on"
        if drill.scene in ("ending", "resting"):
            return (mast.cut_s if MASTER in config and mast.cut_s else said_s) - from_s
        return max(mast.ended_s - from_s, 0.0)
    finally:
        mast.close()


def _play(mast: Mast, drill: Drill, axis: Axis, offset_s: float) -> float:
    """Set the scene and let the fault strike; returns the moment from which the clock counts."""
    sim = f"{axis.value}-{drill.sim}"
    go = Jog(axis, Direction.PLUS)
    mast.run(4.0)  # a slow axis is looked at for 3 s before its first relay closes
    match drill.scene:
        case "starting":
            if drill.sim:
                mast.world.inject(sim)
            mast.order(go)
            mast.run(0.1)
            return mast.started_s
        case "dragging":
            mast.order(Jog(axis, Direction.PLUS, 5.0))
            mast.run(8.0)
            mast.world.inject(sim)
            mast.order(go)
            mast.run(0.1)
            return mast.started_s
        case "resting":
            mast.run(offset_s)
            mast.world.inject(sim)
            return mast.clock()
        case "stop":
            mast.world.inject(sim)
            mast.order(go)
            part = mast.world.azimuth if axis is Axis.AZIMUTH else mast.world.elevation
            mast.run_until(lambda: part.motor.shaft_deg >= part.motor.stop_high_deg)
            return mast.clock()
    mast.order(go)
    mast.run(5.0 + offset_s)
    match drill.scene:
        case "hung":
            mast.blind = True
        case "held":
            struck_s = mast.clock()
            mast.hold(1.0)
            return struck_s
        case "ending":
            mast.world.inject(f"{axis.value}-relay-welded-{'cw' if axis is Axis.AZIMUTH else 'up'}")
            mast.order(Stop())
            mast.run(0.05)
            return mast.ended_s
        case _:
            mast.world.inject(sim if sim in mast.world.faults else drill.sim)
    return mast.clock()


def _told(status: Status, drill: Drill, axis: Axis) -> bool:
    each = status.axis(axis)
    if drill.notice:
        return any(notice.text.startswith(drill.fault) for notice in each.notices)
    return each.fault is not None and each.fault.kind.text == drill.fault


def worst(drill: Drill) -> float:
    """Of both axes, and of a few moments within a cycle."""
    return max(strike(drill, axis, offset_s) for axis in Axis for offset_s in OFFSETS_S)


def table() -> str:
    """What docs/safety.md shows."""
    lines = ["fault | what is injected | limit | relays off after", "--|--|--|--"]
    lines += [row(number, worst(drill)) for number, drill in enumerate(DRILLS)]
    return "\n".join(lines) + "\n"


def row(number: int, worst_s: float) -> str:
    """A fault is named once, in the first of its rows."""
    drill = DRILLS[number]
    name = f"[{drill.fault}](troubleshooting.md#{drill.fault.replace(' ', '-')}){' (notice)' if drill.notice else ''}"
    before = DRILLS[number - 1]
    if number and (before.fault, before.notice) == (drill.fault, drill.notice):
        name = "|"
    return f"{name} | {drill.injected} | {drill.limit_s:g} s | {worst_s:.2f} s"


if __name__ == "__main__":
    print(table(), end="")
