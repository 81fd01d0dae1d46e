"""The faults that need threads and a real clock: a bus that blocks whoever asks, an adapter's lines, its plug.

The box runs as it does under `rotator run`: the loop in its thread, the rotor with its own. Nobody counts seconds here.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator

import pytest

from hw.ports import Axis
from rotator.assembly.settings import build_controller
from rotator.assembly.station import Station
from rotator.exchange.orders import Aim, Order, Stop
from rotator.exchange.sources import Source
from rotator.exchange.status import Status
from rotator.runtime.loop import ControlLoop
from tests.rotors.outcomes import REAL_TIME
from tests.rotors.rig import AZ, EL, KINDS, Kind, configured

PATIENCE_S = 30.0
LOOK_S = 0.02
FAST = {"azimuth": {"speed_dps": 30.0, "tolerance_deg": 1.0}, "sim": {"azimuth": {"speed_dps": 30.0}}}
BY_NAME = {kind.profile: kind for kind in KINDS}
FAULTS = [(profile, name) for profile, names in REAL_TIME.items() for name in names]


class LiveBox:
    """The loop and the rotor in threads of their own, as the engine starts them."""

    def __init__(self, kind: Kind) -> None:
        self.kind = kind
        config = configured(kind.profile, **FAST)
        self.station = Station(config, time.monotonic, time.sleep, kind.start_deg)
        assert self.station.world is not None
        self.world = self.station.world
        self.loop = ControlLoop(
            build_controller(config), self.station.rotor, time.monotonic, 1 / config.control.rate_hz
        )
        self._thread = threading.Thread(target=self.loop.run, name="control")
        self.station.rotor.start()
        self._thread.start()

    @property
    def status(self) -> Status:
        return self.loop.status

    def azimuth_deg(self) -> float:
        return self.world.antenna()[0]

    def fault(self, axis: Axis) -> str:
        fault = self.status.axis(axis).fault
        return fault.name if fault else ""

    def order(self, order: Order) -> None:
        self.loop.post(Source("test"), order)

    def wait_for(self, done: Callable[[], bool]) -> None:
        give_up_s = time.monotonic() + PATIENCE_S
        while not done():
            assert time.monotonic() < give_up_s, f"it never came: {self.status}"
            threading.Event().wait(LOOK_S)

    def stands(self) -> bool:
        before_deg = self.azimuth_deg()
        threading.Event().wait(10 * LOOK_S)
        return abs(self.azimuth_deg() - before_deg) <= self.kind.trembles_deg

    def acknowledged(self) -> bool:
        """A stop after another, as a person presses it till the display is quiet."""
        self.order(Stop())
        threading.Event().wait(10 * LOOK_S)
        return self.status.faults == ()

    def close(self) -> None:
        self.loop.stop()
        self._thread.join(PATIENCE_S)
        self.station.close()


@pytest.fixture
def live(profile: str) -> Iterator[LiveBox]:
    box = LiveBox(BY_NAME[profile])
    try:
        yield box
    finally:
        box.close()


@pytest.mark.parametrize(("profile", "name"), FAULTS, ids=[f"{profile}-{name}" for profile, name in FAULTS])
def test_it_stands_says_so_and_goes_on_when_it_is_over(live: LiveBox, name: str) -> None:
    from_deg = live.kind.start_deg[0]
    live.wait_for(lambda: live.status.azimuth.angle_deg is not None and live.status.faults == ())
    live.order(Aim(from_deg + 200.0 if live.kind.profile != "servos" else 170.0, None))
    live.wait_for(lambda: live.azimuth_deg() > from_deg + 8.0)
    live.world.inject(name)
    live.wait_for(lambda: live.fault(AZ) != "")
    # Late answers may be told as too many bad readings first: threads of a busy machine decide that.
    late = ("bad readings",) if name == "lines-late" else ()
    assert live.fault(AZ) in (REAL_TIME[live.kind.profile][name].fault, *late)
    live.wait_for(live.stands)
    live.world.clear(name)
    live.wait_for(live.acknowledged)
    live.order(Aim(from_deg - 10.0, None))
    live.wait_for(lambda: abs(live.azimuth_deg() - from_deg + 10.0) <= live.kind.within_deg + 1.0)
    assert live.fault(AZ) == live.fault(EL) == ""
