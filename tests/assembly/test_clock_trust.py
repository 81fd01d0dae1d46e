"""Whose clock counts: a simulated rotor may live at any time, a server of elements is real."""

from __future__ import annotations

import time

from rotator.assembly.kept_files import build_state
from rotator.assembly.settings import build_controller, build_mount
from rotator.assembly.station import Station
from rotator.assembly.tracking import build_tracking
from rotator.config.load import parse
from rotator.runtime.loop import ControlLoop


def test_a_simulated_rotor_is_no_reason_to_trust_the_clock_with_a_server() -> None:
    config = parse("", "no file")
    station = Station(config, time.monotonic, time.sleep)
    try:
        loop = ControlLoop(build_controller(config), station.rotor, time.monotonic, 0.05)
        tracking = build_tracking(config, loop, build_mount(config), build_state(config))
        assert tracking.tracker.clock_trusted()
        assert not tracking.clock_is_known()
        tracking.tracker.clock_is_right()
        assert tracking.clock_is_known()
    finally:
        station.close()
