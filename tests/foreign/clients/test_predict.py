"""KD2BD's predict, in a terminal of its own, tracks a satellite over its antenna port, and the antenna is there.

It writes EasyComm and reads nothing. No package registry has it: build it from its source and put it on PATH.
"""

from __future__ import annotations

import shutil
from collections.abc import Callable
from datetime import UTC, datetime

import pytest

from tests.foreign.clients.passes import HOME, passing, stays_with
from tests.foreign.clients.terminal import terminal
from tests.machines.shack import Shack

WHOLE_DEG = 0.7
"""It sends whole degrees of both axes."""
LONGEST_PORT = 13
"""Characters of the port's name that it keeps."""


@pytest.mark.parametrize("protocol", ["easycomm1", "easycomm2"])
def test_it_tracks_a_pass(box_with: Callable[..., Shack], protocol: str) -> None:
    program = shutil.which("predict")
    if program is None:
        pytest.skip("predict is missing: no package has it")
    box = box_with({"protocol": protocol, "serial": ""})
    satellite = passing()
    elements = "\n".join(["PASS", *satellite.tle(datetime.now(UTC))])
    (box.folder / "sat.tle").write_text(elements + "\n", encoding="ascii")
    # West is positive for it.
    qth = f"HOME\n {HOME.latitude_deg}\n {-HOME.longitude_deg}\n 0\n"
    (box.folder / "home.qth").write_text(qth, encoding="ascii")
    port = box.ptys[0].name
    assert len(port) <= LONGEST_PORT

    command = [program, "-t", "sat.tle", "-q", "home.qth", "-a1", port]
    # A long name of the home folder overruns a buffer of its own.
    (box.folder / ".predict").mkdir()
    with terminal(command, box.folder, {"HOME": "."}) as screen:
        screen.shows("Main Menu")
        screen.press("t")
        screen.shows("Select a Satellite")
        screen.press("A")

        def alive() -> None:
            screen.look()
            assert screen.process.poll() is None, "predict has ended"

        stays_with(box, satellite, WHOLE_DEG, alive)
    # Nothing comes from it any more: a stream that ends leaves the antenna at rest.
    box.stands()
    box.stop()
    assert box.faults() == []
