"""The newest Hamlib there is: every model of it that speaks a protocol of the box sets, reads and stops the antenna.

That is the `rotctl` that ROTATOR_TEST_ROTCTL names, else one of version 5 or later on PATH, else that of Debian's
testing release. Where the antenna goes is read from the simulated world.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import pytest

from tests.foreign.clients.unpacked import NotHereError, unpacked
from tests.machines.shack import Shack

NEAR_DEG = 4.6
"""The box's tolerance, and whole degrees."""
FIRST_DEG = {"azimuth": (75, 0), "elevation": (0, 25), "both": (75, 25)}


@dataclass(frozen=True, slots=True)
class Model:
    protocol: str
    axes: str = "both"
    """Which of them it turns. A model of one axis sends the other to zero."""
    reads: bool = True
    stops: bool = True
    far_deg: tuple[int, int] = (440, 25)
    """A direction far away that this model itself lets through."""
    may_crash: bool = False
    """Its own thread sometimes ends rotctl with a segmentation fault, after the order (4.7.2)."""


EASYCOMM: dict[str, Any] = {"far_deg": (350, 25)}
AZIMUTH: dict[str, Any] = {"axes": "azimuth", "far_deg": (350, 0)}
ELEVATION: dict[str, Any] = {"axes": "elevation", "far_deg": (0, 170)}
MODELS = {
    2: Model("rotctld"),
    3: Model("pstrotator", reads=False, stops=False, may_crash=True),
    4: Model("rotctld", stops=False),
    201: Model("easycomm1", reads=False, **EASYCOMM),
    202: Model("easycomm2", **EASYCOMM),
    204: Model("easycomm3", **EASYCOMM),
    **dict.fromkeys((401, 402, 404, 405, 406), Model("dcu1", **AZIMUTH)),
    403: Model("dcu1", reads=False, **AZIMUTH),
    **dict.fromkeys((601, 602, 605, 606, 607, 608), Model("gs232a")),
    603: Model("gs232b"),
    604: Model("gs232b", reads=False, stops=False),
    609: Model("gs232a", **AZIMUTH),
    610: Model("gs232a", **ELEVATION),
    611: Model("gs232b", **AZIMUTH),
    612: Model("gs232b", **ELEVATION),
    901: Model("rot2prog"),
    902: Model("rot1prog", **AZIMUTH),
    903: Model("md01"),
}
OURS = re.compile(r"easycomm|rotctl|pstrotator|gs-?23|rotor-ez|dcu|rt-21|rot[12]prog", re.IGNORECASE)
"""In a model's name: it speaks a protocol of this box."""


@pytest.fixture(scope="session")
def rotctl() -> list[str]:
    """The words that run it."""
    named = os.environ.get("ROTATOR_TEST_ROTCTL")
    if named:
        return [named]
    installed = shutil.which("rotctl")
    if installed and version([installed]) >= 5:
        return [installed]
    try:
        return unpacked("libhamlib-utils", "testing").command("usr/bin/rotctl")
    except NotHereError as reason:
        if os.environ.get("CI") == "true":
            raise
        pytest.skip(f"no Hamlib newer than the installed one: {reason}")


def version(command: list[str]) -> int:
    said = subprocess.run([*command, "--version"], capture_output=True, text=True, timeout=30, check=True).stdout
    found = re.search(r"Hamlib (\d+)\.", said)
    assert found, said
    return int(found[1])


def run(*command: str, may_crash: bool = False) -> str:
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == 0 or (may_crash and done.returncode < 0), f"{command[1:]}: {done.stdout}{done.stderr}"
    return done.stdout


def place(box: Shack, protocol: str) -> str:
    """What rotctl takes after -r."""
    return f"127.0.0.1:{box.ports[protocol]}" if protocol in box.ports else str(box.ptys[0])


@pytest.mark.parametrize("number", MODELS)
def test_it_points_reads_and_stops(box_with: Callable[..., Shack], rotctl: list[str], number: int) -> None:
    model = MODELS[number]
    wire = {"rotctld": {"tcp": ""}, "pstrotator": {"udp": "127.0.0.1:12000"}}.get(model.protocol, {"serial": ""})
    box = box_with({"protocol": model.protocol, **wire})
    where = "127.0.0.1:12000" if model.protocol == "pstrotator" else place(box, model.protocol)
    words = [*rotctl, "-m", str(number), "-r", where]

    first = FIRST_DEG[model.axes]
    run(*words, "P", *map(str, first), may_crash=model.may_crash)
    stood = box.arrives(*first, within_deg=NEAR_DEG)
    if model.reads:
        said = [float(angle) for angle in run(*words, "p").split()]
        for axis in range(2):
            if model.axes in ("both", ("azimuth", "elevation")[axis]):
                assert said[axis] == pytest.approx(stood[axis], abs=1.5)
    if model.stops:
        run(*words, "P", *map(str, model.far_deg))
        box.until(lambda world: world.drives != (0, 0), "it starts again")
        run(*words, "S")
        stood = box.stands()
        assert any(abs(at - to) > 10 for at, to in zip(stood, model.far_deg, strict=True)), "it went on to the end"
    box.stop()
    assert box.faults() == []


def test_every_model_that_could_drive_the_box_is_tried(rotctl: list[str]) -> None:
    """One that a later Hamlib brings is found here first."""
    listed = [line.split(maxsplit=2) for line in run(*rotctl, "-l").splitlines()[1:]]
    numbers = {int(row[0]) for row in listed if OURS.search(" ".join(row[1:]))}
    assert numbers <= MODELS.keys()
