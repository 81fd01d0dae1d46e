"""However the program dies, its relays open within a second, and what it saved is whole.

On a kernel that leaves outputs driven when their owner dies, as a Raspberry Pi's does. Each way of dying is tried while
azimuth turns; the time counts on the kernel's own clock, from the blow to the last relay line off.
"""

from __future__ import annotations

import json
import os
import signal
import subprocess
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from rotator.store.state import FORM
from rotator.store.whole import write_whole
from tests.kernel.bench.gpio import persisting
from tests.kernel.bench.waiting import until
from tests.kernel.whole.site import CW, LIMIT_S, MASTER, Nursery, Site, lives

Measure = Callable[[str, float], None]


@pytest.fixture
def site(nursery: Nursery, tmp_path: Path) -> Iterator[Site]:
    with Site(nursery, tmp_path) as made:
        yield made


def turning(site: Site) -> None:
    site.order("W400 020")
    until(lambda: CW in site.on(), "azimuth turning clockwise")


def test_killed(site: Site, measure: Measure) -> None:
    site.start()
    turning(site)
    blow_s = time.monotonic()
    site.signal(signal.SIGKILL)
    took_s = site.off_since_s() - blow_s
    measure("the program is killed (SIGKILL)", took_s)
    assert took_s < LIMIT_S
    assert not site.chip.level(MASTER)


def test_killed_with_its_sentinel_where_the_kernel_is_strict(site: Site, measure: Measure) -> None:
    # dtparam=strict_gpiod. Without it only the unit's ExecStopPost is left: see test_service.
    site.start()
    turning(site)
    with persisting(False):
        blow_s = time.monotonic()
        for process in (site.sentinel, site.pid):
            os.kill(process, signal.SIGKILL)
        until(lambda: not site.on(), "every relay off")
        took_s = time.monotonic() - blow_s
    measure("the program and its sentinel are killed: `strict_gpiod`", took_s)
    assert took_s < LIMIT_S


def test_stopped_for_ten_seconds(site: Site, measure: Measure) -> None:
    site.start()
    turning(site)
    blow_s = time.monotonic()
    site.signal(signal.SIGSTOP)
    took_s = site.off_since_s() - blow_s
    measure("the program stands still (SIGSTOP)", took_s)
    assert took_s < LIMIT_S
    # What stood still is ended, so that it cannot wake up ten seconds later and go on where it was.
    until(lambda: not site.alive(), "the end of the program that stood still")


def test_stopped_at_rest_it_may_go_on(site: Site) -> None:
    site.start()
    site.signal(signal.SIGSTOP)
    site.signal(signal.SIGCONT)
    assert site.ask("C2").startswith("AZ=")


def test_an_exception_in_the_control_thread(site: Site, measure: Measure) -> None:
    site.start("tests.kernel.whole.buggy")
    turning(site)
    blow_s = time.monotonic()
    (site.folder / "bug").touch()
    took_s = site.off_since_s() - blow_s
    measure("an exception in the control thread", took_s)
    assert took_s < LIMIT_S
    site.dead()
    assert site.said("a bug that nobody has found yet")


def test_the_bus_hangs_in_mid_transfer(site: Site, measure: Measure) -> None:
    site.start()
    turning(site)
    blow_s = time.monotonic()
    site.world.inject("bus-hung")
    took_s = site.off_since_s() - blow_s
    measure("the I2C bus hangs in mid-transfer", took_s)
    assert took_s < LIMIT_S
    assert site.alive()
    site.world.clear("bus-hung")


def test_the_adapter_of_the_bus_is_gone(site: Site, measure: Measure) -> None:
    site.start()
    turning(site)
    blow_s = time.monotonic()
    site.adapter.unplug()
    took_s = site.off_since_s() - blow_s
    measure("the I2C adapter is gone", took_s)
    assert took_s < LIMIT_S


def test_memory_runs_out(site: Site, measure: Measure) -> None:
    site.start()
    turning(site)
    cgroups = Path("/sys/fs/cgroup")
    (cgroups / "cgroup.subtree_control").write_text("+memory")
    group = cgroups / "box"
    group.mkdir()
    for process in (site.sentinel, site.pid):
        (group / "cgroup.procs").write_text(str(process))
    blow_s = time.monotonic()
    (group / "memory.max").write_text("100K")
    took_s = site.off_since_s() - blow_s
    measure("memory runs out", took_s)
    assert took_s < LIMIT_S
    until(lambda: not site.alive() and not lives(site.sentinel), "the end of both")
    until(lambda: not (group / "cgroup.procs").read_text(), "an empty group")
    group.rmdir()


def test_the_sentinel_is_killed(site: Site, measure: Measure) -> None:
    site.start()
    turning(site)
    blow_s = time.monotonic()
    os.kill(site.sentinel, signal.SIGKILL)
    took_s = site.off_since_s() - blow_s
    measure("the sentinel is killed: the program ends", took_s)
    assert took_s < LIMIT_S
    site.dead()
    assert site.said("the sentinel")


# --- what the program survives


def test_the_disk_is_full(site: Site) -> None:
    disk = site.folder / "disk"
    disk.mkdir()
    subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64k", "small", disk], check=True)
    try:
        site.state = disk / "state.json"
        saved = json.dumps({"format": FORM.today})
        site.state.write_text(saved)
        subprocess.run(["dd", "if=/dev/zero", f"of={disk / 'filler'}"], check=False, capture_output=True)
        site.write_config()
        site.start()
        site.order("W124 020")
        until(site.on, "azimuth turning")
        until(lambda: not site.on(), "the end of the move")
        assert abs(site.world.antenna()[0] - 124) < 4
        with pytest.raises(OSError, match="No space left"):
            write_whole(site.state, saved * 2)
        site.signal(signal.SIGTERM)
        site.dead()
        assert not site.on()
        assert site.state.read_text() == saved
    finally:
        site.kill()
        subprocess.run(["umount", disk], check=True)


def test_the_clock_is_set_back_an_hour(site: Site) -> None:
    site.start()
    site.order("W112 020")
    until(lambda: CW in site.on(), "azimuth turning clockwise")
    now_s = time.clock_gettime(time.CLOCK_REALTIME)
    time.clock_settime(time.CLOCK_REALTIME, now_s - 3600)
    try:
        until(lambda: not site.on(), "the end of the move")
        assert abs(site.world.antenna()[0] - 112) < 4
        assert site.ask("C2").startswith("AZ=11")
    finally:
        time.clock_settime(time.CLOCK_REALTIME, time.clock_gettime(time.CLOCK_REALTIME) + 3600)
