"""A Yaesu G-1000 with its speed input in real time: X1 to X4 and a pass from Termite, a power cut in mid-move, SIGTERM.

The MCP4725 of the simulated world wakes as it is sold, with half its voltage; the simulated motor follows the voltage.
"""

from __future__ import annotations

import random
import time
from collections.abc import Callable

from tests.machines.shack import Shack, Terminal, fly

NEAR_DEG = 4.6
"""The tolerance, the backlash and the noise of the pot."""
FULL_DPS, LOWEST_DPS = 6.0, 2.1
"""Of the simulated motor: 6°/s, and the share 2.5 / 7 of the file."""


def dps(machine: Shack, seconds: float) -> float:
    """How fast the shaft turns, over this time."""
    before = machine.world()
    time.sleep(seconds)
    after = machine.world()
    return abs(after.shafts_deg[0] - before.shafts_deg[0]) / (after.at_s - before.at_s)


def test_a_day(shack: Callable[..., Shack], chance: random.Random) -> None:
    machine = shack("g1000")
    place_deg = chance.uniform(0, 450)
    machine.turned_by_hand(place_deg, 0.0)
    machine.start()
    terminal = Terminal(machine.ptys[0])
    assert machine.stands()[0] == place_deg, "no motion before an order"

    # X1 is the lowest speed, X4 the full one; it starts slowly, and a stop at full speed opens its relay at once.
    way = 1 if place_deg < 225 else -1
    terminal.send("X1\r")
    terminal.send(f"M{(place_deg + way * 120) % 360:03.0f}\r")
    machine.until(lambda world: world.drives[0] == way, "the antenna starts")
    time.sleep(2.0)
    assert dps(machine, 2.0) < LOWEST_DPS + 0.5
    terminal.send("X4\r")
    time.sleep(2.0)
    assert dps(machine, 2.0) > FULL_DPS - 1.0
    terminal.send("S\r")
    machine.until(lambda world: world.drives == (0, 0), "the motor is off", 5.0)

    # A move to its end: slow before it, and there.
    stood = machine.stands()
    target_deg = min(max(stood[0] + chance.choice([-60, 60]), 20), 430)
    terminal.send(f"M{target_deg % 360:03.0f}\r")
    machine.until(lambda world: world.drives[0] != 0, "the antenna starts")
    machine.until(lambda world: world.drives[0] == 0, "it arrives")
    assert abs((machine.stands()[0] - target_deg + 180) % 360 - 180) < NEAR_DEG

    # A pass; the power is cut in mid-move, a person turns the antenna, and the box moves nothing by itself.
    first = min(max(machine.stands()[0], 20), 430)
    fly(
        lambda az, el: terminal.send(f"W{az:03.0f} {el:03.0f}\r"),
        [((first + step) % 360, 40) for step in range(8)],
        1.0,
    )
    azimuth = (first + 7) % 360
    machine.until(lambda world: abs((world.antenna_deg[0] - azimuth + 180) % 360 - 180) < NEAR_DEG, "it follows")
    terminal.send(f"M{(first + 90) % 360:03.0f}\r")
    machine.until(lambda world: world.drives[0] != 0, "the antenna starts")
    time.sleep(chance.uniform(0.0, 3.0))
    terminal.close()
    machine.cut()
    machine.power_cut()
    place = chance.uniform(0, 450), 0.0
    machine.turned_by_hand(*place)
    machine.start()
    assert machine.stands() == place, "no motion before an order"

    # SIGTERM in mid-move.
    terminal = Terminal(machine.ptys[0])
    terminal.send(f"M{(180 if place[0] > 270 else 320):03.0f}\r")
    machine.until(lambda world: world.drives[0] != 0, "the antenna starts")
    time.sleep(2.0)
    terminal.close()
    machine.stop()
    assert machine.world().drives == (0, 0)
    assert machine.faults() == []
