"""A fifth of a core for one process, as a Pi Zero 2 W has against a PC: by the kernel's own quota of CPU time.

Knows control groups, version 2 and version 1. The periods are short, so that the process is slow rather than frozen for
a tenth of a second at a time. What else runs on the machine takes nothing from the fifth. Knows nothing of the box.
"""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

SHARE = 0.2
PERIOD_US = 5000
CGROUPS = Path("/sys/fs/cgroup")


class NoQuotaError(Exception):
    """The kernel, or the lack of rights, does not allow a quota here."""


@contextmanager
def fifth_of_a_core(pid: int) -> Iterator[Path]:
    """The process, with all its threads, in a group with that quota. Raises NoQuotaError.

    At the end it is back among the others.
    """
    second = (CGROUPS / "cgroup.controllers").exists()
    parent = CGROUPS if second else CGROUPS / "cpu"
    quota_us = round(SHARE * PERIOD_US)
    limits = (
        {"cpu.max": f"{quota_us} {PERIOD_US}", "cpu.weight": "10000"}
        if second
        else {"cpu.cfs_period_us": str(PERIOD_US), "cpu.cfs_quota_us": str(quota_us), "cpu.shares": "262144"}
    )
    try:
        if second:
            (parent / "cgroup.subtree_control").write_text("+cpu")
        group = Path(tempfile.mkdtemp(prefix="rotator-", dir=parent))
    except OSError as fault:
        raise NoQuotaError(f"no quota of CPU time: {fault}; it needs root and control groups") from fault
    try:
        try:
            for name, value in limits.items():
                (group / name).write_text(value)
            # Some kernels give real-time threads a budget of their own in each group: the same fifth.
            for name, time_us in (("cpu.rt_period_us", PERIOD_US), ("cpu.rt_runtime_us", quota_us)):
                if (group / name).exists():
                    (group / name).write_text(str(time_us))
            (group / "cgroup.procs").write_text(str(pid))
        except OSError as fault:
            raise NoQuotaError(f"no quota of CPU time: {fault}") from fault
        yield group
    finally:
        with suppress(OSError):  # it has ended
            (parent / "cgroup.procs").write_text(str(pid))
        with suppress(OSError):
            os.rmdir(group)
