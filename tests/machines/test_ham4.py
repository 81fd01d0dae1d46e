"""A Ham IV with its brake in real time: GS-232 and rotctld, stops, a power cut, presses, SIGTERM in mid-move.

Each proper end judges what its brake has felt in the simulated world. The stop is in the south: the rotor's scale
begins at 180°.
"""

from __future__ import annotations

import random
import socket
import time
from collections.abc import Callable

from tests.machines.shack import Shack, Terminal

NEAR_DEG = 6.0
"""The tolerance, the backlash and the noise of the pot."""
SOUTH_DEG = 180.0
RELEASE_S = 0.5
KEYS = {"azimuth": {"brake": {"engage_s": 2}}}


def test_a_day(shack: Callable[..., Shack], chance: random.Random) -> None:
    machine = shack("ham4", KEYS)
    place_deg = chance.uniform(0.0, 360.0)
    machine.turned_by_hand(place_deg, 0.0)
    machine.start()
    terminal = Terminal(machine.ptys[0])
    assert machine.stands()[0] == place_deg, "no motion before an order"

    # The brake is released first, then the motor starts. A stop opens it at once, and the antenna coasts to rest.
    way = 1 if place_deg < 180.0 else -1
    target_deg = place_deg + way * chance.uniform(60.0, 150.0)
    ordered_s = machine.world().at_s
    terminal.send(f"M{(target_deg + SOUTH_DEG) % 360:03.0f}\r")
    started = machine.until(lambda world: world.drives[0] == way, "the antenna starts")
    assert started.at_s - ordered_s >= RELEASE_S
    time.sleep(chance.uniform(0.0, 3.0))
    terminal.send("S\r")
    machine.until(lambda world: world.drives == (0, 0), "the motor is off", 5.0)
    machine.stands()

    # A new run while the brake is off, or just falls, or holds again.
    time.sleep(chance.uniform(0.0, 4.0))
    with socket.create_connection(("127.0.0.1", machine.ports["rotctld"])) as program:
        program.sendall(f"P {(target_deg + SOUTH_DEG) % 360:.1f} 45\n".encode())
        machine.until(lambda world: abs(world.antenna_deg[0] - target_deg) <= NEAR_DEG, "it arrives")
        machine.stands()
        program.sendall(b"p\n")
        answer = program.recv(100).decode()
    assert answer.splitlines()[0] == "RPRT 0"

    # Presses, shorter than the brake's release and longer.
    for _ in range(4):
        machine.rotator("jog", chance.choice(("cw", "ccw")), f"{chance.uniform(0.1, 1.5):.2f}")
        time.sleep(chance.uniform(0.0, 1.0))
    machine.stands()

    # Power cut in mid-move; the box starts again and moves nothing by itself.
    middle_deg = (180.0 if machine.world().antenna_deg[0] > 270.0 else 320.0) + SOUTH_DEG
    terminal.send(f"M{middle_deg % 360:03.0f}\r")
    machine.until(lambda world: world.drives != (0, 0), "the antenna starts")
    terminal.close()
    machine.cut()
    machine.power_cut()
    machine.start()
    stood = machine.stands()
    assert machine.stands() == stood

    # SIGTERM in mid-move: the program waits until its brake holds.
    terminal = Terminal(machine.ptys[0])
    terminal.send(f"M{(stood[0] + (40.0 if stood[0] < 180.0 else -40.0) + SOUTH_DEG) % 360:03.0f}\r")
    machine.until(lambda world: world.drives != (0, 0), "the antenna starts")
    time.sleep(chance.uniform(0.5, 2.0))
    machine.stop()
    terminal.close()
    assert machine.faults() == []
