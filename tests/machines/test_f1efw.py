"""The F1EFW box in real time, beginning anywhere: Termite's bytes, the display, a pass, park, a power cut, SIGTERM.

The PC's link speaks as to the Arduino: `W` anywhere, no answer. The true angles come from the simulated world.
"""

from __future__ import annotations

import json
import math
import random
import re
from collections.abc import Callable

import pytest

from firmware_sim.world_file import WorldState
from tests.machines.shack import Shack, Terminal, fly

PARK = (180.0, 0.0)
SPELLINGS = (
    "W{az:03d} {el:03d}\r",
    "W{az:03d} {el:03d}\n",
    "W{az:03d} {el:03d}\r\n",
    "w{az:03d} {el:03d}\r",
    "W{az} {el}\r",
    "C2\rS\rhello W{az:03d} {el:03d}  over\r",
    "xxw{az:03d},{el:03d};",
    "W{az:03d} {el:03d}",  # no end at all: taken after a second of silence
)
"""An order as a program or a person in Termite sends it. The sketch finds the W anywhere."""


def near_deg(elevation_deg: float) -> float:
    """How far from an order's azimuth the antenna may rest: the tolerance on the sky, backlash, noise of the pot."""
    return 4 / max(0.1, math.cos(math.radians(elevation_deg))) + 0.7


def shown(machine: Shack, row: int) -> tuple[str, int, int]:
    """A row of the display: its name, azimuth and elevation."""
    text = machine.world().lcd[row]
    parts = re.fullmatch(r"(SAT|ANT|SIM) A:(\d{3}) E:(\d{3}|-\d{2}) *", text)
    assert parts, text
    return parts[1], int(parts[2]), int(parts[3])


def obeys(machine: Shack, terminal: Terminal, azimuth: int, elevation: int, chance: random.Random) -> None:
    """An order: the antenna goes there, both rows of the display and `rotator where` say so, and nothing answers."""
    terminal.send(chance.choice(SPELLINGS).format(az=azimuth, el=elevation))
    machine.until(lambda world: world.lcd[0].startswith(f"SAT A:{azimuth:03d} E:{elevation:03d}"), "the order is shown")
    stood = machine.arrives(azimuth, elevation, near_deg(elevation))
    machine.until(lambda _: all(abs(a - b) <= 1.6 for a, b in zip(shown(machine, 1)[1:], stood, strict=True)), "shown")
    assert shown(machine, 1)[0] == "SIM", "a simulated antenna is never mistaken for a real one"
    where = machine.rotator("where")
    assert f"wanted: {azimuth:.1f}° {elevation:.1f}°" in where
    assert "moved by: gs232-f1efw\n" in where
    assert terminal.answer(patience_s=0.2) == "", "the sketch never answers"


def comes_to_rest(machine: Shack, azimuth: int, elevation: int) -> None:
    """After a stream: the box follows for 3 s more, past the target too, and then rests within the tolerance."""
    since_s: float | None = None

    def rests(world: WorldState) -> bool:
        nonlocal since_s
        off_deg = abs(world.antenna_deg[0] - azimuth), abs(world.antenna_deg[1] - elevation)
        if world.drives != (0, 0) or off_deg[0] > near_deg(elevation) or off_deg[1] > near_deg(0):
            since_s = None
        elif since_s is None:
            since_s = world.at_s
        return since_s is not None and world.at_s - since_s > 4

    machine.until(rests, f"the antenna rests near {azimuth}/{elevation}")


def close_to(place: tuple[float, float], chance: random.Random) -> tuple[int, int]:
    """A direction some seconds of travel away, whole degrees, above the horizon."""
    azimuth = place[0] + chance.choice([-1, 1]) * chance.uniform(5, 45)
    elevation = place[1] + chance.choice([-1, 1]) * chance.uniform(0, 15)
    return round(min(max(azimuth, 0), 359)), round(min(max(elevation, 1), 70))


def begins_anywhere(machine: Shack, chance: random.Random) -> tuple[float, float]:
    """Start the box with the antenna anywhere in its range, or just beyond. Returns where it stands."""
    place = chance.uniform(-1, 361), chance.uniform(-1, 91)
    machine.turned_by_hand(*place)
    machine.start()
    assert machine.stands() == pytest.approx(place), "no motion before an order"
    assert machine.world().lcd[0].rstrip() == "SAT A:--- E:---"
    return place


def test_a_day(shack: Callable[..., Shack], chance: random.Random) -> None:
    machine = shack("f1efw")
    place = begins_anywhere(machine, chance)
    terminal = Terminal(machine.ptys[0])
    obeys(machine, terminal, *close_to(place, chance), chance)

    # A pass, one order a second.
    azimuth, elevation = (round(angle) for angle in machine.stands())
    azimuth = min(max(azimuth, 0), 339)
    points = [(azimuth + 2 * step, min(max(elevation, 1) + step, 89)) for step in range(8)]
    fly(lambda az, el: terminal.send(f"W{az:03.0f} {el:03.0f}\r"), points, every_s=1.0)
    last = points[-1]
    comes_to_rest(machine, *last)

    # At the horizon both motors stop at once, wherever they are.
    far = (last[0] + 180) % 360
    terminal.send(f"W{far:03d} 030\r")
    machine.until(lambda world: world.drives[0] != 0, "the antenna starts")
    terminal.send(f"W{far:03d} {chance.choice(['000', '-05', '0'])}\r")
    machine.until(lambda world: world.drives == (0, 0), "both motors stop at the horizon", patience_s=5)
    stopped = machine.stands()
    assert abs(stopped[0] - far) > 90, "it has not gone on to where the order was"
    assert shown(machine, 0)[1] == far, "the display shows the order all the same"

    # The power fails while the antenna turns. A person turns it while the box is off; it then moves nothing by itself.
    terminal.send(f"W{far:03d} 030\r")
    machine.until(lambda world: world.drives[0] != 0, "the antenna starts")
    assert machine.faults() == []
    terminal.close()
    machine.cut()
    machine.power_cut()
    place = begins_anywhere(machine, chance)
    terminal = Terminal(machine.ptys[0])
    obeys(machine, terminal, *close_to(place, chance), chance)
    assert machine.faults() == []
    machine.stop()


def test_parked_released_and_ended_in_mid_move(shack: Callable[..., Shack], chance: random.Random) -> None:
    machine = shack("f1efw")
    begins_anywhere(machine, chance)
    terminal = Terminal(machine.ptys[0])
    machine.rotator("tell", "park")
    parked = machine.arrives(*PARK, 4.7)
    terminal.send("W100 040\r")
    assert machine.stands() == pytest.approx(parked, abs=0.1), "the PC moves nothing until a person resumes"
    machine.rotator("resume")
    obeys(machine, terminal, *close_to(parked, chance), chance)

    # SIGTERM while it turns; the next run finds the antenna where it came to rest.
    terminal.send("W010 060\r")
    machine.until(lambda world: world.drives[0] != 0, "the antenna starts")
    assert machine.faults() == []
    terminal.close()
    machine.stop()
    rests = machine.world().rests_deg
    kept = json.loads((machine.folder / "state.json").read_text(encoding="utf-8"))
    assert "azimuth" in str(kept), "the learnt motors are kept"
    machine.start()
    assert machine.stands() == pytest.approx(rests, abs=0.6), "it stands where it came to rest"
    assert machine.faults() == []
    machine.stop()
