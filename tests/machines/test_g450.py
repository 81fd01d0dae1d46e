"""An azimuth rotor alone, in real time: the bytes of Termite and Gpredict, a power cut in mid-move, a start elsewhere.

The motor of the elevation that is not fitted stands beside in the simulated world, ready to turn: it never does.
"""

from __future__ import annotations

import random
from collections.abc import Callable

from tests.machines.shack import Shack, Terminal, fly

NEAR_DEG = 4.6
"""The tolerance, the backlash and the noise of the pot."""


def test_a_day(shack: Callable[..., Shack], chance: random.Random) -> None:
    machine = shack("g450")
    machine.turned_by_hand(chance.uniform(-2, 452), 0.0)
    machine.start()
    terminal = Terminal(machine.ptys[0])

    # No motion before an order. Then one with an elevation that the rotor does not have, and a question for it.
    stood = machine.stands()
    azimuth = (stood[0] + chance.choice([-60, 60])) % 360
    terminal.send(f"W{azimuth:03.0f} 045\r")
    machine.until(lambda world: world.drives[0] != 0, "the antenna starts")
    terminal.send("C2\r")
    assert terminal.answer().strip().endswith("EL=000")

    # A button that would raise it is refused; a stop; the bytes of a pass that is high up.
    terminal.send("U\r")
    assert terminal.answer().strip() == "?>"
    terminal.send("S\r")
    stood = machine.stands()
    first = min(max(stood[0], 20), 430)
    points = [((first + step) % 360, 10 + 8 * step) for step in range(8)]
    fly(lambda az, el: terminal.send(f"W{az:03.0f} {el:03.0f}\r"), points, every_s=1.0)
    azimuth, _ = points[-1]
    machine.until(lambda world: abs((world.antenna_deg[0] - azimuth + 180) % 360 - 180) < NEAR_DEG, "it follows")

    # Power cut in mid-move; a person turns the antenna; the box starts again and moves nothing by itself.
    terminal.send(f"M{(first + 90) % 360:03.0f}\r")
    machine.until(lambda world: world.drives[0] != 0, "the antenna starts")
    terminal.close()
    machine.cut()
    machine.power_cut()
    place = chance.uniform(0, 450), 0.0
    machine.turned_by_hand(*place)
    machine.start()
    assert machine.stands() == place, "no motion before an order"
    assert machine.world().shafts_deg[1] == 0.0, "the axis that is not fitted has never turned"
    machine.stop()
    assert machine.faults() == []
