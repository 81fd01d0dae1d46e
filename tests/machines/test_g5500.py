"""A Yaesu G-5500 in real time: Termite's bytes, a pass, a power cut in mid-move, a start elsewhere, SIGTERM."""

from __future__ import annotations

import random
import re
import time
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


def test_pstrotator_asks_five_times_a_second_and_points(shack: Callable[..., Shack], chance: random.Random) -> None:
    """Its bytes: `M` for azimuth alone, `W` for both, `C2` again and again, `S` from its stop button."""
    machine = shack("g5500")
    # Near the zenith 40° of azimuth are less than the tolerance on the sky: nothing would start.
    place = chance.uniform(0, 450), chance.choice([chance.uniform(0, 80), chance.uniform(100, 175)])
    machine.turned_by_hand(*place)
    machine.start()
    program = Terminal(machine.ptys[0])

    def asks() -> tuple[int, int]:
        program.send("C2\r")
        parts = re.fullmatch(r"AZ=(\d{3})  EL=(\d{3})\r\n", program.answer())
        assert parts, "an answer, whole and in time"
        return int(parts[1]), int(parts[2])

    # Azimuth alone; where the elevation is past the zenith the same direction is the other way round.
    azimuth = round((place[0] + chance.choice([-40, 40])) % 360)
    program.send(f"M{azimuth:03d}\r")
    machine.until(lambda world: world.drives[0] != 0, "the antenna starts")
    while machine.world().drives != (0, 0):
        shown, true = asks(), machine.world().antenna_deg
        assert all(abs(one - other) < 3.5 for one, other in zip(shown, true, strict=True)), (shown, true)
        time.sleep(0.2)
    stood = machine.stands()
    elevation = stood[1] + (15 if stood[1] < 90 else -15)
    program.send(f"W{round(stood[0]) % 360:03d} {elevation:03.0f}\r")
    machine.until(lambda world: world.drives != (0, 0), "the antenna starts")
    program.send("S\r")
    machine.until(lambda world: world.drives == (0, 0), "its stop button stops", patience_s=5)
    stood = machine.stands()
    assert all(abs(one - other) < 1.6 for one, other in zip(asks(), stood, strict=True))
    assert machine.faults() == []
    program.close()
    machine.stop()
