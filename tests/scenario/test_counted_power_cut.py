"""The power goes at any moment of a counted axis's life: what is then on disk is true, or says that it is lost."""

from __future__ import annotations

import random
from pathlib import Path

import pytest

from hw.ports import Direction
from hw.sensors.cam_count import CamCount
from rotator.store.counts import CountsFile, Standing
from tests.hw.sensors.pulse_rig import AZ, CAM, PulseRig

CUTS = 1000
CYCLE_S = 0.1
CAMS = {AZ: {"spacing_deg": CAM.spacing_deg}}


class CountedBox:
    """The rotor with its file, one cycle after another, as the control loop runs them."""

    def __init__(self, path: Path, seed: int) -> None:
        self.rig = PulseRig(180.0, seed=seed)
        self.file = CountsFile(path, CAMS)
        self.file.home(AZ, 180.0)
        self._chance = random.Random(seed)
        self._direction = Direction.OFF
        self._until_s = 0.0

    def cycle(self) -> None:
        rig = self.rig
        if rig.clock() >= self._until_s:
            self._order()
        if self._direction is not Direction.OFF and self.file.start(AZ):
            rig.bank.drive(AZ, self._direction, rig.clock() + 0.3)
        angle_deg = rig.wait(CYCLE_S, CYCLE_S)
        assert not rig.counter.trouble
        if rig.counter.at_rest:
            self.file.rest(AZ, angle_deg)

    def _order(self) -> None:
        if self._direction is Direction.OFF:
            low = self.rig.shaft_deg < self._chance.uniform(60.0, 300.0)
            self._direction = Direction.PLUS if low else Direction.MINUS
            self._until_s = self.rig.clock() + self._chance.choice([0.1, 0.4, 1.0, 5.0])
        else:
            self.rig.bank.drive(AZ, Direction.OFF, 0.0)
            self._direction = Direction.OFF
            self._until_s = self.rig.clock() + self._chance.choice([0.2, 1.0, 4.0, 30.0])


@pytest.mark.long
def test_a_thousand_power_cuts(tmp_path: Path) -> None:
    path = tmp_path / "counts.json"
    chance = random.Random(7)
    box = CountedBox(path, seed=7)
    known = lost_in_mid_move = 0
    for _ in range(CUTS):
        for _ in range(chance.randrange(1, 40)):
            box.cycle()
        motor = box.rig.rotor.azimuth.motor
        # At the end of the coast that the file states it still creeps, by some thousandths of a degree.
        moving = bool(motor.drive) or abs(motor.speed_dps) > 0.1
        torn = path.with_name("counts.json.new")
        torn.write_text(path.read_text()[: chance.randrange(100)])

        place = CountsFile(path, CAMS).load()[AZ]
        if place.standing is Standing.KNOWN:
            assert not moving
            again = CamCount(CAM)
            assert again.place(0.0, place.angle_deg, closed=box.rig.contact.closed())
            assert again.zone == box.rig.rotor.azimuth.contact.zone
            known += 1
        else:
            assert place.standing is Standing.LOST
            lost_in_mid_move += moving
    assert known > CUTS / 2
    assert lost_in_mid_move > CUTS / 10
    assert box.file.trouble == ""
