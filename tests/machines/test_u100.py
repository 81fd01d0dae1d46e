"""KO6TH's two U-100 in real time: homing by a person's word, FODTrack's lines, a pass, the panel, power cuts, SIGTERM.

The motors turn at three times their speed, so that a day is short; the cams are as shipped, 5° and 1°.
"""

from __future__ import annotations

import json
import random
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from rotator.cli.box import RunningBox
from tests.machines.shack import Shack, Terminal, fly, standing, until_kept

SPEED_DPS = 18.0
NEAR_DEG = 6.0
"""The tolerance of 4° on the sky at an elevation of 40°, the play of the gear, and a cycle."""
FAST = {"speed_dps": SPEED_DPS}
KEYS = {
    "azimuth": FAST,
    "elevation": FAST,
    "sim": {"azimuth": FAST, "elevation": FAST},
    "link": [
        {"protocol": "gs232b", "serial": "/dev/ttyGS0", "report_moves": True},
        {"protocol": "rotctld", "tcp": "127.0.0.1:4533"},
    ],
}
Place = tuple[float, float]


def anywhere(chance: random.Random) -> Place:
    return chance.uniform(0.0, 360.0), chance.uniform(0.0, 180.0)


def somewhere(chance: random.Random) -> Place:
    """A target in whole degrees, away from the ends, where an azimuth means one place."""
    return float(chance.randrange(15, 345)), float(chance.randrange(5, 40))


def order(pc: Terminal, place: Place) -> None:
    """As FODTrack sends it."""
    pc.send(f"W{place[0]:03.0f} {place[1]:03.0f}\r")


def homed(machine: Shack) -> None:
    """A person homes both axes and watches. The world must agree that they are at their stops."""
    for number, axis in enumerate(("azimuth", "elevation")):
        machine.rotator("home", axis, "--yes")
        assert machine.world().shafts_deg[number] == pytest.approx(0.0, abs=0.01), machine.log()


def read_back(pc: Terminal) -> Place:
    """What C2 answers. Lines about moves that are over, and about orders that were refused, may come before it."""
    pc.send("C2\r")
    while not (line := pc.answer()).startswith("AZ="):
        assert line.startswith(("AZ = ", "?>")), line
    azimuth, elevation = line.replace("AZ=", "").split("EL=")
    return float(azimuth), float(elevation)


def hands(machine: Shack, words: str) -> None:
    """`rotator panel`, without starting Python once more for each."""
    with RunningBox(machine.config_path) as console:
        console.order(f"panel {words}")


def obeys(machine: Shack, pc: Terminal, place: Place) -> None:
    """Ordered there, the antenna comes there, and the box says where it is."""
    order(pc, place)
    stood = machine.arrives(*place, NEAR_DEG)
    assert read_back(pc) == pytest.approx(stood, abs=3.0)


def shows(machine: Shack, mode: str) -> None:
    """The display's last letter is that of the mode that the box believes."""
    machine.until(lambda world: world.lcd[1].endswith(mode[0].upper()), f"the display shows {mode}")


def ended_well(machine: Shack) -> None:
    machine.stop()
    assert machine.faults() == []


def with_motion(machine: Shack) -> None:
    machine.until(lambda world: world.drives != (0, 0), "the antenna starts")


def begin(machine: Shack) -> None:
    """Start, and wait until the box believes its mode switch, which takes a second: before that it obeys no program."""
    machine.start()
    shows(machine, "auto")


def new(shack: Callable[..., Shack], place: Place) -> tuple[Shack, Terminal]:
    machine = shack("u100", KEYS)
    machine.turned_by_hand(*place)
    begin(machine)
    return machine, Terminal(machine.ptys[0])


def parked(machine: Shack, pc: Terminal, chance: random.Random) -> None:
    """The park position, and SIGTERM in the move after it."""
    machine.rotator("tell", "park")
    machine.arrives(180.0, 0.0, NEAR_DEG)
    machine.rotator("resume")
    order(pc, (chance.choice([60.0, 300.0]), 30.0))
    with_motion(machine)
    time.sleep(chance.uniform(0.0, 1.0))
    pc.close()
    ended_well(machine)
    # The end waits for the coast, so the count is kept.
    axes = json.loads(Path(machine.folder, "counts.json").read_text())["axes"]
    kept = [axes[axis].get("angle_deg") for axis in ("azimuth", "elevation")]
    assert kept == pytest.approx(machine.world().shafts_deg, abs=SPEED_DPS * 0.5), machine.log()


def test_a_day_with_the_pc(shack: Callable[..., Shack], chance: random.Random) -> None:
    begun = anywhere(chance)
    machine, pc = new(shack, begun)

    # Never homed, it obeys no program.
    order(pc, somewhere(chance))
    assert machine.stands() == pytest.approx(begun, abs=0.1)
    homed(machine)

    # Orders, two seconds without one, a pass, and the line after a move.
    obeys(machine, pc, somewhere(chance))
    place = somewhere(chance)
    obeys(machine, pc, place)
    first = min(max(place[0], 20.0), 320.0)
    points = [(first + 2 * step, 10.0 + 2 * step) for step in range(8)]
    fly(lambda az, el: order(pc, (az, el)), points, every_s=0.5)
    machine.arrives(*points[-1], NEAR_DEG)
    line = pc.answer(patience_s=3.0)
    assert line.startswith("AZ = "), line

    # A proper stop keeps the counts and what the motors taught; the next run goes on from there.
    pc.close()
    ended_well(machine)
    assert standing(machine) == ["known", "known"]
    assert "azimuth" in json.loads(Path(machine.folder, "state.json").read_text())["learnt"]["axes"]
    begin(machine)
    pc = Terminal(machine.ptys[0])
    obeys(machine, pc, somewhere(chance))

    # The power goes while it moves: the box knows that it does not know, and a person homes it.
    order(pc, ((machine.world().antenna_deg[0] + 180.0) % 360.0, 20.0))
    with_motion(machine)
    time.sleep(chance.uniform(0.1, 2.0))
    pc.close()
    machine.cut()
    machine.power_cut()
    lost = [number for number, known in enumerate(standing(machine)) if known != "known"]
    assert lost, standing(machine)
    begin(machine)
    pc = Terminal(machine.ptys[0])
    stood = machine.stands()
    order(pc, somewhere(chance))
    now = machine.stands()
    assert [now[number] for number in lost] == pytest.approx([stood[number] for number in lost], abs=0.1)
    homed(machine)
    obeys(machine, pc, somewhere(chance))

    # The power goes long after a move: nothing is lost.
    until_kept(machine)
    pc.close()
    machine.cut()
    machine.power_cut()
    begin(machine)
    pc = Terminal(machine.ptys[0])
    obeys(machine, pc, somewhere(chance))

    parked(machine, pc, chance)


def test_a_day_at_the_panel(shack: Callable[..., Shack], chance: random.Random) -> None:
    machine, pc = new(shack, anywhere(chance))
    homed(machine)

    # MANUAL: the knobs, and no program.
    machine.rotator("panel", "mode", "manual")
    shows(machine, "manual")
    before = machine.stands()
    order(pc, somewhere(chance))
    assert machine.stands() == pytest.approx(before, abs=0.1)
    shares = chance.uniform(0.1, 0.9), chance.uniform(0.1, 0.9)
    for axis, share in zip(("azimuth", "elevation"), shares, strict=True):
        hands(machine, f"knob {axis} {share:.3f}")
    # The dial of a knob with its end resistors is a little wider than its scale.
    dialled = [360.0 * (share - 0.5) * 1.035 + 180.0 for share in shares]
    machine.arrives(dialled[0], dialled[1] / 2.0, NEAR_DEG + 2.0)

    # PARK: nothing.
    hands(machine, "mode park")
    shows(machine, "park")
    stood = machine.stands()
    order(pc, somewhere(chance))
    hands(machine, f"knob azimuth {1.0 - shares[0]:.3f}")
    hands(machine, "jog cw 1")
    assert machine.stands() == pytest.approx(stood, abs=0.1)

    # JOG: as long as the switch is held, and the coast.
    hands(machine, "mode jog")
    shows(machine, "jog")
    way, turn = (1, "cw") if stood[0] < 180.0 else (-1, "ccw")
    machine.rotator("panel", "jog", turn, "1.5")
    machine.until(lambda world: abs(world.shafts_deg[0] - stood[0]) > 1.0, "the azimuth turns")
    jogged = machine.stands()
    assert 5.0 < way * (jogged[0] - stood[0]) < 1.6 * SPEED_DPS + 5.0
    assert jogged[1] == pytest.approx(stood[1], abs=0.1)

    # AUTO: the PC again, a press adds an index of 5° to its order.
    hands(machine, "mode auto")
    shows(machine, "auto")
    place = somewhere(chance)
    obeys(machine, pc, place)
    for _ in range(2):
        hands(machine, "jog up 0.3")
        time.sleep(1.0)  # a press that a person sees: thrown, and back
    machine.arrives(place[0], place[1] + 10.0, NEAR_DEG)

    # The stop button latches; released, turning the mode switch lets it move again.
    order(pc, ((machine.world().antenna_deg[0] + 180.0) % 360.0, 20.0))
    with_motion(machine)
    machine.rotator("panel", "stop", "press")
    stood = machine.stands()
    order(pc, somewhere(chance))
    assert machine.stands() == pytest.approx(stood, abs=0.1)
    hands(machine, "stop release")
    order(pc, somewhere(chance))
    assert machine.stands() == pytest.approx(stood, abs=0.1)
    for mode in ("park", "auto"):
        hands(machine, f"mode {mode}")
        shows(machine, mode)
    obeys(machine, pc, somewhere(chance))
    pc.close()
    ended_well(machine)
