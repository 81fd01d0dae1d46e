"""The stage itself: this is the kernel we think it is, and a machine that a test may lean on."""

from __future__ import annotations

import os
import platform
import subprocess
import time
from itertools import pairwise
from pathlib import Path

import pytest

CLOCK_STEP_S = 1e-3


def test_we_run_on_the_kernel_that_was_booted() -> None:
    assert platform.release() == os.environ["GS232_KERNEL"]


def test_the_clock_is_fine_enough_to_time_a_relay() -> None:
    moments = [time.monotonic() for _ in range(1000)]
    steps = [after - before for before, after in pairwise(moments) if after > before]
    assert min(steps) < CLOCK_STEP_S


def test_the_host_keeps_nothing_of_what_is_written_here(tmp_path: Path) -> None:
    mounts = Path("/proc/mounts").read_text()
    assert " / overlay rw," in mounts
    (tmp_path / "file").write_text("kept in memory")


def test_control_groups_are_at_hand() -> None:
    assert "memory" in Path("/sys/fs/cgroup/cgroup.controllers").read_text()


def test_a_file_system_of_its_own_can_be_mounted(tmp_path: Path) -> None:
    image, mount = tmp_path / "image", tmp_path / "mount"
    mount.mkdir()
    with image.open("wb") as disk:
        disk.truncate(16 << 20)
    if not Path("/sbin/mkfs.ext4").exists():
        pytest.skip("mkfs.ext4 is missing: sudo apt install e2fsprogs")
    subprocess.run(["/sbin/mkfs.ext4", "-q", str(image)], check=True)
    subprocess.run(["mount", "-o", "loop", str(image), str(mount)], check=True)
    (mount / "file").write_text("on ext4")
    subprocess.run(["umount", str(mount)], check=True)
