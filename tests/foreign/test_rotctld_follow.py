"""The antenna follows Hamlib's own rotctld: another program commands that one, the box asks it where it points.

As a station with a dummy rotctld is set up: tracking program → rotctld → this box.
"""

from __future__ import annotations

import subprocess
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

import pytest

from tests.boxes import free_port

if TYPE_CHECKING:
    from tests.foreign.conftest import RunningBox

Start = Callable[..., "RunningBox"]
Rotctl = Callable[..., str]
PATIENCE_S = 60.0
TOLERANCE_DEG = 4.5


@pytest.fixture
def rotctl(need_program: Callable[[str, str], str]) -> Rotctl:
    program = need_program("rotctl", "libhamlib-utils")

    def run(port: int, *words: str) -> str:
        asked = [program, "-m", "2", "-r", f"127.0.0.1:{port}", *words]
        return subprocess.run(asked, capture_output=True, text=True, timeout=30, check=True).stdout

    return run


@contextmanager
def genuine(program: str, port: int, rotctl: Rotctl) -> Iterator[None]:
    server = subprocess.Popen(
        [program, "-m", "1", "-T", "127.0.0.1", "-t", str(port)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    )
    try:
        until(lambda: answers(rotctl, port), f"nobody listens on {port}")
        yield
    finally:
        server.kill()
        server.wait()


def answers(rotctl: Rotctl, port: int) -> bool:
    try:
        return bool(rotctl(port, "p"))
    except subprocess.CalledProcessError:
        return False


def until(true: Callable[[], bool], otherwise: str) -> None:
    give_up_s = time.monotonic() + PATIENCE_S
    while not true():
        assert time.monotonic() < give_up_s, otherwise
        time.sleep(0.1)


def points_at(rotctl: Rotctl, port: int, azimuth_deg: float, elevation_deg: float) -> bool:
    there = map(float, rotctl(port, "p").split())
    return all(abs(at - to) <= TOLERANCE_DEG for at, to in zip(there, (azimuth_deg, elevation_deg), strict=True))


def test_the_antenna_goes_where_the_dummy_is_sent(
    start_box: Start, rotctl: Rotctl, need_program: Callable[[str, str], str]
) -> None:
    program, source = need_program("rotctld", "libhamlib-utils"), free_port()
    box = start_box(links=f'[[link]]\nprotocol = "rotctld-follow"\nconnect = "127.0.0.1:{source}"\npoll_s = 0.05\n')
    with genuine(program, source, rotctl):
        # The dummy stands at 0/0 and nobody has commanded it: the antenna stays where it was sent.
        rotctl(box.rotctld_port, "P", "90", "45")
        until(lambda: points_at(rotctl, box.rotctld_port, 90, 45), "it does not obey its own link")
        rotctl(source, "P", "30", "20")
        until(lambda: points_at(rotctl, box.rotctld_port, 30, 20), "it does not follow")
        rotctl(source, "P", "60", "10")
        until(lambda: points_at(rotctl, box.rotctld_port, 60, 10), "it follows once and no more")
    # Gone, back again at 0/0, and commanded anew.
    with genuine(program, source, rotctl):
        assert points_at(rotctl, box.rotctld_port, 60, 10)
        until(lambda: moved_after(rotctl, source, box.rotctld_port), "it does not follow the one that came back")
    assert box.stop() == 0


def moved_after(rotctl: Rotctl, source: int, port: int) -> bool:
    """Sent to and fro until the box has connected again and sees it."""
    rotctl(source, "P", "20", "30")
    if points_at(rotctl, port, 20, 30):
        return True
    rotctl(source, "P", "21", "30")
    return False
