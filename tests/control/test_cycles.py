"""A cycle that comes late: a fault of both axes while a motor runs, and none at rest."""

from __future__ import annotations

import pytest

from rotator.control.cycles import CYCLE_LATE_S, Cycles


@pytest.mark.parametrize(("gap_s", "late"), [(0.05, False), (0.05 + CYCLE_LATE_S, False), (1.234, True)])
def test_a_late_cycle_while_a_motor_runs_is_a_fault_that_tells_both_times(gap_s: float, late: bool) -> None:
    cycles = Cycles(0.05)
    assert cycles.begin(0.0, running=True) == (), "the first cycle cannot be late"
    faults = cycles.begin(gap_s, running=True)
    assert len(faults) == (2 if late else 0)
    for fault in faults:
        assert "1.2 s" in fault.measured
        assert fault.limit == "0.55 s"
    assert cycles.begin(gap_s + 5.0, running=False) == (), "nothing ran"


@pytest.mark.parametrize(("running", "count"), [(True, 2), (False, 0)])
def test_a_cycle_that_takes_so_long_itself_is_as_late(running: bool, count: int) -> None:
    cycles = Cycles(0.05)
    cycles.begin(0.0, running=running)
    assert cycles.end(0.05 + CYCLE_LATE_S, running=running) == ()
    assert len(cycles.end(1.234, running=running)) == count
