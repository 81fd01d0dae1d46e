"""A Yaesu G-5500 in real time: Termite's bytes, a pass, a power cut in mid-move, a start elsewhere, SIGTERM."""

from __future__ import annotations

import random
from collections.abc import Callable

from tests.machines.shack import Shack, Terminal, fly

NEAR_DEG = 4.6
"""The tolerance, the backlash and the noise of the pot."""


def test_a_day(shack: Callable[..., Shack], chance: random.Random) -> None:
    machine = shack("g5500")
    machine.turned_by_hand(chance.uniform(-2, 452), chance.uniform(-2, 182))
    machine.start()
    terminal = Terminal(machine.ptys[0])

    # No motion before an order, then an order within some ten seconds of travel.
    stood = machine.stands()
    azimuth, elevation = (stood[0] + chance.choice([-60, 60])) % 360, chance.uniform(0, 25)
    terminal.send(f"W{azimuth:03.0f} {elevation:03.0f}\r")
    machine.until(lambda world: world.drives != (0, 0), "the antenna starts")
    terminal.send("C2\r")
    assert terminal.answer().startswith("AZ=")

    # A stop, and the bytes of a pass.
    terminal.send("S\r")
    stood = machine.stands()
    terminal.close()
    terminal = Terminal(machine.ptys[0])
    first = min(max(stood[0], 20), 430)
    points = [((first + step) % 360, 10 + step) for step in range(8)]
    fly(lambda az, el: terminal.send(f"W{az:03.0f} {el:03.0f}\r"), points, every_s=1.0)
    azimuth, elevation = points[-1]
    machine.until(lambda world: abs((world.antenna_deg[0] - azimuth + 180) % 360 - 180) < NEAR_DEG, "it follows")

    # Power cut in mid-move; a person turns the antenna; the box starts again and moves nothing by itself.
    terminal.send(f"W{(first + 90) % 360:03.0f} 030\r")
    machine.until(lambda world: world.drives != (0, 0), "the antenna starts")
    terminal.close()
    machine.cut()
    machine.power_cut()
    place = chance.uniform(0, 450), chance.uniform(0, 180)
    machine.turned_by_hand(*place)
    machine.start()
    assert machine.stands() == place, "no motion before an order"
    machine.stop()
    assert machine.faults() == []
