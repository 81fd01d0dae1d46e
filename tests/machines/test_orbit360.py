"""Two ORBIT-360 boxes in real time: Termite's bytes, rotctl, a pass, park, stops right after a start elsewhere.

The rotor turns five times as fast as the builder's, so that a day is short. Where it stands is the world's word.
"""

from __future__ import annotations

import random
import subprocess
import time
from collections.abc import Callable

import pytest

from tests.machines.shack import Shack, Terminal, fly

SPEED_DPS = 30.0
COAST_DEG = SPEED_DPS * 0.045
FAST = {"speed_dps": SPEED_DPS, "coast_s": 0.045}
SIM = {"speed_dps": SPEED_DPS, "lag_s": 0.03}
KEYS = {"azimuth": FAST, "elevation": FAST, "sim": {"azimuth": SIM, "elevation": SIM}}
NEAR_DEG = 2.2
"""Half a step of the chip, half the play of the gear, and what a small correction leaves."""
AT_AN_END_DEG = 3.2
"""The wiper does not lead beyond an end: there the dead band stays."""
UNSTOPPED_DEG = 20.0
"""What it turns until the bytes of a stop are obeyed on a busy machine. Without a stop it turns on to its target."""


def moving(shack: Shack, since: tuple[float, float]) -> None:
    shack.until(
        lambda world: max(abs(at - was) for at, was in zip(world.shafts_deg, since, strict=True)) > 1.5,
        "the antenna moves",
    )


def far_from(place: float, low: float, high: float) -> float:
    """A target half of the range away, or nearly so."""
    return (place + (high - low) / 2 - low) % (high - low) + low


def stopped(machine: Shack, at: tuple[float, float]) -> tuple[float, float]:
    """It stands near where it was when the stop came, and stays there."""
    stood = machine.stands()
    assert stood == pytest.approx(at, abs=UNSTOPPED_DEG), machine.log()
    until_s = machine.world().at_s + 2.0
    machine.until(lambda world: world.at_s > until_s, "two seconds pass")
    assert machine.world().antenna_deg == pytest.approx(stood, abs=0.1)
    return stood


def test_a_day(shack: Callable[..., Shack], chance: random.Random, need_program: Callable[[str, str], str]) -> None:
    rotctl = need_program("rotctl", "libhamlib-utils")
    machine = shack("orbit360", KEYS)
    place = chance.uniform(0, 358), chance.uniform(0, 88)
    machine.turned_by_hand(*place)
    machine.start()
    terminal = Terminal(machine.ptys[0])
    assert machine.stands() == place, "no motion before an order"

    # It stands elsewhere than it is assumed to: a stop right after the first order stops it there.
    azimuth, elevation = far_from(place[0], 30, 330), far_from(place[1], 10, 80)
    terminal.send(f"W{azimuth:03.0f} {elevation:03.0f}\r")
    moving(machine, place)
    terminal.send("S\r")
    stopped(machine, machine.world().shafts_deg)

    # The same order again, by Termite, is carried out, and read back.
    azimuth, elevation = round(azimuth), round(elevation)
    terminal.send(f"W{azimuth:03d} {elevation:03d}\r")
    full_travel_s = machine.world().at_s + 360 / SPEED_DPS / 0.75 + 3
    machine.until(lambda world: world.at_s > full_travel_s, "a full travel is over")
    machine.arrives(azimuth, elevation, NEAR_DEG)
    terminal.send("C2\r")
    read = terminal.answer()
    assert abs(int(read[3:6]) - azimuth) <= NEAR_DEG, read

    # A pass from a tracking program on the serial port.
    first = chance.randint(40, 300)
    points = [(first + 2 * step, 20 + step) for step in range(8)]
    fly(lambda az, el: terminal.send(f"W{az:03.0f} {el:03.0f}\r"), points, every_s=0.5)
    machine.arrives(*points[-1], NEAR_DEG)
    terminal.close()

    # Hamlib over the network, then the park position.
    to = str(chance.randint(20, 340)), str(chance.randint(10, 80))
    client = [rotctl, "-m", "2", "-r", f"127.0.0.1:{machine.ports['rotctld']}"]
    subprocess.run([*client, "P", *to], check=True, timeout=60)
    machine.arrives(float(to[0]), float(to[1]), NEAR_DEG)
    subprocess.run([*client, "K"], check=True, timeout=60)
    machine.arrives(180, 0, AT_AN_END_DEG)

    assert machine.faults() == []
    angle_kept(machine, chance)
    a_power_cut(machine, Terminal(machine.ptys[0]), chance)


def angle_kept(machine: Shack, chance: random.Random) -> None:
    """A proper stop and a kill at rest: the next run knows the angle, and its first order rests where it was sent."""
    for kill in (False, True):
        there = chance.randint(30, 330), chance.randint(15, 75)
        terminal = Terminal(machine.ptys[0])
        terminal.send(f"W{there[0]:03d} {there[1]:03d}\r")
        machine.arrives(*there, NEAR_DEG)
        time.sleep(2.5)  # the angle at rest is kept within two looks of a second
        terminal.close()
        if kill:
            machine.cut()
            machine.power_cut()
        else:
            machine.stop()
        machine.start()
        terminal = Terminal(machine.ptys[0])
        terminal.send("C2\r")
        read = terminal.answer()
        assert abs(int(read[3:6]) - there[0]) <= NEAR_DEG + 0.5, read
        on = there[0] + chance.choice([-18, 18]), there[1] + chance.choice([-9, 9])
        terminal.send(f"W{on[0]:03d} {on[1]:03d}\r")
        machine.arrives(*on, NEAR_DEG)
        terminal.close()


def a_power_cut(machine: Shack, terminal: Terminal, chance: random.Random) -> None:
    """In mid-move; a person turns the antenna; SIGTERM in mid-move right after the next start."""
    stood = machine.world().shafts_deg
    terminal.send("W350 080\r")
    moving(machine, stood)
    terminal.close()
    machine.cut()
    machine.power_cut()
    place = chance.uniform(0, 358), chance.uniform(0, 88)
    machine.turned_by_hand(*place)
    machine.start()
    assert machine.stands() == place
    terminal = Terminal(machine.ptys[0])
    terminal.send(f"W{far_from(place[0], 30, 330):03.0f} {far_from(place[1], 10, 80):03.0f}\r")
    moving(machine, place)
    at = machine.world().shafts_deg
    machine.stop()
    assert machine.world().rests_deg == pytest.approx(at, abs=UNSTOPPED_DEG)
    assert machine.faults() == []
    terminal.close()
