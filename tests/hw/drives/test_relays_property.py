"""Any sequence of commands at all: what the relays do is read off the pins, edge by edge.

Opposite relays never together, no relay closed longer than its command allows, no reversal before its dead time; and
where the transformer is small, never both motors. The master feeds each motor that runs, lingers, and stays open after
a cut. The sentinel hears of each lease and of its end, so that it never takes a program at rest for one that hangs.
"""

from __future__ import annotations

from collections.abc import Collection

from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, rule

from firmware_sim.buses.gpio import SimGpio
from firmware_sim.clock import SimClock
from hw.buses.gpio import GpioOutputs
from hw.drives.leases import LONGEST_LEASE_S
from hw.drives.motor_supply import MASTER_LINGER_S
from hw.drives.relays import RelayBank
from hw.ports import Axis, Direction
from tests.search import examples

PINS = {"azimuth_cw": 22, "azimuth_ccw": 23, "elevation_up": 24, "elevation_down": 25, "master": 26}
OPPOSITES = ((22, 23), (24, 25))
MOTORS = {
    (Axis.AZIMUTH, Direction.PLUS): 22,
    (Axis.AZIMUTH, Direction.MINUS): 23,
    (Axis.ELEVATION, Direction.PLUS): 24,
    (Axis.ELEVATION, Direction.MINUS): 25,
}
ROUNDING_S = 1e-9


class Ears:
    """A sentinel that only listens: when a lease was last renewed, and whether all have ended since."""

    def __init__(self, clock: SimClock) -> None:
        self._clock = clock
        self.leased_s: float | None = None

    def renew(self) -> None:
        self.leased_s = self._clock()

    def rest(self) -> None:
        self.leased_s = None

    def unbraked(self, lines: Collection[str]) -> None:
        """No brake is wired here: tests/hw/drives/test_brakes_property.py."""


class AnySequence(RuleBasedStateMachine):
    @initialize(
        active_low=st.booleans(),
        master=st.booleans(),
        one_at_a_time=st.booleans(),
        dead_time_s=st.sampled_from([0.05, 0.5, 1.3]),
    )
    def wire(self, active_low: bool, master: bool, one_at_a_time: bool, dead_time_s: float) -> None:
        self.clock = SimClock(1000.0)
        self.gpio = SimGpio(self.clock)
        self.active_low, self.dead_time_s, self.one_at_a_time = active_low, dead_time_s, one_at_a_time
        pins = {name: pin for name, pin in PINS.items() if master or name != "master"}
        lines = GpioOutputs(self.gpio, "/dev/gpiochip0", pins, consumer="test", active_low=active_low)
        self.master, self.cut, self.ears = master, False, Ears(self.clock)
        self.supplied_until_s = float("-inf")
        self.bank = RelayBank(
            lines, self.clock, dead_time_s=dead_time_s, master=master, one_at_a_time=one_at_a_time, watch=self.ears
        )
        self.gpio.edges.clear()
        self.clock.add_alarm(self.bank.due_s, self.bank.enforce)
        self.allowed_until_s: dict[int, float] = {}
        self.on: set[int] = set()
        self.opened_s: dict[int, float] = {}
        self.closed_s: dict[int, float] = {}

    @rule(
        axis=st.sampled_from(Axis),
        direction=st.sampled_from(Direction),
        seconds=st.floats(-0.1, 0.7) | st.sampled_from([0.0, 0.05, 0.5, 3600.0, float("inf")]),
    )
    def drive(self, axis: Axis, direction: Direction, seconds: float) -> None:
        now_s = self.clock()
        on = self.bank.drive(axis, direction, now_s + seconds)
        assert on in (Direction.OFF, direction)
        if on is not Direction.OFF:
            self.allowed_until_s[MOTORS[axis, on]] = min(now_s + seconds, now_s + LONGEST_LEASE_S)

    @rule(axis=st.sampled_from(Axis), seconds=st.floats(-0.1, 0.7) | st.sampled_from([0.25, 3600.0]))
    def feed(self, axis: Axis, seconds: float) -> None:
        self.bank.feed(axis, self.clock() + seconds)
        assert self.bank.driven()[axis] is Direction.OFF
        if not self.cut:
            self.supplied_until_s = max(self.supplied_until_s, self.clock() + min(seconds, LONGEST_LEASE_S))

    @rule(axis=st.sampled_from(Axis))
    def unfeed(self, axis: Axis) -> None:
        self.bank.unfeed(axis)
        assert self.bank.driven()[axis] is Direction.OFF

    @rule(what=st.sampled_from(["off", "cut", "restore", "restore"]))
    def supply(self, what: str) -> None:
        match what:
            case "off":
                self.bank.off()
                assert not any(self.is_on(pin) for pin in MOTORS.values())
            case "cut":
                assert self.bank.cut() == self.master
                self.cut = self.master
            case "restore":
                self.bank.restore()
                self.cut = False

    @rule(early_s=st.floats(0.0, 0.5))
    def enforce(self, early_s: float) -> None:
        self.bank.enforce(self.clock() - early_s)

    @rule(seconds=st.floats(0.0, 1.5) | st.sampled_from([0.05, 0.25, 0.5, 0.75, MASTER_LINGER_S]))
    def time_passes(self, seconds: float) -> None:
        self.clock.sleep(seconds)

    def is_on(self, pin: int) -> bool:
        return self.gpio.level(pin) != self.active_low and pin in {*MOTORS.values(), PINS["master"]}

    @invariant()
    def no_edge_breaks_a_rule(self) -> None:
        if not hasattr(self, "gpio"):
            return
        while self.gpio.edges:
            edge = self.gpio.edges.popleft()
            if edge.offset == PINS["master"]:
                continue
            if edge.level == self.active_low:
                self.on.discard(edge.offset)
                self.opened_s[edge.offset] = edge.at_s
                assert edge.at_s <= self.allowed_until_s[edge.offset], "a relay outlived its command"
                continue
            self.on.add(edge.offset)
            (opposite,) = {a if b == edge.offset else b for a, b in OPPOSITES if edge.offset in (a, b)}
            assert opposite not in self.on, "opposite relays were on together"
            assert not self.one_at_a_time or len(self.on) == 1, "two motors were fed together"
            rested_s = edge.at_s - self.opened_s.get(opposite, float("-inf"))
            if self.opened_s.get(opposite, 0.0) >= self.opened_s.get(edge.offset, 0.0):
                assert rested_s >= self.dead_time_s - ROUNDING_S, "reversed before the dead time was over"

    @invariant()
    def the_master_feeds_what_runs_and_no_longer(self) -> None:
        if not hasattr(self, "gpio"):
            return
        runs, closed = any(self.is_on(pin) for pin in MOTORS.values()), self.is_on(PINS["master"])
        if runs:
            self.supplied_until_s = self.clock() + LONGEST_LEASE_S + MASTER_LINGER_S
        if not self.master:
            return
        assert closed or not runs, "a motor runs without its supply"
        assert not (closed and self.cut), "a motor has its supply although it was cut"
        assert not closed or self.clock() < self.supplied_until_s + ROUNDING_S, "the supply stays on"

    @invariant()
    def the_sentinel_is_content(self) -> None:
        if not hasattr(self, "gpio"):
            return
        told_s = self.ears.leased_s
        assert told_s is not None or not any(self.is_on(pin) for pin in MOTORS.values()), "a lease was not told"
        assert told_s is None or self.clock() - told_s <= LONGEST_LEASE_S, "the program seems to hang"

    @invariant()
    def nothing_on_is_overdue(self) -> None:
        if not hasattr(self, "gpio"):
            return
        for pin in MOTORS.values():
            assert not self.is_on(pin) or self.clock() < self.allowed_until_s[pin]

    @invariant()
    def the_bank_knows_what_is_on(self) -> None:
        if not hasattr(self, "gpio"):
            return
        driven = self.bank.driven()
        for (axis, direction), pin in MOTORS.items():
            assert (driven[axis] is direction) == self.is_on(pin)
        assert (self.bank.due_s() is not None) >= any(self.is_on(pin) for pin in MOTORS.values())


TestAnySequence = AnySequence.TestCase
TestAnySequence.settings = settings(max_examples=examples(400), stateful_step_count=40, deadline=None)
