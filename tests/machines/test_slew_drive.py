"""A slew drive in real time: told where it points, a pass by `rotctld`'s bytes, stops, ends of every sort.

The motors turn at three times their speed, so that a day is short. Where the antenna stands is the world's word.
"""

from __future__ import annotations

import json
import random
import socket
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.machines.shack import LOOK_S, Shack, Terminal, fly

SPEED_DPS = 9.0
NEAR_DEG = 0.15
"""Two counts of 0.05°, and half the play of the gear."""
FAST = {"speed_dps": SPEED_DPS}
KEYS = {
    "azimuth": FAST,
    "elevation": FAST,
    "bridge": {"azimuth": {"accel_dps2": 9.0}, "elevation": {"accel_dps2": 9.0}},
    "sim": {"azimuth": FAST, "elevation": FAST},
}
SWITCH_DEG, INDEX_DEG = -1.0, -1.5
HOMES = KEYS | {
    "bridge": {
        "azimuth": {"accel_dps2": 9.0, "home": "switch", "home_deg": SWITCH_DEG, "home_dps": 3.0},
        "elevation": {"accel_dps2": 9.0, "home": "index", "index": 6, "home_deg": INDEX_DEG, "home_dps": 3.0},
    },
    "limits": {"azimuth_low": 17},
}
Place = tuple[float, float]


def somewhere(chance: random.Random) -> Place:
    return round(chance.uniform(5, 355), 2), round(chance.uniform(3, 87), 2)


class Rotctl:
    """What a program sends to the box's `rotctld`, and what comes back."""

    def __init__(self, port: int) -> None:
        self._socket = socket.create_connection(("127.0.0.1", port), timeout=10.0)

    def ask(self, words: str, lines: int = 1) -> list[str]:
        self._socket.sendall(f"{words}\n".encode())
        answer = b""
        while answer.count(b"\n") < lines:
            answer += self._socket.recv(100)
        return answer.decode().split()

    def point(self, place: Place) -> None:
        assert self.ask(f"P {place[0]:.2f} {place[1]:.2f}") == ["RPRT", "0"]

    def close(self) -> None:
        self._socket.close()


def told(machine: Shack) -> None:
    """A person reads the azimuth at a landmark and the elevation off a spirit level."""
    for axis, angle_deg in zip(("azimuth", "elevation"), machine.stands(), strict=True):
        machine.rotator("confirm", axis, f"{angle_deg:.2f}")


def standing(machine: Shack) -> list[str]:
    """What the file of the counts says of each axis."""
    axes = json.loads(Path(machine.folder, "counts.json").read_text())["axes"]
    return [axes.get(axis, {}).get("standing", "never") for axis in ("azimuth", "elevation")]


def until_kept(machine: Shack) -> None:
    give_up_s = time.monotonic() + 20.0
    while standing(machine) != ["known", "known"]:
        assert time.monotonic() < give_up_s, machine.log()
        time.sleep(LOOK_S)


def begun(machine: Shack, *words: str) -> subprocess.Popen[bytes]:
    """A `rotator` command that is still under way."""
    command = [sys.executable, "-m", "rotator", words[0], "--config", str(machine.config_path), *words[1:]]
    return subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def moving(machine: Shack, since: Place) -> None:
    machine.until(
        lambda world: max(abs(at - was) for at, was in zip(world.shafts_deg, since, strict=True)) > 2.0, "it moves"
    )


def test_a_day(shack: Callable[..., Shack], chance: random.Random) -> None:
    machine = shack("slew-drive", KEYS)
    place = somewhere(chance)
    machine.turned_by_hand(*place)
    machine.start()
    program = Rotctl(machine.ports["rotctld"])
    # Nobody has said where it points: an order is refused, and nothing moves; a press does.
    assert program.ask("P 120 30") != ["RPRT", "0"]
    assert machine.stands() == pytest.approx(place)
    machine.rotator("jog", "up" if place[1] < 45 else "down", "0.5")
    assert abs(machine.stands()[1] - place[1]) > 0.5
    told(machine)

    there = somewhere(chance)
    program.point(there)
    machine.arrives(*there, NEAR_DEG)
    at_deg = [float(number) for number in program.ask("p", 2)]
    assert at_deg == pytest.approx(there, abs=NEAR_DEG)
    a_pass(machine, program, chance)
    a_stop(machine, program, chance)
    program.close()
    assert machine.faults() == []
    every_end(machine, chance)


def a_pass(machine: Shack, program: Rotctl, chance: random.Random) -> None:
    """Ten points, a second apart, at up to 2°/s; it stands on the last."""
    (azimuth_deg, elevation_deg), rate_dps = (chance.uniform(30, 300), chance.uniform(10, 50)), chance.uniform(0.5, 2.0)
    points = [(azimuth_deg + rate_dps * second, elevation_deg + rate_dps * second) for second in range(10)]
    program.point(points[0])
    machine.arrives(*points[0], NEAR_DEG)
    fly(lambda az, el: program.point((az, el)), points, every_s=1.0)
    machine.arrives(*points[-1], NEAR_DEG)


def a_stop(machine: Shack, program: Rotctl, chance: random.Random) -> None:
    """S stops both axes on the way; the serial port's S too."""
    terminal = Terminal(machine.ptys[0])
    for stop in (lambda: program.ask("S"), lambda: terminal.send("S\r")):
        since = machine.world().shafts_deg
        program.point((355.0 if since[0] < 180 else 5.0, chance.uniform(5, 85)))
        moving(machine, since)
        stop()
        from_deg = machine.world().shafts_deg
        stood = machine.stands()
        for was, now in zip(from_deg, stood, strict=True):
            assert abs(now - was) < 0.5 * SPEED_DPS + 4.0  # on the way down from 9°/s, and a busy machine
    terminal.close()


def every_end(machine: Shack, chance: random.Random) -> None:
    """Killed while it stands, or ended in mid-move: it knows where it is. Killed in mid-move it asks, and says so."""
    for ends in ("killed at rest", "stopped in mid-move", "killed in mid-move"):
        program = Rotctl(machine.ports["rotctld"])
        since = machine.stands()
        there = somewhere(chance)
        program.point((355.0 if since[0] < 180 else 5.0, there[1]) if "mid-move" in ends else there)
        if "mid-move" in ends:
            moving(machine, since)
        else:
            machine.arrives(*there, NEAR_DEG)
            until_kept(machine)
        program.close()
        if ends.startswith("stopped"):
            machine.stop()
            assert standing(machine) == ["known", "known"], ends
        else:
            machine.cut()
        stood = machine.world().rests_deg
        machine.start()
        assert machine.stands() == pytest.approx(stood, abs=0.01), "no motion before an order"
        program = Rotctl(machine.ports["rotctld"])
        there = somewhere(chance)
        if ends == "killed in mid-move":
            assert program.ask(f"P {there[0]} {there[1]}") != ["RPRT", "0"], "it does not know where it is"
            told(machine)
        program.point(there)
        machine.arrives(*there, NEAR_DEG)
        program.close()
        assert machine.faults() == [], ends
    machine.stop()


def homed(machine: Shack) -> None:
    """A person homes both axes and watches: each stands where the world says, at its end."""
    for number, (axis, end_deg) in enumerate((("azimuth", SWITCH_DEG), ("elevation", INDEX_DEG))):
        machine.rotator("home", axis, "--yes")
        at_deg = machine.stands()[number]
        assert end_deg - 1.5 < at_deg <= end_deg, machine.log()
        where = json.loads(machine.rotator("where", "--json"))[axis]
        assert where["homeable"]
        assert where["angle_deg"] == pytest.approx(at_deg, abs=NEAR_DEG)


def test_what_a_power_cut_has_lost_is_found_again_at_a_switch_and_an_index(
    shack: Callable[..., Shack], chance: random.Random
) -> None:
    machine = shack("slew-drive", HOMES)
    machine.turned_by_hand(chance.uniform(-1.6, 9.0), chance.uniform(-1.8, 9.0))
    machine.start()
    homed(machine)
    cuts = ["in mid-move", "in mid-homing", "in mid-homing of the other"]
    for cut in chance.sample(cuts, 2):
        program = Rotctl(machine.ports["rotctld"])
        there = chance.uniform(5.0, 12.0), chance.uniform(5.0, 12.0)
        since = machine.world().shafts_deg
        program.point(there)
        if cut == "in mid-move":
            moving(machine, since)
        else:
            machine.arrives(*there, NEAR_DEG)
            axis, number = ("azimuth", 0) if cut == "in mid-homing" else ("elevation", 1)
            homing = begun(machine, "home", axis, "--yes")
            machine.until(lambda world: world.shafts_deg[number] < there[number] - 2.0, "it homes")  # noqa: B023 - at once
            homing.kill()
            homing.wait()
        program.close()
        machine.cut()
        machine.start()
        program = Rotctl(machine.ports["rotctld"])
        assert program.ask("P 12 12") != ["RPRT", "0"], "it does not know where it is"
        program.close()
        homed(machine)
    program = Rotctl(machine.ports["rotctld"])
    program.point((12.0, 12.0))
    machine.arrives(12.0, 12.0, NEAR_DEG)
    program.close()
    assert machine.faults() == []
    machine.stop()


CHIP = {"counter": "ls7366r", "counts_per_deg": 1000.0, "accel_dps2": 9.0}
CHIPS = KEYS | {"bridge": {"azimuth": CHIP, "elevation": CHIP}}
"""9000 counts a second at 9° a second: more than the box reads from the kernel."""


def test_a_counter_chip_knows_after_a_kill_what_a_power_cut_loses(
    shack: Callable[..., Shack], chance: random.Random
) -> None:
    machine = shack("slew-drive", CHIPS)
    machine.turned_by_hand(*somewhere(chance))
    machine.start()
    told(machine)
    for ends in ("killed in mid-move", "power cut at rest", "power cut in mid-move"):
        program = Rotctl(machine.ports["rotctld"])
        there = somewhere(chance)
        since = machine.stands()
        program.point((355.0 if since[0] < 180 else 5.0, there[1]) if "mid-move" in ends else there)
        if "mid-move" in ends:
            moving(machine, since)
        else:
            machine.arrives(*there, NEAR_DEG)
            until_kept(machine)
        program.close()
        machine.cut()
        if "power" in ends:
            machine.power_cut()
        machine.start()
        program = Rotctl(machine.ports["rotctld"])
        if ends == "power cut in mid-move":
            assert program.ask("P 120 30") != ["RPRT", "0"], "it does not know where it is"
            told(machine)
        there = somewhere(chance)
        program.point(there)
        machine.arrives(*there, NEAR_DEG)
        program.close()
        assert machine.faults() == [], ends
    machine.stop()
