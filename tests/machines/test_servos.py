r"""Two hobby servos in real time: the phone's bytes, a pass over the top, park, stops during the first pulse's jump.

The phone is Look4Sat on Bluetooth with the template `AZ$AZ EL$EL\r`. Where the antenna stands is the world's word.
"""

from __future__ import annotations

import random
import time
from collections.abc import Callable

import pytest

from firmware_sim.world_file import WorldState
from tests.machines.shack import Shack, Terminal, fly

NEAR_DEG = 1.5
"""Half a degree of a pulse's step, twice, and the jitter."""
Place = tuple[float, float]
UNSTOPPED_DEG = 40.0
"""What a servo turns at 60°/s until the bytes of a stop are obeyed on a busy machine."""


def phone(terminal: Terminal, azimuth_deg: float, elevation_deg: float) -> None:
    r"""One order as Look4Sat writes it: two decimals at most, no padding, `\r` because the template ends with it."""
    terminal.send(f"AZ{round(azimuth_deg, 2)} EL{round(elevation_deg, 2)}\r")


def moving(machine: Shack, since: tuple[float, float]) -> None:
    machine.until(
        lambda world: max(abs(at - was) for at, was in zip(world.shafts_deg, since, strict=True)) > 1.0,
        "the antenna moves",
    )


def turned(chance: random.Random) -> tuple[float, float]:
    """A place from which the first pulse, at 90°, makes both servos jump a good way."""
    return chance.choice([chance.uniform(0, 40), chance.uniform(140, 180)]), chance.uniform(0, 180)


def test_a_day(shack: Callable[..., Shack], chance: random.Random) -> None:
    machine = shack("servos")
    place = turned(chance)
    machine.turned_by_hand(*place)
    machine.start()
    terminal = Terminal(machine.ptys[0])
    assert machine.stands() == pytest.approx(place), "no motion before an order"

    # The first pulse makes the servos jump: a stop during the jump stops them.
    phone(terminal, 114.8, 9.05)
    moving(machine, place)
    at = machine.world().shafts_deg
    terminal.send("SA SE\r")
    stood = machine.stands()
    assert stood == pytest.approx(at, abs=UNSTOPPED_DEG)
    until_s = machine.world().at_s + 2.5
    machine.until(lambda world: world.at_s > until_s, "time for a whole jump")
    assert machine.world().antenna_deg == pytest.approx(stood, abs=0.1), "the stop held"

    # The same order again, read back; then one that needs the other half of the sky.
    phone(terminal, 114.8, 9.05)
    machine.arrives(114.8, 9.05, NEAR_DEG)
    terminal.send("AZ EL\r")
    azimuth, elevation = terminal.answer().strip().removeprefix("AZ").split(" EL")
    assert float(azimuth) == pytest.approx(114.8, abs=NEAR_DEG)
    assert float(elevation) == pytest.approx(9.05, abs=NEAR_DEG)
    azimuth_deg, elevation_deg = chance.uniform(190, 350), chance.uniform(5, 60)
    phone(terminal, azimuth_deg, elevation_deg)
    machine.arrives(azimuth_deg - 180, 180 - elevation_deg, NEAR_DEG)

    the_phones_evening(machine, terminal, chance)
    terminal.close()
    assert machine.faults() == []
    no_swing(machine, chance)
    a_power_cut(machine, chance)


def the_phones_evening(machine: Shack, terminal: Terminal, chance: random.Random) -> None:
    # Half of a damaged pair moves nothing.
    stood = machine.stands()
    terminal.send("AZ20.0 EL4x.5\rxxAZ20.0 EL\r")
    until_s = machine.world().at_s + 1.0
    machine.until(lambda world: world.at_s > until_s, "a second passes")
    assert machine.world().antenna_deg == pytest.approx(stood, abs=1.0)

    # A pass, in the builder's own words too; then the park position.
    first = chance.uniform(20, 120)
    points = [(first + 3 * step, 20.0 + 2 * step) for step in range(8)]
    fly(lambda az, el: phone(terminal, az, el), points, every_s=0.5)
    machine.arrives(*points[-1], NEAR_DEG)
    terminal.send("sat ISS EL39.0 17 AZ123.5 ok\n")
    machine.arrives(123.5, 39.0, NEAR_DEG)
    terminal.send("PARK\r")
    machine.arrives(90, 90, NEAR_DEG)
    assert machine.world().lcd[0].startswith(("SAT", "AZ", "EL")), machine.world().lcd


def no_swing(machine: Shack, chance: random.Random) -> None:
    """The program is killed, at rest or in mid-move, or ends properly; the board may lose its supply too. The first
    order then leads from where the servos stand to its place, and nowhere else."""
    for ends in ("killed", "killed in mid-move", "power cut", "stopped"):
        here = machine.world().shafts_deg
        terminal = Terminal(machine.ptys[0])
        there = chance.uniform(5, 175), chance.uniform(5, 80)
        phone(terminal, *there)
        if ends == "killed in mid-move":
            moving(machine, here)
        else:
            machine.arrives(*there, NEAR_DEG)
            time.sleep(2.5)  # the angle at rest is kept within two looks of a second
        terminal.close()
        if ends == "stopped":
            machine.stop()
        else:
            machine.cut()
        if ends == "power cut":
            machine.power_cut()
        machine.start()
        stood = machine.stands()
        terminal = Terminal(machine.ptys[0])
        aims = chance.uniform(5, 175), chance.uniform(5, 80)
        phone(terminal, *aims)
        way: list[tuple[float, float]] = []

        def there_now(world: WorldState, way: list[tuple[float, float]] = way, aims: Place = aims) -> bool:
            way.append(world.shafts_deg)
            return world.shafts_deg == pytest.approx(aims, abs=NEAR_DEG)

        machine.until(there_now, f"the first order is obeyed after the end: {ends}")
        for axis, (begun, goal) in enumerate(zip(stood, aims, strict=True)):
            angles = [shafts[axis] for shafts in way]
            assert min(begun, goal) - 2 * NEAR_DEG <= min(angles), (ends, angles)
            assert max(angles) <= max(begun, goal) + 2 * NEAR_DEG, (ends, angles)
        terminal.close()


def a_power_cut(machine: Shack, chance: random.Random) -> None:
    """In mid-move; wind turns the limp servos; SIGTERM during the first jump after the next start."""
    terminal = Terminal(machine.ptys[0])
    stood = machine.world().shafts_deg
    phone(terminal, 10.0, 20.0)
    moving(machine, stood)
    terminal.close()
    machine.cut()
    machine.power_cut()
    place = turned(chance)
    machine.turned_by_hand(*place)
    machine.start()
    assert machine.stands() == pytest.approx(place)
    terminal = Terminal(machine.ptys[0])
    phone(terminal, 60.0, 30.0)
    moving(machine, place)
    at = machine.world().shafts_deg
    machine.stop()
    assert machine.world().rests_deg == pytest.approx(at, abs=UNSTOPPED_DEG)
    assert machine.faults() == []
    terminal.close()
