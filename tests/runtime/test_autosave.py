"""What a running box finds out ends in its files: a calibration taken over a link, and what its motors have taught."""

from __future__ import annotations

import asyncio
import logging
import threading
from pathlib import Path

import pytest

from firmware_sim.clock import SimClock
from hw.ports import Axis
from rotator.assembly.kept_files import build_learnt, build_state
from rotator.assembly.settings import build_controller, build_offsets
from rotator.assembly.station import Station
from rotator.config.load import load
from rotator.exchange.motor import Motor
from rotator.exchange.orders import Aim, Calibrate, Order
from rotator.exchange.sources import Source
from rotator.runtime.autosave import Autosave
from rotator.runtime.loop import ControlLoop
from rotator.runtime.own_thread import aside
from rotator.store.hanging import writes
from tests.refusing import hanging, wait_until
from tests.search import some

STATION = """
[azimuth]
offset_deg = 12
[elevation]
calibration = [[0.05, 0], [0.5, 90], [0.95, 180]]
[mount]
north = "magnetic"
declination_deg = -4
[sim]
bus_takes_time = false
[state]
path = "{state}"
"""
AS_SAID = (Motor(6.0, 6.0 * 0.17),) * 2


class Running:
    """A box without links, as the app puts it together, in simulated time."""

    def __init__(self, path: Path, keep_in: Path | None) -> None:
        config = load(path)
        self.clock = SimClock()
        station = Station(config, self.clock, self.clock.sleep, (100.0, 20.0), add_alarm=self.clock.add_alarm)
        learnt = build_learnt(config, build_state(config))
        controller = build_controller(config, learnt.load())
        self.loop = ControlLoop(controller, station.rotor, self.clock, 0.05)
        self.autosave = Autosave(self.loop, keep_in, build_offsets(config), learnt)
        self.begun_with = self.loop.status.azimuth.learnt
        self.run(0.5)

    def run(self, seconds: float, *orders: Order) -> None:
        for order in orders:
            self.loop.post(Source("test"), order)
        for _ in range(round(seconds / 0.05)):
            self.clock.sleep(0.05)
            self.loop.cycle()

    def turn_about(self) -> None:
        for azimuth_deg, elevation_deg in ((180, 60), (90, 10), (200, 70)):
            self.run(40.0, Aim(azimuth_deg, elevation_deg))


@pytest.fixture
def path(tmp_path: Path) -> Path:
    path = tmp_path / "station.toml"
    path.write_text(STATION.format(state=tmp_path / "var" / "state.json"))
    return path


@pytest.mark.long
def test_what_the_motors_taught_is_there_the_next_time(path: Path) -> None:
    first = Running(path, path)
    assert first.begun_with == AS_SAID
    first.turn_about()
    first.autosave.close()
    assert Running(path, path).begun_with == first.loop.status.azimuth.learnt != AS_SAID


def test_a_box_that_has_not_turned_writes_nothing(path: Path) -> None:
    box = Running(path, path)
    box.run(5.0)
    box.autosave.close()
    assert not (path.parent / "var").exists()


@pytest.mark.long
def test_other_figures_in_the_file_begin_anew(path: Path) -> None:
    first = Running(path, path)
    first.turn_about()
    first.autosave.close()
    path.write_text(path.read_text().replace("[azimuth]", "[azimuth]\nspeed_dps = 5.0"))
    assert Running(path, path).begun_with == (Motor(5.0, 5.0 * 0.17),) * 2


@pytest.mark.long
def test_a_state_that_cannot_be_written_ends_in_the_log(path: Path, caplog: pytest.LogCaptureFixture) -> None:
    (path.parent / "var").write_text("a file where a folder should be")
    box = Running(path, path)
    box.turn_about()
    box.autosave.close()
    assert "cannot be kept" in caplog.text


def calibrate_low(box: Running, axis: Axis) -> None:
    box.run(2.0, Calibrate(axis, high_end=False))
    box.autosave.keep_calibrations()


def test_a_calibration_from_a_link_is_saved_on_the_rotors_own_scale(path: Path) -> None:
    # Offset and declination add 8°: the box works from 8° to 458°, the file keeps 0 to 450.
    box = Running(path, path)
    assert box.loop.status.azimuth.max_deg == 458.0
    calibrate_low(box, Axis.AZIMUTH)
    assert box.loop.status.azimuth.angle_deg == pytest.approx(8.0, abs=0.5)
    points = load(path).azimuth.calibration
    assert points is not None
    assert [angle_deg for _, angle_deg in points] == [0.0, 450.0]
    assert points[0][0] == pytest.approx(0.25, abs=0.002)


def test_the_points_between_move_along(path: Path) -> None:
    box = Running(path, path)
    calibrate_low(box, Axis.ELEVATION)
    points = load(path).elevation.calibration
    assert points is not None
    assert [angle_deg for _, angle_deg in points] == [0.0, 90.0, 180.0]


def test_without_a_file_it_is_said(path: Path, caplog: pytest.LogCaptureFixture) -> None:
    before = path.read_text()
    calibrate_low(Running(path, None), Axis.AZIMUTH)
    assert "run with --config to keep it" in caplog.text
    assert path.read_text() == before


CALIBRATIONS = (Calibrate(Axis.AZIMUTH, high_end=False), Calibrate(Axis.ELEVATION, high_end=False))


@pytest.mark.search
@pytest.mark.parametrize(("breaks", "works"), some([(breaks, works) for works in range(7) for breaks in range(works)]))
def test_a_card_may_refuse_at_any_time_and_each_calibration_is_in_the_file_in_the_end(
    path: Path, breaks: int, works: int, caplog: pytest.LogCaptureFixture
) -> None:
    """The card breaks before one of the events, and works again before a later one, or before the end."""
    box = Running(path, path)
    before = load(path)
    in_the_way = path.with_name(path.name + ".new")
    for number, event in enumerate((CALIBRATIONS[0], None, CALIBRATIONS[1], None, None, None)):
        if number == breaks:
            in_the_way.mkdir()
        if number == works and in_the_way.exists():
            in_the_way.rmdir()
        if event is None:
            box.autosave.keep_calibrations()
        else:
            box.run(2.0, event)
    if in_the_way.exists():
        in_the_way.rmdir()
    box.autosave.close()
    after = load(path)
    assert after.azimuth.calibration != before.azimuth.calibration
    assert after.elevation.calibration != before.elevation.calibration
    assert caplog.text.count("cannot be saved") <= 2, "each axis once"


def test_what_could_not_be_saved_is_said_once_and_tried_again_until_it_is(
    path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    caplog.set_level(logging.INFO)
    box = Running(path, path)
    text = path.read_text()
    path.unlink()
    for _ in range(3):
        calibrate_low(box, Axis.AZIMUTH)
    assert caplog.text.count("cannot be saved") == 1
    path.write_text(text)
    box.autosave.keep_calibrations()
    assert load(path).azimuth.calibration is not None
    assert caplog.text.count("calibration saved in") == 1


@pytest.mark.long
def test_closed_twice_it_saves_once(path: Path) -> None:
    box = Running(path, path)
    box.turn_about()
    box.autosave.close()
    state = path.parent / "var" / "state.json"
    written_ns = state.stat().st_mtime_ns
    box.autosave.close()
    assert state.stat().st_mtime_ns == written_ns


@pytest.mark.long
def test_the_end_does_not_wait_for_a_card_that_hangs_and_the_figures_are_written_when_it_goes_on(path: Path) -> None:
    box = Running(path, path)
    box.turn_about()
    state = path.parent / "var" / "state.json"
    with hanging(state):
        box.autosave.close(0.05)
        assert not state.exists()
    wait_until(lambda: not writes())
    box.autosave.close()
    assert state.exists()


@pytest.mark.parametrize("left", ["", "# nothing but this\n\n", "[azimuth\n", "\x00\x00", None])
def test_a_file_that_was_emptied_or_spoilt_under_the_box_is_not_replaced_by_a_calibration_alone(
    path: Path, left: str | None, caplog: pytest.LogCaptureFixture
) -> None:
    box, whole, kept = Running(path, path), path.read_text(), path.with_name(path.name + ".bak")
    kept.write_text("the file before")
    if left is None:
        path.unlink()
    else:
        path.write_text(left)
    calibrate_low(box, Axis.AZIMUTH)
    assert "azimuth: calibration cannot be saved" in caplog.text
    assert (path.read_text() if path.exists() else None) == left
    assert kept.read_text() == "the file before"
    path.write_text(whole)
    box.autosave.keep_calibrations()
    assert load(path).azimuth.calibration is not None


def test_the_event_loop_goes_on_while_the_job_works() -> None:
    free = threading.Event()

    async def both() -> None:
        waits = asyncio.create_task(aside(free.wait, "job"))
        await asyncio.sleep(0)
        assert not waits.done()
        free.set()
        await waits

    asyncio.run(both())


def test_what_the_job_raises_is_raised() -> None:
    def fails() -> None:
        raise OSError("full")

    with pytest.raises(OSError, match="full"):
        asyncio.run(aside(fails, "job"))


def test_a_job_that_hangs_holds_up_no_end() -> None:
    free = threading.Event()

    async def cancelled() -> None:
        waits = asyncio.create_task(aside(free.wait, "hangs"))
        await asyncio.sleep(0)
        waits.cancel()
        with pytest.raises(asyncio.CancelledError):
            await waits

    asyncio.run(cancelled())
    (left,) = [thread for thread in threading.enumerate() if thread.name == "hangs"]
    assert left.daemon
    free.set()
    left.join()
