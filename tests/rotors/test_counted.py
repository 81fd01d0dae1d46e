"""An axis that counts, between its counter and its file: what is believed at the start, and what becomes of it."""

from __future__ import annotations

import threading
from collections.abc import Callable
from pathlib import Path

import pytest

from hw.drives.relays import RelayBank
from hw.ports import Direction, HardwareError
from rotator.control.commands import Place as Placed
from rotator.control.commands import Run
from rotator.control.sky.offsets import Offsets
from rotator.rotors.counted import CountedAxis, CountedRotor
from rotator.rotors.counts_writer import CountsWriter, at_once
from rotator.store.counts import LOST, NEVER, CountsFile, Place, Standing
from rotator.store.hanging import HANGS_S
from tests.hw.sensors.pulse_rig import AZ, CYCLE_S, PulseRig

MINUS, OFF, PLUS = Direction
CAMS = {AZ: {"spacing_deg": 5.0}}
NO_ENDS: frozenset[Direction] = frozenset()


class Mast:
    """The azimuth of a U-100 at 180°, as a rotor that is obeyed and read by hand."""

    def __init__(self, path: Path, kept: Place, *, offset_deg: float = 0.0) -> None:
        self.rig = PulseRig(180.0)
        self.path = path
        file = CountsFile(path, CAMS)
        if kept.standing is Standing.KNOWN:
            file.home(AZ, kept.angle_deg)
        self.counts_writer = CountsWriter(file, at_once)
        self.axis = CountedAxis(AZ, self.rig.counter, self.counts_writer, self.rig.clock)
        self.axis.begin(kept)
        bank: RelayBank = self.rig.bank
        self.rotor = CountedRotor(
            bank, {AZ: self.axis}, {AZ: self.axis}, Offsets(offset_deg), counts_writer=self.counts_writer
        )

    def run(self, way: Direction, seconds: float) -> None:
        until_s = self.rig.clock() + seconds
        while self.rig.clock() < until_s:
            self.rotor.obey(AZ, Run(way, self.rig.clock() + 0.2))
            self.rig.clock.sleep(CYCLE_S)
            self.axis.read()
        self.rotor.obey(AZ, Run(OFF, 0.0))

    def wait(self, seconds: float) -> None:
        for _ in range(round(seconds / CYCLE_S)):
            self.rig.clock.sleep(CYCLE_S)
            self.axis.read()

    def on_disk(self) -> Place:
        return CountsFile(self.path, CAMS).load()[AZ]


KNOWN = Place(Standing.KNOWN, 180.0)


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "counts.json"


# --- the start


@pytest.mark.parametrize(
    ("kept", "why"),
    [
        (NEVER, "not done yet"),
        (LOST, "the program ended in mid-move, or its count was in doubt"),
        (Place(Standing.MOVING), "the program ended in mid-move, or its count was in doubt"),
    ],
    ids=["never", "lost", "moving"],
)
def test_what_is_not_known_wants_homing_and_says_why(path: Path, kept: Place, why: str) -> None:
    mast = Mast(path, kept)
    mast.wait(1.0)
    assert mast.axis.condition(NO_ENDS).lost == why
    mast.wait(60.0)
    assert mast.on_disk().standing is not Standing.KNOWN, "a guess is never kept"


# --- moving


def test_the_file_says_so_before_the_relay_closes(path: Path) -> None:
    mast = Mast(path, KNOWN)
    mast.wait(1.0)
    assert mast.on_disk() == KNOWN
    assert mast.rotor.obey(AZ, Run(PLUS, mast.rig.clock() + 0.2)) is PLUS
    assert mast.on_disk().standing is Standing.LOST


def test_the_sensor_thread_writes_no_rest_between_the_mark_and_the_relay(path: Path) -> None:
    """It looked before the relay closed, and would take back the mark of an axis that turns."""
    mast = Mast(path, KNOWN)
    mast.wait(3.0)
    has_read = threading.Event()

    def read() -> None:
        mast.axis.read()
        has_read.set()

    def close_relay() -> Direction:
        threading.Thread(target=read).start()
        assert not has_read.wait(0.05)
        return mast.rig.bank.drive(AZ, PLUS, mast.rig.clock() + 0.2)

    assert mast.axis.start(close_relay) is PLUS
    assert has_read.wait(10.0)
    mast.counts_writer.close()
    assert mast.on_disk().standing is Standing.LOST, "moving"


def test_a_card_that_hangs_is_told_while_the_motor_waits_for_it(path: Path) -> None:
    mast, jobs = Mast(path, KNOWN), list[Callable[[], None]]()
    mast.counts_writer = CountsWriter(CountsFile(path, CAMS), jobs.append)
    mast.counts_writer.load()
    mast.axis = CountedAxis(AZ, mast.rig.counter, mast.counts_writer, mast.rig.clock)
    mast.axis.begin(KNOWN)
    mast.rotor = CountedRotor(
        mast.rig.bank, {AZ: mast.axis}, {AZ: mast.axis}, Offsets(), counts_writer=mast.counts_writer
    )
    told = []
    for _ in range(round(2.0 * HANGS_S / CYCLE_S)):
        assert mast.rotor.obey(AZ, Run(PLUS, mast.rig.clock() + 0.2)) is OFF
        mast.rig.clock.sleep(CYCLE_S)
        told.append(mast.rotor.condition(AZ).fault)
    assert told[round(0.9 * HANGS_S / CYCLE_S)] is None
    assert "the card hangs" in str(told[-1])
    for job in jobs:
        job()
    assert mast.rotor.condition(AZ).fault is None
    assert mast.rotor.obey(AZ, Run(PLUS, mast.rig.clock() + 0.2)) is PLUS


# --- trouble


def test_a_count_in_doubt_is_lost_on_disk_too(path: Path) -> None:
    mast = Mast(path, KNOWN)
    mast.rig.rotor.inject("azimuth-contact-stuck-open")
    mast.run(PLUS, 4.0)
    condition = mast.axis.condition(NO_ENDS)
    assert condition.lost == "driven for three periods, and the contact did not change"
    assert mast.on_disk().standing is Standing.LOST
    mast.wait(60.0)
    mast.rotor.close()
    assert mast.on_disk().standing is Standing.LOST


def test_turned_by_something_else_at_rest_it_is_lost_on_disk_at_once(path: Path) -> None:
    mast = Mast(path, KNOWN)
    mast.wait(30.0)
    assert mast.on_disk().standing is Standing.KNOWN
    mast.rig.rotor.inject("azimuth-hand-turns")
    mast.wait(4.0)
    assert mast.axis.condition(NO_ENDS).lost == "it turns with no relay on"
    assert mast.on_disk().standing is Standing.LOST


def test_a_loss_that_the_card_refuses_is_written_as_soon_as_it_takes_it(path: Path) -> None:
    mast = Mast(path, KNOWN)
    mast.wait(30.0)
    in_the_way = path.with_name(path.name + ".new")
    in_the_way.mkdir()
    mast.rig.rotor.inject("azimuth-hand-turns")
    mast.wait(4.0)
    assert mast.axis.condition(NO_ENDS).lost == "it turns with no relay on"
    assert mast.on_disk().standing is Standing.KNOWN
    in_the_way.rmdir()
    mast.wait(1.0)
    assert mast.on_disk().standing is Standing.LOST, "a power cut now, and the next run must not believe the old angle"


@pytest.mark.parametrize("kept", [KNOWN, NEVER], ids=["known", "never"])
def test_an_angle_that_could_not_be_taken_leaves_none_also_after_a_restart(path: Path, kept: Place) -> None:
    """A person has said that it stands elsewhere than the count: with the old one it would turn beyond its stops."""
    mast = Mast(path, kept)
    mast.rig.contact.close()
    with pytest.raises(HardwareError):
        mast.rotor.run(Placed(AZ, 90.0))
    assert mast.axis.condition(NO_ENDS).lost == "its contact could not be read when its angle was given"
    assert mast.on_disk().standing is not Standing.KNOWN
