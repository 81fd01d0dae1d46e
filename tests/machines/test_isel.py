"""The ISEL machine in real time: Gpredict sends to Debian's `rotctld -m 1`, and the box follows that.

Also a day with power cuts: the controllers forget their turns, and a person says where the antenna stands.
"""

from __future__ import annotations

import random
import time
from collections.abc import Callable
from typing import Any

import pytest

pytest.importorskip("moteus", reason="moteus is missing: pip install --no-deps moteus")

from tests.boxes import free_port
from tests.machines.gpredict import Gpredict, dummy_rotor
from tests.machines.shack import Shack, fly

NEAR_DEG = 0.05
"""The rotctld's two decimals, and what a moteus leaves."""
SLACK_DEG = 0.2
"""How far the antenna may pass the other rotor's way, which is known to the hundredth of a second only."""
SEGMENT_S = 8.0
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


def test_geared_and_with_a_compass_nobody_is_asked_either(shack: Callable[..., Shack], chance: random.Random) -> None:
    """Gravity tells the elevation, the compass the azimuth: the boom level enough, off the overlap and the ends."""
    compass = {"compass": {"kind": "bno055", "at_start": True}, "mount": {"declination_deg": 4.0}}
    gears = {"moteus": {axis: {"geared": True} for axis in ("azimuth", "elevation")}}
    machine = shack("isel", compass | gears)
    place = chance.uniform(15.0, 345.0), chance.uniform(0.0, 25.0)
    machine.turned_by_hand(*place)
    machine.start()
    machine.until(lambda _: "compass: azimuth stands at" in machine.log(), "the compass tells it")
    assert machine.stands() == pytest.approx(place, abs=0.01), "no motion before an order"
    target = chance.uniform(15.0, 345.0), chance.uniform(0.0, 90.0)
    give_up_s, box = time.monotonic() + 10.0, Gpredict(machine.ports["rotctld"])
    while time.monotonic() < give_up_s and "position unknown" in machine.rotator("where"):
        time.sleep(0.2)
    box.send(*target)
    machine.arrives(*target, NEAR_DEG)
    box.close()
    machine.stop()
    assert own_faults(machine) == []


def test_behind_the_dummy_rotor(
    shack: Callable[..., Shack], chance: random.Random, need_program: Callable[[str, str], str]
) -> None:
    """Steps, slews and stops of the other rotor, also through the zenith: the antenna passes no corner, and rests."""
    rotctld, port = need_program("rotctld", "libhamlib-utils"), free_port()
    machine = shack("isel", keys(port))
    machine.turned_by_hand(0.0, 0.0)
    with dummy_rotor(rotctld, port) as gpredict:
        machine.start()
        confirm(machine, (0.0, 0.0))
        follow_for(SEGMENT_S, machine, gpredict, chance)
        machine.stop()
    assert own_faults(machine) == []


def follow_for(seconds: float, machine: Shack, gpredict: Gpredict, chance: random.Random) -> float:
    """Order the dummy about, and watch the antenna. Returns how far it went beyond the dummy's way, in degrees."""
    end_s, beyond_deg = time.monotonic() + seconds, 0.0
    while time.monotonic() < end_s:
        began = gpredict.read()
        match chance.choice(["step", "slew", "stop", "zenith", "pass"]):
            case "step":
                gpredict.send(began[0] + chance.uniform(0.05, 2.0), min(began[1] + chance.uniform(0, 2.0), 90.0))
            case "zenith":
                gpredict.send(chance.uniform(0, 359), 90.0)
            case "pass":
                for second in range(5):
                    gpredict.send((began[0] + 0.7 * second) % 359, min(began[1] + 0.5 * second, 90.0))
                    beyond_deg = max(beyond_deg, _watch(machine, gpredict, began, 1.0))
            case kind:
                gpredict.send(chance.uniform(0, 359), chance.uniform(0, 90))
                if kind == "stop":
                    beyond_deg = max(beyond_deg, _watch(machine, gpredict, began, chance.uniform(0.3, 3.0)))
                    gpredict.stop()
        beyond_deg = max(beyond_deg, _watch(machine, gpredict, began, chance.uniform(0.5, 4.0)))
    rest = _at_rest(gpredict)
    machine.arrives(*rest, NEAR_DEG)
    return beyond_deg


def _watch(machine: Shack, gpredict: Gpredict, began: tuple[float, float], seconds: float) -> float:
    """How far the antenna goes beyond where the dummy has been since `began`. Fails beyond SLACK_DEG."""
    end_s, beyond_deg = time.monotonic() + seconds, 0.0
    low, high = list(began), list(began)
    antenna = machine.world().antenna_deg
    for axis in range(2):  # the antenna may still be on its way
        low[axis], high[axis] = min(low[axis], antenna[axis]), max(high[axis], antenna[axis])
    while time.monotonic() < end_s:
        antenna = machine.world().antenna_deg  # before the dummy is read: it is there, or was
        for axis, at in enumerate(gpredict.read()):
            low[axis], high[axis] = min(low[axis], at), max(high[axis], at)
            beyond_deg = max(beyond_deg, low[axis] - antenna[axis], antenna[axis] - high[axis])
        assert beyond_deg <= SLACK_DEG, f"{beyond_deg:.2f}° beyond: {antenna}, {low} to {high}\n{machine.log()}"
        time.sleep(0.02)
    return beyond_deg


def _at_rest(gpredict: Gpredict) -> tuple[float, float]:
    before = None
    while before != (now := gpredict.read()):
        before = now
        time.sleep(0.3)
    return now


def _turn(near: tuple[float, float], azimuth_deg: float, elevation_deg: float) -> tuple[float, float]:
    """The order on the turn of the overlap that is nearest to `near`."""
    low, high = RANGE_DEG[0]
    turns = [azimuth_deg + 360.0 * turn for turn in (-1, 0, 1) if low <= azimuth_deg + 360.0 * turn <= high]
    return min(turns, key=lambda turn: abs(turn - near[0])), elevation_deg
