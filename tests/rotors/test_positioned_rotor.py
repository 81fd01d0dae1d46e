"""Rotors whose motors go to an angle by themselves, as the control loop sees them: what becomes of its commands.

The drive here writes down each command. The real drives have tests of their own.
"""

from __future__ import annotations

import threading

import pytest

from hw.ports import AngleSensor, Axis, Direction, HardwareError
from hw.safety.guard import GUARD_THREAD
from rotator.control.sky.offsets import Offsets
from rotator.rotors.positioned import PositionedRotor
from tests.rotors.journal import Journal

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
SHIFT = Offsets(10.0, -3.0)
PATIENCE_S = 20.0
SENSORS: dict[Axis, AngleSensor] = {}


@pytest.fixture
def drive() -> Journal:
    return Journal()


@pytest.fixture
def rotor(drive: Journal) -> PositionedRotor[Journal]:
    return PositionedRotor(drive, SENSORS, SHIFT, lambda axis: frozenset({Direction.PLUS} if axis is EL else ()))


def test_a_safe_state_that_fails_is_an_error(rotor: PositionedRotor[Journal], drive: Journal) -> None:
    drive.broken = True
    with pytest.raises(HardwareError, match="does not answer"):
        rotor.off()
    with pytest.raises(HardwareError, match="does not answer"):
        rotor.close()


class Dying(Journal):
    """A drive whose guard cannot live."""

    def wait_until_due(self, patience_s: float) -> None:
        raise SystemExit


@pytest.mark.filterwarnings("ignore::pytest.PytestUnhandledThreadExceptionWarning")
def test_started_in_real_time_it_says_when_its_guard_has_died() -> None:
    rotor = PositionedRotor(Dying(), SENSORS, SHIFT)
    rotor.check()
    rotor.start()
    for thread in threading.enumerate():
        if thread.name == GUARD_THREAD:
            thread.join(PATIENCE_S)
    with pytest.raises(HardwareError, match="the guard, which ends expired commands, has died"):
        rotor.check()
    rotor.close()
    rotor.check()
