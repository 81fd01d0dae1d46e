"""A latched stop and a storm park outlast the program: killed in any moment, the box begins stopped, until `resume`.

The whole control loop on simulated chips. The rotor outlives the program, and so does its folder. The file is written
at once here; `tests/runtime/test_state_thread.py` has the thread.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from firmware_sim.clock import SimClock
from firmware_sim.rotors.rotor import SimRotor
from hw.ports import Axis, Direction
from rotator.assembly.settings import build_controller
from rotator.assembly.station import Station
from rotator.config.model import Config
from rotator.exchange.orders import Aim, Home, Jog, LoadTimed, Order, Park, Release, Stop
from rotator.exchange.sources import Source
from rotator.exchange.spoken import held_by, spoken
from rotator.runtime.keeping import Keeping
from rotator.runtime.loop import ControlLoop
from rotator.store.latch import KeptLatch
from rotator.store.state import State
from rotator.views import lcd
from rotator.views.plain_lines import line
from rotator.views.words import headline

PC, CONSOLE, BROWSER, PANEL = Source("rotctld", 1), Source("console", 3), Source("page", 2), Source("panel")
LOOK_S = 3.0
STANDS_DEG = (100.0, 60.0)


class Run:
    """One run of the program. `before`: the run that was killed; its rotor goes on."""

    def __init__(self, folder: Path, before: Run | None = None) -> None:
        self.clock: SimClock = before.clock if before else SimClock()
        config = Config()
        kept = KeptLatch(State(folder / "state.json"))
        self._alive = True
        if before:
            before._alive = False
            before.world.gpio.bury_process()
            before.world.open_buses()
        self.station = Station(
            config,
            self.clock,
            self.clock.sleep,
            STANDS_DEG,
            add_alarm=lambda due_s, ring: self.clock.add_alarm(lambda: due_s() if self._alive else None, ring),
            world=before.world if before else None,
        )
        assert self.station.world is not None
        self.world: SimRotor = self.station.world
        controller = build_controller(config, latch=kept.load())
        self.loop = ControlLoop(controller, self.station.rotor, self.clock, 0.05, keeping=Keeping(latch=kept.save))
        self.wait(LOOK_S)

    def wait(self, seconds: float) -> None:
        for _ in range(round(seconds / 0.05)):
            self.loop.cycle()
            self.clock.sleep(0.05)

    def order(self, order: Order, by: Source = PC) -> None:
        self.loop.post(by, order)
        self.loop.act()

    def moves(self, order: Order, by: Source = PC) -> bool:
        stood = self.world.antenna()
        self.order(order, by)
        self.wait(3.0)
        return self.world.antenna() != pytest.approx(stood, abs=0.5)


@pytest.mark.long
@pytest.mark.parametrize("by", [CONSOLE, BROWSER, PANEL])
def test_after_a_stop_and_a_kill_no_order_of_a_link_moves_it_until_resume(tmp_path: Path, by: Source) -> None:
    run = Run(tmp_path)
    assert run.moves(Aim(200.0, 60.0))
    run.order(Stop(latch=True), by)
    run.wait(2.0)
    again = Run(tmp_path, run)
    orders: list[Order] = [
        Aim(200.0, 30.0),
        Jog(Axis.AZIMUTH, Direction.PLUS),
        LoadTimed(1.0, ((10.0, 10.0),)),
        Park(),
        Home(Axis.AZIMUTH),
    ]
    assert not any(again.moves(order) for order in orders)
    assert again.loop.status.notices, "who sends is told why"
    assert not again.moves(Release(), by), "a release orders no motion"
    assert again.moves(Aim(200.0, 30.0))
    assert Run(tmp_path, again).moves(Aim(60.0, 30.0)), "the release has survived too"


def test_a_storm_park_holds_and_is_driven_on_by_a_person_alone(tmp_path: Path) -> None:
    run = Run(tmp_path)
    run.order(Park(storm=True), CONSOLE)
    run.wait(4.0)
    again = Run(tmp_path, run)
    again.wait(2.0)
    stood = again.world.antenna()
    again.wait(10.0)
    assert again.world.antenna() == stood, "a person may have climbed the mast meanwhile"
    assert not again.moves(Aim(100.0, 60.0))
    assert again.moves(Park(storm=True), CONSOLE)
    again.wait(60.0)
    assert again.world.antenna() == pytest.approx((0.0, 0.0), abs=4.5)
    assert not Run(tmp_path, again).moves(Aim(100.0, 60.0))


def test_a_storm_park_goes_on_where_the_computer_stood_still_for_a_moment(tmp_path: Path) -> None:
    run = Run(tmp_path)
    run.order(Park(storm=True), CONSOLE)
    run.wait(3.0)
    run.clock.sleep(1.0)
    run.wait(1.0)
    assert run.loop.status.faults
    run.wait(60.0)
    assert run.world.antenna() == pytest.approx((0.0, 0.0), abs=4.5)


def test_every_display_names_who_stopped_it(tmp_path: Path) -> None:
    run = Run(tmp_path)
    run.order(Stop(latch=True), CONSOLE)
    status = Run(tmp_path, run).loop.status
    assert headline(status)[0] == "STOPPED by a rotator command before the restart"
    assert line(status).endswith("STOPPED by a rotator command before the restart")
    assert spoken(held_by(status.latched, storm=status.storm)) == (
        "stopped by a rotator command before the restart: nothing moves until resume"
    )
    assert lcd.rows(status, lcd.ALTERNATE_S)[0] == "STOP: COMMAND   "


def test_a_damaged_file_stops_the_box_and_says_so(tmp_path: Path) -> None:
    (tmp_path / "state.json").write_bytes(b"\0" * 60)
    run = Run(tmp_path)
    assert headline(run.loop.status)[0] == "STOPPED by the damaged state file"
    assert not run.moves(Aim(200.0, 60.0))
    run.order(Release(), PANEL)
    assert run.moves(Aim(200.0, 60.0))
