"""Every order in which the control thread, the sensors' thread, a slow card and the end may come: no count that is
wrong is believed after a restart, and none that is right is lost.
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from hw.ports import Axis
from rotator.rotors.counts_writer import CountsWriter
from rotator.store.counts import CountsFile, Place, Standing
from tests.search import WHOLE

AZ = Axis.AZIMUTH
CAMS = {AZ: {"spacing_deg": 5.0}}
BEGIN_DEG, MOVE_DEG, PLACED_DEG = 100.0, 90.0, 7.0
LONGEST = 6 if WHOLE else 5


class Antenna:
    """One axis that counts, its file on a card that is as slow as a test wants, and the truth beside it."""

    def __init__(self, path: Path) -> None:
        self._path = path
        file = CountsFile(path, CAMS)
        file.home(AZ, BEGIN_DEG)
        self.jobs: list[Callable[[], None]] = []
        self._writer = CountsWriter(file, self.jobs.append)
        self.truth_deg = BEGIN_DEG
        self.turning = self.lost = False
        self.reported = True
        """Its angle at rest was reported, and no motor was to start since."""

    def events(self) -> Iterator[str]:
        """What may happen next."""
        yield from ("start", "lose", "card")
        yield from ("stop",) if self.turning else ("rest", "place")
        if self.jobs:
            yield "job"

    def happen(self, event: str) -> None:
        match event:
            case "start":
                self.reported = False
                self.turning = self._writer.may_start(AZ) or self.turning
            case "stop":
                self.turning, self.truth_deg = False, self.truth_deg + MOVE_DEG
            case "rest":
                self._rest()
            case "place":
                self.truth_deg, self.lost, self.reported = self.truth_deg + PLACED_DEG, False, True
                self._writer.homed(AZ, self.truth_deg)
            case "lose":
                self.lost, self.reported = True, False
                self._writer.lost(AZ)
            case "job":
                self.jobs.pop(0)()
                assert not self.turning or self.believed.standing is not Standing.KNOWN, "a power cut while it turns"
            case "card":
                self._breaks_or_works()
            case "end":
                self._writer.close()
                while self.jobs:
                    self.happen("job")

    def _rest(self) -> None:
        """As the sensors' thread reports an axis that stands, or one whose count is in doubt."""
        if self.lost:
            self._writer.lost(AZ)
        else:
            self.reported = True
            self._writer.rests(AZ, self.truth_deg)

    @property
    def _in_the_way(self) -> Path:
        return self._path.with_name(self._path.name + ".new")

    @property
    def card_works(self) -> bool:
        return not self._in_the_way.exists()

    def _breaks_or_works(self) -> None:
        """A folder where the new file is written first: no write succeeds."""
        if self.card_works:
            self._in_the_way.mkdir()
        else:
            self._in_the_way.rmdir()

    @property
    def believed(self) -> Place:
        """What a program believes that starts after a power cut now."""
        return CountsFile(self._path, CAMS).load()[AZ]

    def clear(self) -> None:
        self._path.unlink()
        if not self.card_works:
            self._in_the_way.rmdir()


@pytest.fixture
def path() -> Iterator[Path]:
    """In memory, where there is such a place: a real card is slow, and here come thousands of writes."""
    memory = Path("/dev/shm")
    with tempfile.TemporaryDirectory(dir=memory if memory.is_dir() else None) as folder:
        yield Path(folder) / "counts.json"


def orders(path: Path, before: tuple[str, ...] = ()) -> Iterator[tuple[str, ...]]:
    """Each order of events up to the longest, that begins with these; it is played, and checked at each event."""
    antenna = Antenna(path)
    for event in before:
        antenna.happen(event)
    next_events = list(antenna.events())
    assert not antenna.turning or antenna.believed.standing is not Standing.KNOWN, f"a power cut: {before}"
    works = antenna.card_works
    antenna.happen("end")
    place = antenna.believed
    if works and place.standing is Standing.KNOWN:
        assert not antenna.turning, before
        assert not antenna.lost, before
        assert place.angle_deg == pytest.approx(antenna.truth_deg), before
    if works and antenna.reported and not antenna.turning:
        assert place.standing is Standing.KNOWN, f"it is lost without need: {before}"
    antenna.clear()
    yield before
    if len(before) < LONGEST:
        for event in next_events:
            yield from orders(path, (*before, event))


def test_no_order_of_events_leaves_a_wrong_angle_or_loses_a_right_one(path: Path) -> None:
    assert sum(1 for _ in orders(path)) > 1000


@pytest.mark.parametrize("rests_meanwhile", range(4))
def test_a_motor_starts_however_often_its_rest_is_reported_meanwhile(path: Path, rests_meanwhile: int) -> None:
    antenna = Antenna(path)
    for _ in range(rests_meanwhile):
        antenna.happen("start")
        antenna.happen("rest")
    antenna.happen("start")
    while antenna.jobs:
        antenna.happen("job")
    antenna.happen("start")
    assert antenna.turning
