"""The simulated receiver: the beam is as wide as it says, and fading is as deep and as slow as it says."""

from __future__ import annotations

import math
import statistics

import pytest

from firmware_sim.clock import SimClock
from firmware_sim.parts.receiver import FLOOR_DB, ReceiverSpec, SimReceiver, beam

QUIET = {"noise_db": 0.0, "fading_db": 0.0, "step_db": 1e-6}


def test_half_the_power_is_left_at_half_the_beam_and_a_side_lobe_beyond_it() -> None:
    assert beam(10.0, 20.0) == pytest.approx(0.5, abs=1e-3)
    assert beam(0.0, 20.0) == 1.0
    assert 10 * math.log10(max(beam(off / 10, 20.0) for off in range(250, 400))) == pytest.approx(-13.3, abs=0.1)


def test_far_off_it_hears_the_floor_and_in_the_middle_the_signal() -> None:
    off_deg = [0.0]
    receiver = SimReceiver(ReceiverSpec(signal_db=20.0, **QUIET), SimClock(), lambda: off_deg[0])
    assert receiver.strength_db() == pytest.approx(FLOOR_DB + 20.0, abs=0.1)
    off_deg[0] = 22.6
    assert receiver.strength_db() == pytest.approx(FLOOR_DB, abs=0.1)


def test_a_strong_signal_fades_as_deep_and_as_slowly_as_it_is_told() -> None:
    clock = SimClock()
    spec = ReceiverSpec(signal_db=60.0, **(QUIET | {"fading_db": 3.0, "fading_s": 5.0}))
    receiver = SimReceiver(spec, clock, lambda: 0.0)
    told = []
    for _ in range(8000):
        clock.sleep(1.0)
        told.append(receiver.strength_db() - FLOOR_DB - 60.0)
    assert statistics.pstdev(told) == pytest.approx(3.0, abs=0.4)
    alike = statistics.correlation(told[:-5], told[5:])
    assert alike == pytest.approx(math.exp(-1), abs=0.1)
