"""A TV rotator with a compass on its mast, in real time: it learns the iron beside it, as a person has it done; then a
GS-232's bytes, a stop, a power cut in mid-move, a start elsewhere. It knows its angle at once, without its stop.
"""

from __future__ import annotations

import json
import random
import subprocess
import sys
from collections.abc import Callable

from tests.machines.shack import Shack, Terminal

NEAR_DEG = 6.0
"""The tolerance, and two of the compass's own noise."""
DECLINATION_DEG = 4.0
IRON = ("--fault", "azimuth-iron-near@0")
"""More than the field of the earth."""
FAST = {"speed_dps": 18.0}
KEYS = {
    "azimuth": FAST | {"min_deg": 5, "max_deg": 355, "sensor": {"kind": "qmc5883l", "forward": "-y", "up": "-z"}},
    "mount": {"north": "magnetic", "declination_deg": DECLINATION_DEG},
    "sim": {"azimuth": FAST},
}


def learns_its_iron(machine: Shack) -> None:
    machine.turned_by_hand(5.0, 0.0)
    command = [sys.executable, "-m", "rotator", "calibrate", "--config", str(machine.config_path), *IRON, "compass"]
    said = subprocess.run(
        command, input="R\n" * 10 + "\ny\n", capture_output=True, text=True, timeout=180, check=False
    ).stdout
    assert "Iron adds" in said, said
    assert "radius_ut = [" in machine.config_path.read_text(encoding="utf-8"), said


def test_a_day(shack: Callable[..., Shack], chance: random.Random) -> None:
    machine = shack("tv-rotator", KEYS)
    learns_its_iron(machine)
    place = chance.uniform(10, 350), 0.0
    machine.turned_by_hand(*place)
    machine.start(*IRON)
    assert machine.stands() == place, "no motion before an order"
    told = json.loads(machine.rotator("where", "--json"))["azimuth"]
    assert told["angle_source"] == "measured"
    assert told["missing"] == []
    assert abs(told["angle_deg"] - DECLINATION_DEG - place[0]) < 5.0

    # There and back over the whole range, and a stop on the way.
    pc = Terminal(machine.ptys[0])
    for azimuth_deg in (chance.randrange(15, 60), chance.randrange(300, 350)):
        pc.send(f"M{azimuth_deg:03.0f}\r")
        machine.arrives(azimuth_deg - DECLINATION_DEG, 0.0, NEAR_DEG)
    pc.send("M120\r")
    machine.until(lambda world: world.drives[0] == -1, "the antenna starts")
    pc.send("S\r")
    machine.stands()

    # Power cut in mid-move; a person turns the antenna; the box starts again, moves nothing, and knows where it is.
    pc.send("M020\r")
    machine.until(lambda world: world.drives[0] == -1, "the antenna starts")
    pc.close()
    machine.cut()
    machine.power_cut()
    place = chance.uniform(10, 350), 0.0
    machine.turned_by_hand(*place)
    machine.start(*IRON)
    assert machine.stands() == place, "no motion before an order"
    far_deg = (place[0] + 180.0) % 360.0 * 0.9 + 15.0
    Terminal(machine.ptys[0]).send(f"M{far_deg:03.0f}\r")
    machine.arrives(far_deg - DECLINATION_DEG, 0.0, NEAR_DEG)
    machine.stop()
    assert machine.faults() == []
