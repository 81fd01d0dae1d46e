"""The checks of the computer: Python and its packages, kernel, supply, temperature, clock, watchdog, and the service.

Knows the versions that the program needs, and where a Raspberry Pi and systemd report the rest. Does not know the
configuration.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from importlib.metadata import distributions

from hw.ports import HardwareError
from rotator.doctor.finding import Finding, fine, skipped, warn, wrong
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


# The bits of `vcgencmd get_throttled` (Raspberry Pi documentation) for now; 16 bits higher: since the start.
THROTTLED = {0: "under-voltage", 1: "clock capped", 2: "throttled", 3: "too hot"}
UNDER_VOLTAGE = 1 << 0
SINCE_START = 16
HOT_C = 80.0
"""At this temperature a Pi begins to slow down."""
POLICY_AT = 41 - 3
"""Of the scheduling policy in /proc/PID/task/TID/stat: field 41 (proc_pid_stat(5)), and the third follows the name."""

SUPPLY = "Use the Pi's own power supply and a short, thick cable, and feed relays and display from another one."


def power(machine: Machine) -> Iterator[Finding]:
    bits = _throttled(machine)
    if bits is None:
        alarms = [
            machine.text(path)
            for path in machine.glob("/sys/class/hwmon/*/in0_lcrit_alarm")
            if machine.text(path.with_name("name")) == "rpi_volt"
        ]
        if not alarms:
            yield skipped("this computer does not report its supply")
        elif "1" in alarms:
            yield wrong("under-voltage now", SUPPLY)
        else:
            yield fine("no under-voltage now")
        return
    now = [word for bit, word in THROTTLED.items() if bits >> bit & 1]
    before = [word for bit, word in THROTTLED.items() if bits >> SINCE_START + bit & 1 and word not in now]
    report = [f"{word} now" for word in now] + [f"{word} since the start" for word in before]
    found = f"{', '.join(report) or 'no sag since the start'} (0x{bits:x})"
    sagged = (bits | bits >> SINCE_START) & UNDER_VOLTAGE
    if bits & UNDER_VOLTAGE:
        yield wrong(found, SUPPLY)
    elif report:
        yield warn(found, SUPPLY if sagged else "The Pi is or was too hot: give it air or a heat sink.")
    else:
        yield fine(found)


def _throttled(machine: Machine) -> int | None:
    report = machine.says("vcgencmd", "get_throttled")
    if report is None:
        files = machine.glob("/sys/devices/platform/soc*/*firmware/get_throttled")
        report = machine.text(files[0]) if files else None
    try:
        return None if report is None else int(report.removeprefix("throttled="), 16)
    except ValueError:
        return None


def temperature(machine: Machine) -> Iterator[Finding]:
    report = machine.text("/sys/class/thermal/thermal_zone0/temp")
    if report is None or not report.lstrip("-").isdigit():
        yield skipped("this computer does not report it")
        return
    celsius = int(report) / 1000
    if celsius >= HOT_C:
        yield warn(f"{celsius:.0f} °C", "The Pi slows down from 80 °C on: give it air, shade or a heat sink.")
    else:
        yield fine(f"{celsius:.0f} °C")


def clock(machine: Machine) -> Iterator[Finding]:
    report = machine.says("timedatectl", "show", "--property=NTPSynchronized", "--value")
    if report == "yes" or machine.at("/run/systemd/timesync/synchronized").exists():
        yield fine("set by the network")
    elif (tracking := machine.says("chronyc", "-n", "tracking")) and "Not synchronised" not in tracking:
        yield fine("set by chrony")
    elif report is None and tracking is None:
        yield skipped("this computer does not report what sets it")
    else:
        yield warn(
            "not set by the network",
            "Orders from a PC do not need it, the times in the log do: timedatectl set-ntp true, and a network.",
        )


def watchdog(machine: Machine) -> Iterator[Finding]:
    if not machine.at("/dev/watchdog").exists():
        if machine.is_pi:
            yield warn("there is no /dev/watchdog", "Remove dtparam=watchdog=off from config.txt, and reboot.")
        else:
            yield skipped("there is no /dev/watchdog")
        return
    state, timeout_s = (machine.text(f"/sys/class/watchdog/watchdog0/{name}") for name in ("state", "timeout"))
    asked_for = machine.says("systemctl", "show", "--property=RuntimeWatchdogUSec", "--value")
    if state == "active" or (state is None and asked_for not in (None, "0", "infinity")):
        yield fine(f"restarts a frozen computer after {timeout_s} s" if timeout_s else "restarts a frozen computer")
    else:
        yield warn(
            "no program feeds it: a frozen computer stays frozen",
            "Write [Manager] and RuntimeWatchdogSec=15 into /etc/systemd/system.conf.d/50-rotator-watchdog.conf, "
            "and reboot.",
        )


def service(machine: Machine) -> Iterator[Finding]:
    if machine.unit is None:
        yield skipped("not installed: rotator run is started by hand")
        return
    asked = "--property=UnitFileState,ActiveState,SubState,MainPID"
    report = machine.says("systemctl", "show", "rotator.service", asked)
    if report is None:
        yield skipped("installed; systemd does not answer here")
        return
    state = dict(line.split("=", 1) for line in report.splitlines() if "=" in line)
    enabled, active = state.get("UnitFileState", ""), state.get("ActiveState", "")
    found = f"{active} ({state.get('SubState', '')}), {enabled}"
    if active == "failed" or state.get("SubState") == "auto-restart":
        yield wrong(found, "The last lines of journalctl -u rotator -n 50 say why.")
    elif active not in ("active", "activating", "reloading"):
        yield warn(found, "sudo systemctl start rotator")
    elif enabled not in ("enabled", "enabled-runtime"):
        yield warn(found, "It will not start by itself after a power cut: sudo systemctl enable rotator")
    elif _goes_first(machine, state.get("MainPID", "0")) is False:
        yield warn(
            f"{found}; the threads that stop a motor have no priority over other programs",
            "A busy computer then stops the antenna for moments: sudo systemctl edit rotator must not take away "
            "LimitRTPRIO=1 and LimitRTTIME=500ms.",
        )
    else:
        yield fine(found)


def _goes_first(machine: Machine, pid: str) -> bool | None:
    """Whether threads of this process are in the kernel's real-time class; None: that cannot be seen."""
    stats = [machine.text(path) for path in machine.glob(f"/proc/{pid}/task/*/stat")]
    policies = [stat.rpartition(")")[2].split()[POLICY_AT] for stat in stats if stat]
    return str(os.SCHED_RR) in policies if policies else None
