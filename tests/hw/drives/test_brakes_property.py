"""Any commands, moments and deaths: no motor is ever fed against its brake, and no brake falls on a shaft that turns.

Judged in the simulated world, by what its wedge and its motor have felt.
"""

from __future__ import annotations

from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, precondition, rule

from hw.drives.brake import BrakeTimes
from hw.ports import Direction
from tests.hw.drives.brake_bench import AZ, BrakeBench
from tests.search import examples


class AnySequence(RuleBasedStateMachine):
    @initialize(
        active_low=st.booleans(),
        strict=st.booleans(),
        release_s=st.sampled_from([0.3, 0.5, 1.0]),
        engage_s=st.sampled_from([2.0, 4.0, 8.0]),
        dead_time_s=st.sampled_from([0.05, 0.5, 5.0]),
    )
    def wire(self, active_low: bool, strict: bool, release_s: float, engage_s: float, dead_time_s: float) -> None:
        times = BrakeTimes(release_s, 5.0 * 0.3, engage_s)
        self.bench = BrakeBench(times, active_low=active_low, dead_time_s=dead_time_s)
        self.bench.gpio.strict = strict and not active_low  # these pins have pull-downs

    @precondition(lambda self: self.bench.alive)
    @rule(direction=st.sampled_from(Direction), seconds=st.floats(-0.1, 0.7) | st.sampled_from([0.05, 0.5, 3600.0]))
    def drive(self, direction: Direction, seconds: float) -> None:
        self.bench.drive(direction, seconds)

    @precondition(lambda self: self.bench.alive)
    @rule(direction=st.sampled_from([Direction.MINUS, Direction.PLUS]), seconds=st.floats(0.0, 8.0))
    def run(self, direction: Direction, seconds: float) -> None:
        self.bench.run(direction, seconds)

    @precondition(lambda self: self.bench.alive)
    @rule(
        what=st.sampled_from(["off", "feed", "unfeed", "cut", "restore", "turns", "enforce"]),
        late_s=st.floats(0.0, 0.5),
    )
    def supply(self, what: str, late_s: float) -> None:
        bank = self.bench.bank
        match what:
            case "off":
                bank.off()
            case "feed":
                bank.feed(AZ, self.bench.clock() + 0.25)
            case "unfeed":
                bank.unfeed(AZ)
            case "cut":
                bank.cut()
            case "restore":
                bank.restore()
            case "turns":
                bank.seen_turning(AZ)
            case _:
                bank.enforce(self.bench.clock() - late_s)

    @rule(seconds=st.floats(0.0, 3.0) | st.sampled_from([0.3, 0.5, 1.0, 2.0, 4.0, 8.0, 10.0]))
    def time_passes(self, seconds: float) -> None:
        self.bench.clock.sleep(seconds)

    @precondition(lambda self: self.bench.alive)
    @rule(which=st.sampled_from(["ends", "dies"]))
    def program(self, which: str) -> None:
        if which == "ends":
            self.bench.bank.leave(3.0)
            self.bench.clock.sleep(3.1)
            assert not self.bench.released
        self.bench.dies()

    @invariant()
    def no_harm(self) -> None:
        if hasattr(self, "bench"):
            assert self.bench.harm == (0.0, 0)

    @invariant()
    def a_brake_that_is_off_is_told_and_ends(self) -> None:
        if not hasattr(self, "bench"):
            return
        bench = self.bench
        assert bench.alive or not bench.released
        assert bool(bench.ears.off) == bench.bank.released or not bench.alive
        assert not bench.bank.released or bench.bank.due_s() is not None or not bench.alive


TestAnySequence = AnySequence.TestCase
TestAnySequence.settings = settings(max_examples=examples(400), stateful_step_count=40, deadline=None)
