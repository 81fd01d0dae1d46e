"""What this machine is and has, for the answers that are offered: a Pi or not, its serial ports, its networks.

Reads the kernel's files. Changes nothing.
"""

from __future__ import annotations

import ipaddress
import socket
from dataclasses import dataclass
from pathlib import Path

from rotator.links.listening import addresses
from rotator.setup import tree


@dataclass(frozen=True, slots=True)
class Machine:
    is_pi: bool = False
    ports: tuple[str, ...] = ()
    """Serial adapters that are plugged in now, by names that stay."""
    addresses: tuple[ipaddress.IPv4Interface, ...] = ()
    """The machine's addresses in local networks."""
    name: str = "rotator"
    """The machine's name in the network."""

    @property
    def networks(self) -> tuple[str, ...]:
        """The local networks, such as 192.168.1.0/24."""
        return tuple(dict.fromkeys(str(address.network) for address in self.addresses))


def this_machine(root: Path = Path("/")) -> Machine:
    by_name = sorted((root / "dev/serial/by-id").glob("*"))
    return Machine(
        tree.pi(root) is not None,
        tuple(f"/{path.relative_to(root)}" for path in by_name),
        addresses(),
        socket.gethostname().partition(".")[0],
    )
