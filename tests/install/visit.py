"""One visit to a bare root, of install.sh and of the Debian package: in, out again, and what was seen on the way.

Knows what to look at. What it must look like, the tests say.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from tests.install.roots import Root, Said

WORST_EXPOSURE = 2.0
"""systemd's own measure: 0 is shut in completely, 10 is open."""
APT = (
    *("apt-get", "--yes", "--quiet=2", "--no-install-recommends", "--option", "DPkg::Use-Pty=false"),
    *("--option", "DPkg::Options::=--force-unsafe-io"),
)
"""These roots need not outlive a power cut: no file waits for the disk."""
APTS_OWN = ("/var/lib/apt/", "/var/lib/dpkg/")
THE_GROUPS = {"/etc/group", "/etc/gshadow"}
"""The groups gpio, i2c and spi stay: by then they may own what is not ours."""
DEB_IMPORTS = "/usr/lib/gs232-rotator/bin/python -c 'import gpiod, pydantic_core, wrapt, moteus; gpiod.request_lines'"
REFUSED_BY_THE_CARD = "mkdir -p /run/rotator && echo '{}' >/run/rotator/state.json"
"""What a box leaves in memory whose card is full."""
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
    root.run("/src/install.sh", "--yes").check()
    installed = root.inventory(times=True)
    second_run = root.run("/src/install.sh", "--yes")
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


@dataclass(frozen=True, slots=True)
class DebVisit:
    """What was seen of the Debian package between a bare root and a bare root."""

    verified: Said
    exposure: float
    version: Said
    compiled: Said
    left: set[str]


def visit_deb(root: Root, package: str) -> DebVisit:
    bare = root.inventory(times=False)
    root.run(*APT, "install", package).check()
    verified = root.run("systemd-analyze", "verify", "rotator.service")
    exposed = exposure(root)
    version = root.run("runuser", "-u", "rotator", "--", "rotator", "--version")
    compiled = root.shell(DEB_IMPORTS)
    root.run(*APT, "purge", "gs232-rotator").check()
    left = {path for path, _ in bare.items() ^ root.inventory(times=False).items()}
    return DebVisit(verified, exposed, version, compiled, {path for path in left if not path.startswith(APTS_OWN)})


def exposure(root: Root) -> float:
    said = root.run("systemd-analyze", "security", "--offline=true", "--no-pager", "rotator.service").text
    found = re.search(r"Overall exposure level for rotator.service: ([\d.]+)", said)
    assert found, said
    return float(found[1])
