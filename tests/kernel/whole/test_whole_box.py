"""The whole box in a real kernel: Hamlib at the PC's end of a USB cable, relays, pots and display at the other.

One box for the whole file; the tests are the steps of one evening.
"""

from __future__ import annotations

import re
import signal
import subprocess
from collections.abc import Callable, Iterator
from itertools import pairwise

import pytest

from tests.kernel.bench.gpio import GpioChip
from tests.kernel.bench.usb_serial import UsbSerialCable
from tests.kernel.bench.waiting import until
from tests.kernel.whole.site import HEARTBEAT, USB_LINK, Nursery, Site, lives

MOVE_S = 60.0


@pytest.fixture(scope="module")
def cable() -> Iterator[UsbSerialCable]:
    with UsbSerialCable() as made:
        yield made


@pytest.fixture(scope="module")
def site(nursery: Nursery, cable: UsbSerialCable, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Site]:
    # The header is not the first chip of this machine: on a Pi 5 it was number 0, 4, and 11 within two years.
    with GpioChip("brcmvirt-gpio", lines=2), Site(nursery, tmp_path_factory.mktemp("site"), USB_LINK) as made:
        made.start()
        yield made


@pytest.fixture
def rotctl(need_program: Callable[[str, str], str], cable: UsbSerialCable) -> Callable[..., str]:
    path = need_program("rotctl", "libhamlib-utils")

    def run(*words: str) -> str:
        command = [path, "-m", "603", "-r", cable.pc, *words]
        return subprocess.run(command, check=True, capture_output=True, text=True, timeout=MOVE_S).stdout

    return run


def near(site: Site, azimuth_deg: float, elevation_deg: float) -> Callable[[], bool]:
    def there() -> bool:
        azimuth, elevation = site.world.antenna()
        return abs(azimuth - azimuth_deg) < 4 and abs(elevation - elevation_deg) < 4 and not site.on()

    return there


def test_the_chip_is_found_by_its_label_whatever_its_number(site: Site) -> None:
    assert site.chip.path != "/dev/gpiochip0"
    assert site.ask("C2").startswith("AZ=100")


def test_it_points_where_hamlib_says(site: Site, rotctl: Callable[..., str]) -> None:
    rotctl("P", "118", "27")
    until(near(site, 118, 27), "the antenna at 118 and 27 degrees", MOVE_S)
    azimuth, elevation = map(float, rotctl("p").split())
    assert abs(azimuth - 118) < 4
    assert abs(elevation - 27) < 4


def test_the_display_reads_right(site: Site) -> None:
    assert site.world.lcd is not None
    lcd = site.world.lcd

    def reads_right() -> bool:
        sat, ant = lcd.text()
        shown = re.fullmatch(r"ANT A:(\d{3}) E:(\d{3}) ", ant)
        azimuth, elevation = site.world.antenna()
        return (
            sat == "SAT A:118 E:027 "
            and shown is not None
            and abs(int(shown[1]) - azimuth) < 1.5
            and abs(int(shown[2]) - elevation) < 1.5
        )

    until(reads_right, f"the display; it reads {lcd.text()}")


def test_the_cable_is_pulled_and_put_back(site: Site, cable: UsbSerialCable, rotctl: Callable[..., str]) -> None:
    cable.pull()
    assert site.ask("C2").startswith("AZ=")
    cable.plug()

    def answers() -> bool:
        try:
            return bool(rotctl("p"))
        except subprocess.SubprocessError:
            return False

    until(answers, "an answer over the cable", MOVE_S)
    rotctl("P", "108", "20")
    until(near(site, 108, 20), "the antenna at 108 and 20 degrees", MOVE_S)


def test_the_converter_drops_off_the_bus_and_returns(site: Site) -> None:
    site.order("W200 020")
    until(site.on, "a relay on")
    site.world.inject("adc-gone")
    until(lambda: not site.on(), "every relay off")
    until(lambda: site.said("FAULT azimuth: sensor silent"), "the fault in the log")
    site.world.clear("adc-gone")
    for axis in ("azimuth", "elevation"):
        until(lambda: site.said(f"{axis}: answers again"), f"the return of {axis}'s readings in the log")  # noqa: B023
    site.order("S")
    site.order("W108 020")
    until(near(site, 108, 20), "the antenna at 108 and 20 degrees", MOVE_S)


def test_every_step_beats(site: Site) -> None:
    list(site.edges.edges())
    beats = [site.chip.level(HEARTBEAT)]

    def ten_more() -> bool:
        beats.extend(edge.level for edge in site.edges.edges() if edge.offset == HEARTBEAT)
        return len(beats) > 10

    until(ten_more, "ten beats")
    assert all(one != following for one, following in pairwise(beats[1:]))


def test_the_evening_ends_with_every_relay_off(site: Site) -> None:
    site.order("W200 020")
    until(site.on, "a relay on")
    site.signal(signal.SIGTERM)
    until(lambda: not site.alive(), "the end of the box")
    assert not site.on()
    until(lambda: not lives(site.sentinel), "the end of the sentinel")
    assert '"azimuth"' in site.state.read_text()
