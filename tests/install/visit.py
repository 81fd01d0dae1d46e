"""One visit of install.sh to a bare root: in, a second run, out again, and what was seen on the way.

Knows what to look at. What it must look like, the tests say.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from tests.install.roots import Root, Said

WORST_EXPOSURE = 2.0
"""systemd's own measure: 0 is shut in completely, 10 is open."""
IMPORTS = "/opt/rotator/current/bin/python -c 'import gpiod, pydantic_core; gpiod.request_lines'"


@dataclass(frozen=True, slots=True)
class Visit:
    """What was seen between a bare root and a bare root."""

    verified: Said
    exposure: float
    version: Said
    compiled: Said
    second_run: Said
    changed_by_second_run: set[str]
    left: set[str]


def visit(root: Root) -> Visit:
    bare = root.inventory(times=False)
    root.run("/src/install.sh").check()
    installed = root.inventory(times=True)
    second_run = root.run("/src/install.sh")
    changed = installed.items() ^ root.inventory(times=True).items()
    verified = root.run("systemd-analyze", "verify", "rotator.service")
    exposed = exposure(root)
    version = root.run("runuser", "-u", "rotator", "--", "rotator", "--version")
    compiled = root.shell(IMPORTS)
    root.run("/src/install.sh", "--remove", "--yes").check()
    left = bare.items() ^ root.inventory(times=False).items()
    return Visit(
        verified, exposed, version, compiled, second_run, {path for path, _ in changed}, {path for path, _ in left}
    )


def exposure(root: Root) -> float:
    said = root.run("systemd-analyze", "security", "--offline=true", "--no-pager", "rotator.service").text
    found = re.search(r"Overall exposure level for rotator.service: ([\d.]+)", said)
    assert found, said
    return float(found[1])
