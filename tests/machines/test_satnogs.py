"""A SatNOGS v3 on two stepper chips in real time: homing at the switches, EasyComm and rotctld, power cuts, a kill.

Where the antenna stands is the world's word.
"""

from __future__ import annotations

import random
from collections.abc import Callable

import pytest

from tests.machines.shack import Shack, Terminal, fly, standing, until_kept

ONE_TURN_OF_FIELD_DEG = 0.15
"""As a chip takes a place: at the nearest that fits the field of its coils."""
Place = tuple[float, float]


def order(pc: Terminal, place: Place) -> None:
    pc.send(f"AZ{place[0]:.1f} EL{place[1]:.1f}\r")


def somewhere(chance: random.Random) -> Place:
    """Not far from the lower ends: homing takes its time."""
    return round(chance.uniform(10.0, 45.0), 1), round(chance.uniform(5.0, 30.0), 1)


def homed(machine: Shack) -> None:
    """A person homes both axes and watches. The world must agree that they are at their switches."""
    for number, axis in enumerate(("azimuth", "elevation")):
        machine.rotator("home", axis, "--yes")
        assert machine.world().shafts_deg[number] == pytest.approx(-2.0, abs=0.3), machine.log()


def with_motion(machine: Shack) -> None:
    machine.until(lambda world: world.drives != (0, 0), "the antenna starts")


def test_a_day(shack: Callable[..., Shack], chance: random.Random) -> None:
    machine = shack("satnogs")
    machine.turned_by_hand(*somewhere(chance))
    machine.start()
    pc = Terminal(machine.ptys[0])
    placed = machine.stands()

    # Nothing is known yet: a program moves nothing.
    order(pc, somewhere(chance))
    assert machine.stands() == pytest.approx(placed, abs=0.01)
    homed(machine)

    # Aims, read back; a pass.
    place = somewhere(chance)
    order(pc, place)
    machine.arrives(*place, ONE_TURN_OF_FIELD_DEG)
    pc.send("AZ EL\r")
    azimuth, elevation = pc.answer().strip().removeprefix("AZ").split(" EL")
    assert (float(azimuth), float(elevation)) == pytest.approx(place, abs=0.1)
    points = [(20.0 + 2.0 * step, 10.0 + 1.5 * step) for step in range(8)]
    fly(lambda az, el: order(pc, (az, el)), points, every_s=0.5)
    machine.arrives(*points[-1], ONE_TURN_OF_FIELD_DEG)

    # At rest: a restart, and a power cut, leave it knowing where it is.
    for ends in ("stopped", "killed", "power cut"):
        until_kept(machine)
        stood = machine.stands()
        pc.close()
        machine.stop() if ends == "stopped" else machine.cut()
        if ends == "power cut":
            machine.power_cut()
        machine.start()
        assert machine.stands() == pytest.approx(stood, abs=0.01), ends
        pc = Terminal(machine.ptys[0])
        place = somewhere(chance)
        order(pc, place)
        machine.arrives(*place, ONE_TURN_OF_FIELD_DEG)

    # Stopped properly in mid-move it brakes, and knows its place. Killed in mid-move it has to be homed.
    for ends in ("stopped", "killed"):
        order(pc, (5.0, 5.0) if machine.stands()[0] > 25.0 else (45.0, 25.0))
        with_motion(machine)
        pc.close()
        machine.stop() if ends == "stopped" else machine.cut()
        known = ends == "stopped"
        assert (standing(machine) == ["known", "known"]) is known, ends
        machine.start()
        pc = Terminal(machine.ptys[0])
        if not known:
            stood = machine.stands()
            order(pc, somewhere(chance))
            assert machine.stands() == pytest.approx(stood, abs=0.01), "not homed"
            homed(machine)
        place = somewhere(chance)
        order(pc, place)
        machine.arrives(*place, ONE_TURN_OF_FIELD_DEG)
    pc.close()
    machine.stop()
    assert machine.faults() == []
