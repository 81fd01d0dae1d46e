"""What this machine is and has, for the answers that are offered: a Pi or not, its serial ports, its networks.

Reads the kernel's files. Changes nothing.
"""

from __future__ import annotations

import fcntl
import ipaddress
import socket
import struct
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from rotator.setup import tree

_ADDRESS, _NETMASK = 0x8915, 0x891B
"""SIOCGIFADDR and SIOCGIFNETMASK of linux/sockios.h."""
_NO_LAN = ("lo", "docker", "br-", "veth", "virbr", "tun", "wg", "tailscale")


@dataclass(frozen=True, slots=True)
class Machine:
    is_pi: bool = False
    ports: tuple[str, ...] = ()
    """Serial adapters that are plugged in now, by names that stay."""
    addresses: tuple[ipaddress.IPv4Interface, ...] = ()
    """Its addresses in local networks."""
    name: str = "rotator"
    """Its name in the network."""

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


def addresses() -> tuple[ipaddress.IPv4Interface, ...]:
    """The IPv4 addresses of this machine's network cards; those of virtual machines and tunnels are left out."""
    found = []
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as any_socket:
        for _, name in socket.if_nameindex():
            if not name.startswith(_NO_LAN):
                with suppress(OSError):
                    address, mask = (_asked(any_socket, what, name) for what in (_ADDRESS, _NETMASK))
                    found.append(ipaddress.IPv4Interface(f"{address}/{mask}"))
    return tuple(found)


def _asked(any_socket: socket.socket, what: int, name: str) -> str:
    """The answer of the kernel on a network card. Raises OSError for one without an address."""
    answer = fcntl.ioctl(any_socket.fileno(), what, struct.pack("256s", name.encode()[:15]))
    return socket.inet_ntoa(answer[20:24])
