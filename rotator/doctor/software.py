"""The checks of Python, its packages and the kernel.

Knows the versions that the program needs. Does not know the configuration.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from importlib.metadata import distributions

from hw.ports import HardwareError
from rotator.doctor.finding import Finding, fine, wrong
from rotator.doctor.machine import Machine

OLDEST_PYTHON, TOO_NEW_PYTHON = (3, 11), (3, 14)
OLDEST_KERNEL = (5, 10)
"""The kernel's second GPIO interface, which gpiod 2 needs, came with Linux 5.10."""
PACKAGES = {"gpiod": (2, 1), "smbus2": (0, 4, 2), "pyserial": (3, 5)}
"""The packages for hardware, with the oldest version that works."""


def python(machine: Machine) -> Iterator[Finding]:
    found = f"Python {_dotted(machine.python)}, {machine.pointer_bits}-bit"
    if OLDEST_PYTHON <= machine.python < TOO_NEW_PYTHON:
        yield fine(found)
    else:
        yield wrong(found, "Python 3.11, 3.12 or 3.13 is needed: create the venv again with one of them.")


def packages(machine: Machine) -> Iterator[Finding]:
    folders = list(machine.packages)
    good = []
    for name, oldest in PACKAGES.items():
        version = next((found.version for found in distributions(name=name, path=folders)), None)
        wanted = f"pip install '{name}>={_dotted(oldest)}' in the program's venv."
        if version is None:
            yield wrong(f"{name} is not installed", wanted)
        elif _numbers(version) < oldest:
            yield wrong(f"{name} {version} is older than {_dotted(oldest)}", wanted)
        else:
            good.append(f"{name} {version}")
    try:
        # On 32-bit ARM pip takes an unrelated package of the same name, and Debian 12 ships the interface before this.
        machine.chips.gpio()
    except HardwareError as fault:
        yield wrong(str(fault), "pip install 'gpiod>=2.1' in the program's venv, made without --system-site-packages.")
    if good:
        yield fine(", ".join(good))


def kernel(machine: Machine) -> Iterator[Finding]:
    release, architecture = machine.kernel
    bits = "64-bit" if "64" in architecture or architecture.startswith("armv8") else "32-bit"
    found = f"Linux {release} ({architecture}, {bits}), {machine.model or 'not a Raspberry Pi'}"
    if _numbers(release) < OLDEST_KERNEL:
        yield wrong(found, "The kernel is older than 5.10: sudo apt full-upgrade, or put a newer system on the card.")
    else:
        yield fine(found)


def _numbers(version: str) -> tuple[int, ...]:
    leading = re.match(r"\d+(?:\.\d+)*", version)
    return tuple(int(part) for part in leading[0].split(".")) if leading else ()


def _dotted(version: tuple[int, ...]) -> str:
    return ".".join(str(part) for part in version)
