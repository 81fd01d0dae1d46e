"""`tolerance = "axis"`, as an Arduino compares: a motor starts when its axis and the latest order differ by more than
the tolerance, in plain degrees of that axis, and never before. Judged by the angle of the simulated rotor.
"""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hw.ports import Axis, Direction
from rotator.exchange.orders import Aim
from tests.search import examples
from tests.tables import every_row

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
TOLERANCE_DEG = 4.0
NOISE_DEG = 0.05
"""Arithmetic; the desk's pots have no noise."""


@every_row("elevation_deg", [10.0, 60.0, 85.0])
@every_row(("off_deg", "starts"), [(3.9, False), (4.1, True), (-3.9, False), (-4.1, True)])
def test_four_degrees_are_four_degrees_at_every_elevation(
    new_desk: Any, elevation_deg: float, off_deg: float, starts: bool
) -> None:
    desk = new_desk(at=(100.0, elevation_deg), on_sky=False)
    desk.run(1.0)
    assert (desk.step(Aim(100.0 + off_deg, elevation_deg))[AZ] is not Direction.OFF) is starts


@pytest.mark.long
@settings(max_examples=examples(30), deadline=None)
@given(
    st.floats(20, 400),
    st.floats(0, 80),
    st.floats(-3, 3),
    st.floats(-1.5, 1.5),
    st.sampled_from([0.5, 1.0, 2.0]),
)
def test_along_any_stream_no_motor_starts_early_and_none_rests_late(  # noqa: PLR0917
    new_desk: Any, azimuth_deg: float, elevation_deg: float, az_dps: float, el_dps: float, every_s: float
) -> None:
    desk = new_desk(at=(azimuth_deg, elevation_deg), on_sky=False)
    desk.run(1.0)
    was = dict(desk.driven)
    target = {AZ: azimuth_deg, EL: elevation_deg}
    for count in range(round(30 / every_s)):
        t_s = count * every_s
        az_deg, el_deg = azimuth_deg + az_dps * t_s, elevation_deg + el_dps * t_s
        # The box looks as far ahead as the stream has lasted, and turns round before the target is beyond the end.
        seen_ahead_deg = azimuth_deg + az_dps * (2 * t_s + 10)
        if not (0 <= seen_ahead_deg <= 450 and 0 <= el_deg <= 90):
            break
        orders = [Aim(az_deg if az_deg > 360 else az_deg % 360, el_deg)]
        target = {AZ: az_deg, EL: el_deg}
        for _ in range(round(every_s / 0.05)):
            stood = dict(desk.angle_deg)
            now = desk.step(*orders)
            orders = []
            for axis in Axis:
                off_deg = abs(target[axis] - stood[axis])
                if now[axis] is not Direction.OFF and was[axis] is Direction.OFF:
                    # A coasting axis is judged by where it will come to rest, up to the motor's coast further on.
                    assert off_deg > TOLERANCE_DEG - NOISE_DEG - desk.SPEED_DPS[axis] * desk.LAG_S, (axis, off_deg)
            was = dict(now)
    desk.run(20.0)
    for axis in Axis:
        assert abs(target[axis] - desk.angle_deg[axis]) <= TOLERANCE_DEG + NOISE_DEG
        assert desk.driven[axis] is Direction.OFF
