"""The addresses that this machine has in its local networks, as the kernel tells them.

Knows network cards. Opens no port, and sends nothing.
"""

from __future__ import annotations

import fcntl
import ipaddress
import socket
import struct
from contextlib import suppress

_ADDRESS, _NETMASK = 0x8915, 0x891B
"""SIOCGIFADDR and SIOCGIFNETMASK of linux/sockios.h."""
_NO_LAN = ("lo", "docker", "br-", "veth", "virbr", "tun", "wg", "tailscale")


def addresses() -> tuple[ipaddress.IPv4Interface, ...]:
    """The IPv4 addresses of this machine's network cards; those of virtual machines and tunnels are left out."""
    found = []
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as any_socket:
        for _, name in socket.if_nameindex():
            if not name.startswith(_NO_LAN):
                with suppress(OSError):
                    address, mask = (_asked(any_socket, request, name) for request in (_ADDRESS, _NETMASK))
                    found.append(ipaddress.IPv4Interface(f"{address}/{mask}"))
    return tuple(found)


def _asked(any_socket: socket.socket, request: int, name: str) -> str:
    """The answer of the kernel on a network card. Raises OSError for one without an address."""
    answer = fcntl.ioctl(any_socket.fileno(), request, struct.pack("256s", name.encode()[:15]))
    return socket.inet_ntoa(answer[20:24])
