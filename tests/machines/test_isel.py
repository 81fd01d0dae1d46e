"""The ISEL machine in real time: Gpredict sends to Debian's `rotctld -m 1`, and the box follows that.

Also a day with power cuts: the controllers forget their turns, and a person says where the antenna stands.
"""

from __future__ import annotations

import random
from collections.abc import Callable
from typing import Any

import pytest

pytest.importorskip("moteus", reason="moteus is missing: pip install --no-deps moteus")

from tests.boxes import free_port
from tests.machines.gpredict import Gpredict, dummy_rotor
from tests.machines.shack import Shack, fly

NEAR_DEG = 0.05
"""The rotctld's two decimals, and what a moteus leaves."""
RANGE_DEG = (0.0, 450.0), (0.0, 90.0)


GEARED: dict[str, Any] = {
    "azimuth": {"max_deg": 450},
    "mount": {"park_azimuth_deg": 0},
    "moteus": {"azimuth": {"geared": True}, "elevation": {"geared": True}},
}
"""The only encoders are before the gears, and the azimuth overlaps: after a power cut a person is asked."""
FARTHEST_DEG = 12.0
"""Of an order, from the dummy's 0/0."""


def keys(port: int) -> dict[str, Any]:
    """The builder's own set-up beside the shipped links: the box follows the rotctld that Gpredict sends to."""
    follow = {"protocol": "rotctld-follow", "connect": f"127.0.0.1:{port}"}
    return GEARED | {"link": [{"protocol": "rotctld", "tcp": "127.0.0.1:4533"}, follow]}


def somewhere(chance: random.Random) -> tuple[float, float]:
    (least_az, most_az), (least_el, most_el) = RANGE_DEG
    return chance.uniform(least_az, most_az), chance.uniform(least_el, most_el)


def confirm(machine: Shack, place: tuple[float, float]) -> None:
    """A person looks at the antenna, and is right to some degrees: half a turn of the motor is 18°."""
    for axis, angle_deg in zip(("azimuth", "elevation"), place, strict=True):
        machine.rotator("confirm", axis, f"{angle_deg + 3.0:.0f}")


def own_faults(machine: Shack) -> list[str]:
    """The faults of this run, without those of a new supply, which the test itself has caused."""
    return [line for line in machine.faults() if "position unknown" not in line]


def test_a_day(shack: Callable[..., Shack], chance: random.Random, need_program: Callable[[str, str], str]) -> None:
    rotctld, port = need_program("rotctld", "libhamlib-utils"), free_port()
    machine = shack("isel", keys(port))
    place = somewhere(chance)
    while _turn(place, FARTHEST_DEG, 0.0)[0] - _turn(place, 0.0, 0.0)[0] != FARTHEST_DEG:
        place = somewhere(chance)  # the box hears the dummy on its way, and takes the turn that is nearest then
    machine.turned_by_hand(*place)
    with dummy_rotor(rotctld, port) as gpredict:
        machine.start()
        assert machine.stands() == pytest.approx(place), "no motion before an order"
        confirm(machine, place)
        assert machine.stands() == pytest.approx(place), "no motion by confirming"

        # An order, within a second or two of the dummy's travel from its 0/0; read back on both.
        azimuth, elevation = chance.uniform(2, FARTHEST_DEG), chance.uniform(2, FARTHEST_DEG)
        gpredict.send(azimuth, elevation)
        shown = machine.arrives(*_turn(place, azimuth, elevation), NEAR_DEG)
        assert gpredict.read() == pytest.approx((shown[0] % 360, shown[1]), abs=0.1)
        box = Gpredict(machine.ports["rotctld"])
        assert box.read() == pytest.approx(shown, abs=0.1)

        # A pass, a point each second, then a stop that stops, then park.
        points = [(azimuth + 1.3 * second, elevation + 1.1 * second) for second in range(6)]
        fly(gpredict.send, points, every_s=1.0)
        machine.arrives(*_turn(shown, *points[-1]), NEAR_DEG)
        box.park()
        machine.until(lambda world: world.antenna_deg[1] < 1.0, "it goes to its park position")

        # A power cut in mid-move; the antenna is turned; both controllers forget.
        box.send(80, 40)
        machine.until(lambda world: world.antenna_deg[1] > 3.0, "it moves")
        box.close()
        machine.cut()
        machine.power_cut()
    assert own_faults(machine) == []
    place = somewhere(chance)
    machine.turned_by_hand(*place)
    machine.start()
    assert machine.stands() == pytest.approx(place), "no motion before an order"
    confirm(machine, place)
    box = Gpredict(machine.ports["rotctld"])
    target = min(place[0] + 15.0, 449.0), min(place[1] + 10.0, 89.0)
    box.send(target[0], target[1])
    machine.arrives(*_turn(place, *target), NEAR_DEG)
    box.close()
    machine.stop()
    assert own_faults(machine) == []

    # The program alone starts anew: the controllers have kept their turns, and nobody is asked.
    stood = machine.world().antenna_deg
    machine.start()
    assert machine.stands() == pytest.approx(stood, abs=0.01)
    machine.stop()
    assert machine.faults() == []


SEAM_DEG = 6.0
"""Nearer than this to the seam of its turn an encoder on the output cannot tell one end of the range from the other."""


def test_after_power_cuts_nobody_is_asked(shack: Callable[..., Shack], chance: random.Random) -> None:
    """As shipped: cut in mid-move, turned by wind or hand meanwhile, and again at a place where it rests."""
    machine = shack("isel")

    def anywhere() -> tuple[float, float]:
        return chance.uniform(SEAM_DEG, 360.0 - SEAM_DEG), chance.uniform(0.0, 90.0)

    for in_motion in (True, False, True):
        place = anywhere()
        machine.turned_by_hand(*place)
        machine.start()
        assert machine.stands() == pytest.approx(place, abs=0.01), "no motion before an order"
        box, target = Gpredict(machine.ports["rotctld"]), anywhere()
        box.send(*target)
        if in_motion:
            machine.until(lambda world, at=place: world.antenna_deg != at, "it moves")  # type: ignore[misc]
        else:
            stands = machine.arrives(*target, NEAR_DEG)
            assert box.read() == pytest.approx(stands, abs=0.1)
        box.close()
        machine.cut()
        machine.power_cut()
        assert "position unknown" not in machine.log()


def _turn(near: tuple[float, float], azimuth_deg: float, elevation_deg: float) -> tuple[float, float]:
    """The order on the turn of the overlap that is nearest to `near`."""
    low, high = RANGE_DEG[0]
    turns = [azimuth_deg + 360.0 * turn for turn in (-1, 0, 1) if low <= azimuth_deg + 360.0 * turn <= high]
    return min(turns, key=lambda turn: abs(turn - near[0])), elevation_deg
