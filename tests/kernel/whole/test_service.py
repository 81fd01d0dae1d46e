"""systemd itself around the box, with the unit that the installer puts there: relays off whatever was killed, and the
box started again.

systemd runs as process 1 of a container inside this kernel. Only what is not here is set aside by a drop-in: the user
of an installed system, its paths (this project may stand in /tmp or at home), and the services of a whole Debian.
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from tests.kernel.bench.waiting import until
from tests.kernel.whole.site import CW, LIMIT_S, Nursery, Site, lives

UNIT = Path(__file__).parents[3] / "install" / "rotator.service"
UNITS = Path("/run/systemd/system")
SYSTEMD = "/lib/systemd/systemd"
START_S = 120.0
BIN = Path(sys.executable).parent
SAFETY = UNIT.parents[1] / "hw" / "safety"
DROP_IN = """
[Unit]
DefaultDependencies=no
After=
[Service]
User=root
Group=root
SupplementaryGroups=
ProtectHome=no
PrivateTmp=no
ExecStart=
ExecStart={bin}/rotator run --plain --config {site.config}
ExecStopPost=
{stop_posts}
WorkingDirectory=/
ReadWritePaths={site.folder}
StandardOutput=append:{site.log}
StandardError=append:{site.log}
"""
INSTALLED = "/opt/rotator/current"
TARGET = "[Unit]\nDefaultDependencies=no\nRequires=rotator.service\n"


def stop_posts(unit: str, config: Path) -> str:
    """What the unit does after the program's end, with the paths of this project."""
    lines = "\n".join(line for line in unit.splitlines() if line.startswith("ExecStopPost="))
    here = {
        f"{INSTALLED}/lib/python3*/site-packages/hw/safety": SAFETY,
        f"{INSTALLED}/bin": BIN,
        "/etc/rotator/rotator.toml": config,
    }
    for there, place in here.items():
        assert there in lines
        lines = lines.replace(there, str(place))
    assert INSTALLED not in lines
    return lines


class Service:
    """The box under systemd, at `site`."""

    def __init__(self, site: Site) -> None:
        self.site = site
        (UNITS / "rotator.service.d").mkdir(parents=True)
        unit = UNIT.read_text()
        (UNITS / "rotator.service").write_text(unit)
        drop_in = DROP_IN.format(bin=BIN, site=site, stop_posts=stop_posts(unit, site.config))
        (UNITS / "rotator.service.d/here.conf").write_text(drop_in)
        (UNITS / "here.target").write_text(TARGET)
        container = ["unshare", "--fork", "--pid", "--mount", "--mount-proc", "--cgroup", "--kill-child"]
        systemd = [SYSTEMD, "--system", "--unit=here.target", "--log-target=null", "--show-status=no"]
        self._process = subprocess.Popen([*container, "env", "container=lxc", *systemd], stdin=subprocess.DEVNULL)
        site.await_start(self.pid_of_program, START_S)

    def close(self) -> None:
        self._process.kill()
        self._process.wait()

    def pid_of_program(self) -> int:
        """As the whole machine counts; 0 while there is none."""
        for group in Path("/sys/fs/cgroup").glob("**/rotator.service/cgroup.procs"):
            processes = group.read_text().split()
            if processes:
                return int(processes[0])
        return 0


@pytest.fixture(scope="module")
def service(nursery: Nursery, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Service]:
    if not Path(SYSTEMD).exists():
        pytest.fail(f"{SYSTEMD} is missing: sudo apt install systemd")
    with Site(nursery, tmp_path_factory.mktemp("service")) as site:
        made = Service(site)
        yield made
        made.close()


@pytest.fixture
def site(service: Service) -> Site:
    return service.site


def test_killed_with_its_sentinel(service: Service, site: Site, measure: Callable[[str, float], None]) -> None:
    # What `systemctl kill -s KILL rotator` does; left is the unit's ExecStopPost.
    site.order("W400 020")
    until(lambda: CW in site.on(), "azimuth turning clockwise")
    blow_s = time.monotonic()
    for process in (site.sentinel, site.pid):
        os.kill(process, signal.SIGKILL)
    took_s = site.off_since_s() - blow_s
    measure("the program and its sentinel are killed: systemd's `ExecStopPost`", took_s)
    assert took_s < LIMIT_S


def test_it_is_started_again_and_watched(service: Service, site: Site) -> None:
    before = site.pid
    site.await_start(service.pid_of_program, START_S)
    assert site.pid != before
    # At rest, so the sentinel has no reason to act.
    site.signal(signal.SIGSTOP)
    until(lambda: not lives(site.pid), "the end of the program that stood still", START_S)
