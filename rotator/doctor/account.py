"""The checks of the user account: its groups, and its right to write in the folder of the state file.

Knows which group opens which device on Debian and Raspberry Pi OS. Changes neither groups nor folders.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from rotator.config.model import Config
from rotator.doctor.finding import Finding, fine, skipped, warn, wrong
from rotator.doctor.machine import SERVICE_USER, Machine, nearest

SCARCE_BYTES, TOO_FEW_BYTES = 500_000_000, 50_000_000


def groups(machine: Machine, config: Config) -> Iterator[Finding]:
    needed = _needed(config)
    if not needed:
        yield skipped("this configuration needs none")
        return
    unit = machine.unit
    if unit is not None:
        granted = {name for line in re.findall(r"(?m)^SupplementaryGroups=(.*)$", unit) for name in line.split()}
        yield _membership(machine, SERVICE_USER, needed - granted)
    if machine.user == "root":
        if unit is None:
            yield fine("root needs none")
        return
    if unit is not None and machine.user == SERVICE_USER:
        return  # it is the service itself, which has just been looked at
    own = _membership(machine, machine.user, needed)
    # Where the service runs the box, the user needs the groups for `rotator calibrate` only.
    yield own if own.ok or unit is None else warn(own.found, own.advice)


def _needed(config: Config) -> set[str]:
    on_a_pi = config.rotor.hardware == "pi"
    serial = any(link.serial and "://" not in link.serial for link in config.link)
    needs = {
        "gpio": on_a_pi and bool(config.pins()),
        "i2c": on_a_pi and bool(config.chips()),
        "spi": on_a_pi and any(use.kernel for use in config.spi_uses()),
        "dialout": serial or (on_a_pi and config.kind.serial_port() is not None),
    }
    return {group for group, needed in needs.items() if needed}


def _membership(machine: Machine, user: str, needed: set[str]) -> Finding:
    member_of = _groups_of(machine, user)
    if member_of is None:
        return wrong(f"there is no user {user}", "sudo ./install.sh creates the service's user again.")
    if missing := sorted(needed - member_of):
        return wrong(
            f"{user} is not in {', '.join(missing)}",
            f"sudo usermod -aG {','.join(missing)} {user}, then log in again (a service: restart it).",
        )
    return fine(
        f"{user} is a member of {', '.join(sorted(needed))}" if needed else f"the service gives {user} its groups"
    )


def _groups_of(machine: Machine, user: str) -> set[str] | None:
    """None: no such user in /etc/passwd."""
    primary = next((row[3] for row in _rows(machine, "/etc/passwd", 7) if row[0] == user), None)
    if primary is None:
        return None
    rows = _rows(machine, "/etc/group", 4)
    return {name for name, _, number, members in rows if number == primary or user in members.split(",")}


def _rows(machine: Machine, path: str, fields: int) -> list[list[str]]:
    rows = [line.split(":") for line in (machine.text(path) or "").splitlines()]
    return [row for row in rows if len(row) == fields]


def state_folder(machine: Machine, config: Config) -> Iterator[Finding]:
    path = Path(config.state.path)
    folder = str(path.parent)
    if not machine.may_write_in(path.parent):
        yield wrong(
            f"{folder} cannot be written to: the learnt motor speeds would be lost",
            f"sudo install -d -o {machine.user} {folder}; or is the card read-only? Then use a folder that is not.",
        )
        return
    free = machine.free_bytes(nearest(machine.at(path.parent)))
    found = f"{folder}: {free / 1e9:.1f} GB free"
    if free < TOO_FEW_BYTES:
        yield wrong(found, "The card is full: sudo apt clean, and sudo journalctl --vacuum-size=50M.")
    elif free < SCARCE_BYTES:
        yield warn(found, "The card is nearly full: sudo apt clean, and sudo journalctl --vacuum-size=50M.")
    else:
        yield fine(found)
