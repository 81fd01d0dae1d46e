"""`python -m tests.kernel.stage [pytest arguments]`: the tests that need a real kernel, in one boot of Debian's own.

Knows the steps and their order. What is built is kept, once a machine and version: the second run only boots.
"""

from __future__ import annotations

import os
import platform
import sys
import time
from pathlib import Path

from tests.kept import keep, kept
from tests.kernel.stage.boot import NO_VERDICT, boot
from tests.kernel.stage.build import build, fetch, recipe
from tests.kernel.stage.debian import StageError, current, missing_tools

PROJECT = Path(__file__).resolve().parents[3]
SELECTION = ("tests/kernel", "tests/contract")
PATIENCE_S = 3600.0
"""Far longer than it takes, for a machine that is busy with other things."""
STUCK_S = 180
"""A test that takes so long says where it stands."""
TOOLS = {
    "qemu-system-x86_64": "qemu-system-x86",
    "busybox": "busybox-static",
    "cpio": "cpio",
    "modprobe": "kmod",
    "xz": "xz-utils",
    "gcc-12": "gcc-12",
    "make": "make",
    "ip": "iproute2",
    "apt-get": "apt",
}
"""What each program is packed in, on Debian."""


def main(arguments: list[str]) -> int:
    try:
        check_machine()
        return run(arguments)
    except StageError as fault:
        print(f"test-kernel: {fault}", file=sys.stderr)
        return 1


def check_machine() -> None:
    if platform.machine() != "x86_64":
        raise StageError(f"the kernel it boots is for x86-64, this machine is {platform.machine()}")
    if packages := missing_tools(TOOLS):
        raise StageError(
            f"programs are missing: sudo apt install {' '.join(packages)}   (SKIP_KERNEL=1 leaves this stage out)"
        )


def run(arguments: list[str]) -> int:
    took_s: dict[str, float] = {}
    started_s = time.monotonic()
    packages = current()

    def make(half: Path) -> None:
        scratch = half.with_name("scratch")
        fetch(packages, scratch)
        took_s["download"] = time.monotonic() - started_s
        build(packages, scratch, half)
        took_s["build"] = time.monotonic() - started_s - took_s["download"]

    kernel = keep(kept("kernel") / f"{packages.version}-{recipe()}", make)
    # Hypothesis alone takes eight seconds to load on this machine.
    quick = ["-p", "no:cacheprovider", "-p", "no:hypothesispytest"]
    pytest = [
        sys.executable,
        "-m",
        "pytest",
        *quick,
        "-o",
        f"faulthandler_timeout={STUCK_S}",
        *(arguments or SELECTION),
    ]
    settings = {
        "GS232_KERNEL": packages.release,
        "HOME": "/root",
        "TMPDIR": "/run/tmp",
        "PATH": f"{Path(sys.executable).parent}:/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin",
        "PYTHONDONTWRITEBYTECODE": "1",
        "LC_ALL": "C.UTF-8",
        "TERM": "dumb",
    } | ({"CI": os.environ["CI"]} if "CI" in os.environ else {})
    outcome = boot(kernel, pytest, PROJECT, settings, PATIENCE_S)
    took_s |= {"boot": outcome.boot_s, "tests": outcome.command_s, "all": time.monotonic() - started_s}
    if outcome.status == NO_VERDICT:
        raise StageError(f"the kernel ended without a verdict, or took longer than {PATIENCE_S:.0f} s")
    steps = ", ".join(f"{name} {seconds:.1f} s" for name, seconds in took_s.items())
    print(f"test-kernel: Debian {packages.version} ({packages.release}): {steps}")
    return outcome.status


if __name__ == "__main__":
    if os.environ.get("SKIP_KERNEL") == "1":
        print("test-kernel: SKIPPED, because SKIP_KERNEL=1")
        sys.exit(0)
    sys.exit(main(sys.argv[1:]))
