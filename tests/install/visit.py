"""One visit to a bare root, by install.sh or by the Debian package: whether what came works there.

Knows what to ask of it. What else must hold, and holds on any architecture, the other tests ask on this machine's own.
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
    """`version`: what the program says of itself to the service's user. `compiled`: of its compiled packages."""

    version: Said
    compiled: Said


def visit(root: Root) -> Visit:
    root.run("/src/install.sh", "--yes").check()
    return _looked_at(root, IMPORTS)


def visit_deb(root: Root, package: str) -> Visit:
    root.run(*APT, "install", package).check()
    return _looked_at(root, DEB_IMPORTS)


def _looked_at(root: Root, imports: str) -> Visit:
    return Visit(root.run("runuser", "-u", "rotator", "--", "rotator", "--version"), root.shell(imports))


def exposure(root: Root) -> float:
    said = root.run("systemd-analyze", "security", "--offline=true", "--no-pager", "rotator.service").text
    found = re.search(r"Overall exposure level for rotator.service: ([\d.]+)", said)
    assert found, said
    return float(found[1])
