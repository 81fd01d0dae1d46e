"""A box in front of a controller, in real time: two boxes in a chain, by each protocol; and one on the simulated rotor.

The far box is the controller: a simulated G-5500 on relays. What is true is its world's word. The near box is at a real
TCP port, as with a controller on the network, and hears a tracking program on a serial port.
"""

from __future__ import annotations

import random
import signal
import time
from collections.abc import Callable
from typing import Any

import pytest
import tomlkit

from rotator.config.kinds.controller import LANGUAGES
from tests.boxes import free_port
from tests.machines.shack import PATIENCE_S, Shack, Terminal, fly

NEAR_DEG = 3.5
"""The far box's tolerance, whole degrees twice, backlash, and the noise of the pot."""
RUNS_ON_DEG = 20.0
"""What it turns at 6°/s until the bytes of a stop are obeyed on a busy machine."""
TIGHT = {"tolerance_deg": 1}
NewShack = Callable[..., Shack]


def page() -> dict[str, Any]:
    return {"page": {"listen": f"127.0.0.1:{free_port()}"}, "lcd": {"kind": "none"}}


def chain(shack: NewShack, protocol: str) -> tuple[Shack, Shack]:
    """The near box, and the far one."""
    link = {"protocol": protocol, "tcp": "127.0.0.1:4533"}
    far = shack("g5500", {**page(), "azimuth": TIGHT, "elevation": TIGHT, "link": [link]})
    checked: dict[str, Any] = {"direction_checked": True}
    axes = {"azimuth": checked, "elevation": checked | {"fitted": not LANGUAGES[protocol].azimuth_only}}  # type: ignore[index]
    near = shack("controller", {**page(), **axes, "rotor": {"hardware": "pi"}})
    near.greeting = b"the rotor on this Pi"
    document = tomlkit.parse(near.config_path.read_text(encoding="utf-8"))
    document["controller"] = {"protocol": protocol, "tcp": f"127.0.0.1:{far.ports[protocol]}"}
    near.config_path.write_text(tomlkit.dumps(document), encoding="utf-8")
    return near, far


def until_logged(machine: Shack, words: str, *, times: int = 1) -> None:
    give_up_s = time.monotonic() + PATIENCE_S
    while machine.log().count(words) < times:
        assert time.monotonic() < give_up_s, f"not said: {words}\n{machine.log()}"
        time.sleep(0.05)


def asked(terminal: Terminal) -> float:
    terminal.send("C2\r")
    return float(terminal.answer().strip()[3:6])


@pytest.mark.parametrize("protocol", LANGUAGES)
def test_a_day_of_two_boxes_in_a_chain(protocol: str, shack: NewShack, chance: random.Random) -> None:
    near, far = chain(shack, protocol)
    place = chance.uniform(60, 300), chance.uniform(5, 60)
    far.turned_by_hand(*place)
    far.start()
    near.start()
    terminal = Terminal(near.ptys[0])
    assert far.stands() == place, "no motion before an order"

    # An order, and a stop in mid-move.
    to_deg = place[0] + chance.choice([-50, 50])
    terminal.send(f"M{to_deg:03.0f}\r")
    far.until(lambda world: world.drives[0] != 0, "the antenna starts")
    far.until(lambda world: abs(world.antenna_deg[0] - place[0]) > 10, "it is under way")
    at_deg = far.world().antenna_deg[0]
    terminal.send("S\r")
    assert far.stands()[0] == pytest.approx(at_deg, abs=RUNS_ON_DEG)
    until_s = far.world().at_s + 2.0
    stood = far.world().antenna_deg
    far.until(lambda world: world.at_s > until_s, "two seconds pass")
    assert far.world().antenna_deg == pytest.approx(stood, abs=0.1), "the stop held"

    # A pass, read back.
    first = round(stood[0])
    way = 1 if first < 200 else -1
    points = [(float(first + 2 * way * step), 20.0) for step in range(8)]
    fly(lambda az, _el: terminal.send(f"M{az:03.0f}\r"), points, every_s=1.0)
    far.until(lambda world: abs(world.antenna_deg[0] - points[-1][0]) < NEAR_DEG, "it follows")
    far.stands()
    give_up_s = time.monotonic() + PATIENCE_S
    while abs(asked(terminal) - points[-1][0]) > NEAR_DEG:
        assert time.monotonic() < give_up_s, near.log()

    terminal.close()
    the_near_box_dies(near, far, points[-1][0], way)
    the_far_box_dies(near, far, place[0])
    assert near.process is not None
    near.process.send_signal(signal.SIGTERM)
    assert near.process.wait(PATIENCE_S) == 0, near.log()
    near.process = None
    assert "Traceback" not in near.log(), near.log()
    far.stop()
    assert far.faults() == []


def the_near_box_dies(near: Shack, far: Shack, from_deg: float, way: int) -> None:
    """In mid-move: its controller goes on to the last target, and stands there."""
    terminal = Terminal(near.ptys[0])
    target_deg = from_deg + 40 * way
    terminal.send(f"M{target_deg:03.0f}\r")
    far.until(lambda world: abs(world.antenna_deg[0] - from_deg) > 8, "it is under way")
    terminal.close()
    near.cut()
    far.until(lambda world: abs(world.antenna_deg[0] - target_deg) < NEAR_DEG, "it goes on")
    stood = far.stands()
    near.start()
    assert far.stands() == pytest.approx(stood, abs=0.1), "no motion before an order"


def the_far_box_dies(near: Shack, far: Shack, to_deg: float) -> None:
    far.cut()
    until_logged(near, "controller silent")
    far.start()
    until_logged(near, "no fault any more")
    terminal = Terminal(near.ptys[0])
    terminal.send(f"M{to_deg:03.0f}\r")
    far.until(lambda world: abs(world.antenna_deg[0] - to_deg) < NEAR_DEG, "orders count again")
    terminal.close()


@pytest.mark.parametrize("protocol", ["gs232b", "rot2prog"])
def test_a_day_on_the_simulated_rotor(protocol: str, shack: NewShack, chance: random.Random) -> None:
    machine = shack("controller", {**page(), "controller": {"protocol": protocol}})
    place = chance.uniform(40, 320), chance.uniform(10, 70)
    machine.turned_by_hand(*place)
    machine.start()
    terminal = Terminal(machine.ptys[0])
    assert machine.stands() == place, "no motion before an order"
    to = place[0] + chance.choice([-30, 30]), place[1] + chance.choice([-8, 8])
    terminal.send(f"W{to[0]:03.0f} {to[1]:03.0f}\r")
    machine.arrives(*to, 1.7)
    terminal.send(f"W{place[0]:03.0f} {place[1]:03.0f}\r")
    machine.until(lambda world: abs(world.antenna_deg[0] - to[0]) > 5, "it is under way")
    terminal.close()
    machine.cut()
    machine.start()
    terminal = Terminal(machine.ptys[0])
    machine.stands()
    assert abs(asked(terminal) - machine.world().antenna_deg[0]) < 1.7
    terminal.close()
    machine.stop()
    assert machine.faults() == []
