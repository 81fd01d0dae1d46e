"""Two TV rotators from which nothing comes back, in real time: a GS-232's bytes, a pass, stops, ends, power cuts.

They turn at three times their speed, so that a day is short, and never quite as fast as the file says. Where the
antenna is, is the word of the world; what the box says of that must be true within what it says it may be off.
"""

from __future__ import annotations

import json
import random
import time
from collections.abc import Callable
from typing import Any

from firmware_sim.world_file import WorldState
from tests.machines.shack import Shack, Terminal, fly

SPEED_DPS = 18.0
FAST = {"speed_dps": SPEED_DPS}
KEYS = {"azimuth": FAST, "elevation": FAST | {"fitted": True}, "sim": {"azimuth": FAST, "elevation": FAST}}
NEAR_DEG = 4.0 + 1.0 + 0.03 * 360.0
"""The tolerance, the play of the gear, and what a motor of 3 % less speed lacks after a whole turn."""
AT_STOP_DEG = 0.5
PLAY_DEG = 0.5


def claims(machine: Shack) -> dict[str, Any]:
    """What the box says of itself; each angle must be as near to the truth as it says."""
    told: dict[str, Any] = json.loads(machine.rotator("where", "--json"))
    for place, axis in zip(machine.world().antenna_deg, ("azimuth", "elevation"), strict=True):
        assert told[axis]["angle_source"] == "modelled"
        if told[axis]["missing"]:
            assert told[axis]["error_deg"] is None, "its place is not known"
        else:
            off_deg = abs(told[axis]["angle_deg"] - place)
            assert off_deg <= told[axis]["error_deg"] + PLAY_DEG, f"{axis}: {told[axis]}, it is at {place}"
    return told


def order(pc: Terminal, azimuth_deg: float, elevation_deg: float) -> None:
    pc.send(f"W{azimuth_deg:03.0f} {elevation_deg:03.0f}\r")


def goes_to_its_stop_first(machine: Shack, pc: Terminal, chance: random.Random) -> None:
    """Its place is not known: the first order leads to the low stops, and then where it should."""
    assert claims(machine)["azimuth"]["missing"] == ["homing"]
    place = chance.randrange(60, 300), chance.randrange(30, 80)
    order(pc, *place)
    met: set[int] = set()

    def both_were_there(world: WorldState) -> bool:
        met.update(axis for axis in range(2) if world.shafts_deg[axis] < AT_STOP_DEG)
        return len(met) == 2

    machine.until(both_were_there, "both axes come to their stops")
    machine.arrives(*place, NEAR_DEG)
    assert claims(machine)["azimuth"]["missing"] == []


def under_way(machine: Shack, pc: Terminal, chance: random.Random) -> None:
    """Sent far away, it has turned for a while."""
    azimuth_deg = machine.world().shafts_deg[0]
    order(pc, chance.randrange(10, 40) if azimuth_deg > 180 else chance.randrange(320, 350), chance.randrange(10, 80))
    machine.until(lambda world: abs(world.shafts_deg[0] - azimuth_deg) > 20.0, "the antenna is under way")


def until_kept(machine: Shack) -> None:
    """Both axes stand in the file."""
    file, give_up_s = machine.folder / "counts.json", time.monotonic() + 20.0
    while [each["standing"] for each in json.loads(file.read_text())["axes"].values()] != ["known", "known"]:
        assert time.monotonic() < give_up_s, file.read_text()
        time.sleep(0.1)


def test_a_day(shack: Callable[..., Shack], chance: random.Random) -> None:
    machine = shack("tv-rotator", KEYS)
    begun = chance.uniform(20, 340), chance.uniform(10, 170)
    machine.turned_by_hand(*begun)
    machine.start()
    pc = Terminal(machine.ptys[0])
    assert machine.stands() == begun, "no motion before an order"
    goes_to_its_stop_first(machine, pc, chance)

    # A pass, and a stop amid a run: the angle goes on to be right.
    first = chance.randint(40, 300)
    points = [(first + 2 * step, 20 + step) for step in range(8)]
    fly(lambda az, el: order(pc, az, el), points, every_s=0.5)
    machine.arrives(*points[-1], NEAR_DEG)
    under_way(machine, pc, chance)
    pc.send("S\r")
    machine.stands()
    claims(machine)

    # The program ends while it turns: the next run knows where it is.
    under_way(machine, pc, chance)
    pc.close()
    machine.stop()
    machine.start()
    pc = Terminal(machine.ptys[0])
    assert claims(machine)["azimuth"]["missing"] == []

    # A power cut at rest loses nothing; one while it turns loses the place.
    machine.stands()
    until_kept(machine)
    pc.close()
    machine.cut()
    machine.power_cut()
    machine.start()
    pc = Terminal(machine.ptys[0])
    assert claims(machine)["azimuth"]["missing"] == []
    under_way(machine, pc, chance)
    pc.close()
    machine.cut()
    machine.power_cut()
    machine.start()
    pc = Terminal(machine.ptys[0])
    goes_to_its_stop_first(machine, pc, chance)

    # A person sends it to its stop.
    machine.rotator("home", "azimuth", "--yes")
    assert abs(machine.world().shafts_deg[0]) < AT_STOP_DEG
    claims(machine)
    pc.close()
    machine.stop()
    assert machine.faults() == []
