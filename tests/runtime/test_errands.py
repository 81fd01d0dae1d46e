"""What a rotor refuses to do once is said where a person looks, for a minute or until it is done."""

from __future__ import annotations

import pytest

from hw.ports import Axis, HardwareError
from rotator.assembly.settings import build_controller
from rotator.control.commands import Acknowledge, Errand, Place
from rotator.exchange.orders import LetGo
from rotator.exchange.sources import Source
from rotator.rotors.relays import RelayRotor
from rotator.runtime.errands import SHOWN_S, Errands
from rotator.runtime.loop import ControlLoop
from tests.runtime.loop_rig import Rig

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
WORDS: dict[Errand, str] = {
    Acknowledge(AZ): "the fault of azimuth is not acknowledged: no answer",
    Place(EL, 12.0): "elevation has not taken the angle: no answer",
    LetGo(): "the motors may still have their torque: no answer",
}


class Refuses(RelayRotor):
    """A rotor whose wire is cut: it does nothing once, until the wire is mended."""

    broken = True

    def run(self, errand: Errand) -> None:
        if self.broken:
            raise HardwareError("no answer")


@pytest.fixture
def rotor() -> Refuses:
    station = Rig().station
    assert isinstance(station.rotor, RelayRotor)
    return Refuses(station.rotor.bank, station.rotor.sensors)


@pytest.mark.parametrize("errand", WORDS, ids=str)
def test_what_failed_is_said_for_a_minute(rotor: Refuses, errand: Errand, caplog: pytest.LogCaptureFixture) -> None:
    errands = Errands(rotor)
    errands.run([errand], 100.0)
    assert errands.notices(100.0) == (WORDS[errand],)
    assert WORDS[errand] in caplog.text
    assert errands.notices(100.0 + SHOWN_S - 0.1) == (WORDS[errand],)
    assert errands.notices(100.0 + SHOWN_S) == ()


def test_one_that_fails_prevents_no_other_and_is_forgotten_when_it_is_done(rotor: Refuses) -> None:
    errands = Errands(rotor)
    errands.run(WORDS, 100.0)
    assert errands.notices(100.0) == tuple(WORDS.values())
    rotor.broken = False
    errands.run([Place(EL, 13.0), LetGo()], 101.0)
    assert errands.notices(101.0) == (WORDS[Acknowledge(AZ)],)


def test_the_status_says_it(rotor: Refuses) -> None:
    rig = Rig()
    loop = ControlLoop(build_controller(rig.config), rotor, rig.clock, 0.05)
    loop.post(Source("console", 1), LetGo())
    rig.run(1.0, loop)
    assert WORDS[LetGo()] in loop.status.notices
