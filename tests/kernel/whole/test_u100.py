"""Two U-100 on real GPIO edges: relays that the kernel's lines close, contacts that the kernel debounces and stamps.

One mast for the whole file; the tests are the steps of one day, each after a start of the box.
"""

from __future__ import annotations

import signal
from collections.abc import Iterator
from pathlib import Path

import pytest

from rotator.cli.box import RunningBox
from tests.kernel.bench.waiting import until
from tests.kernel.whole.site import Nursery, Site

MOVE_S = 90.0
CONTACTS = (17, 27)
START_DEG = (23.7, 11.3)
PULSES = """
[pulses]
debounce_s = 0.04
pull = false
[pulses.azimuth]
contact = 17
[pulses.elevation]
contact = 27
"""
"""The plant moves a contact every 20 ms: a bounce then lasts as long, and the debounce is longer. The kernel's
simulated chip takes a program's pull-up for the level of the line: each start of the box would open the contacts."""
BOX = """
[rotor]
type = "relay-pulse"
hardware = "pi"
[azimuth]
min_deg = 0
max_deg = 360
direction_checked = true
[elevation]
min_deg = 0
max_deg = 180
direction_checked = true
[relays]
master = 16
heartbeat = 26
one_at_a_time = true
[lcd]
kind = "pcf8574"
bus = {bus}
[state]
path = "{state}"
[[link]]
protocol = "gs232b"
tcp = "127.0.0.1:{port}"
"""
ROTOR = '[rotor]\ntype = "relay-pulse"\n[azimuth]\nmax_deg = 360\n[relays]\nmaster = 16\n[lcd]\nkind = "pcf8574"\n'


@pytest.fixture(scope="module")
def site(nursery: Nursery, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Site]:
    folder = tmp_path_factory.mktemp("u100")
    with Site(nursery, folder, box=BOX + PULSES, rotor=ROTOR + PULSES, contacts=CONTACTS, start_deg=START_DEG) as made:
        made.start()
        yield made


def homed(site: Site) -> None:
    """A person's word for each axis, and the world's word that it is at its stop."""
    with RunningBox(site.config) as console:
        for axis in ("azimuth", "elevation"):
            console.order(f"home {axis}")
            until(
                lambda axis=axis: not console.status()[axis]["missing"],  # type: ignore[misc]  # mypy sees no type for a default
                f"{axis} homed; the box said:\n{site.log.read_text()}",
                MOVE_S,
            )
            at_deg = site.world.shafts()[("azimuth", "elevation").index(axis)]
            assert at_deg == pytest.approx(0.0, abs=0.01)


def comes_to(site: Site, azimuth_deg: float, elevation_deg: float) -> None:
    site.order(f"W{azimuth_deg:03.0f} {elevation_deg:03.0f}")

    def there() -> bool:
        azimuth, elevation = site.world.antenna()
        return abs(azimuth - azimuth_deg) < 5 and abs(elevation - elevation_deg) < 5 and not site.on()

    until(there, f"the antenna at {azimuth_deg:g} and {elevation_deg:g}; {site.log.read_text()}", MOVE_S)


def counts(folder: Path) -> str:
    path = folder / "counts.json"
    return path.read_text() if path.exists() else ""


def test_never_homed_it_obeys_no_program(site: Site) -> None:
    site.order("W040 030")
    assert site.world.shafts() == START_DEG


def test_homed_it_counts_the_kernels_edges(site: Site) -> None:
    homed(site)
    comes_to(site, 40, 20)
    comes_to(site, 25, 28)
    assert "FAULT" not in site.log.read_text()


def test_the_power_goes_in_mid_move_and_it_knows_that_it_is_lost(site: Site) -> None:
    site.order("W060 020")
    until(site.on, "a relay on")
    site.kill()
    until(lambda: not site.on(), "every relay off: the sentinel opens them")
    site.start()
    stood = site.world.shafts()
    site.order("W010 010")
    assert site.world.shafts() == pytest.approx(stood, abs=1.0)
    homed(site)
    comes_to(site, 30, 15)


def test_the_power_goes_at_rest_and_nothing_is_lost(site: Site) -> None:
    until(lambda: "moving" not in counts(site.folder), "both angles in the file", MOVE_S)
    site.kill()
    site.start()
    comes_to(site, 15, 25)


def test_it_ends_with_its_counts_written(site: Site) -> None:
    until(lambda: site.world.drives() == (0, 0) and "moving" not in counts(site.folder), "a rest", MOVE_S)
    site.signal(signal.SIGTERM)
    site.dead()
    assert not site.on()
    assert "Traceback" not in site.log.read_text()
    assert counts(site.folder).count('"known"') == 2
