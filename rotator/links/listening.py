"""Why the box cannot listen at an address, and what to write into its file instead; and which machines may connect.

Knows the usual errors: the PC's address in place of the box's own, a name that does not exist, a port for root. Knows
network cards and networks. Opens no port, and knows no link.
"""

from __future__ import annotations

import errno
import fcntl
import ipaddress
import os
import socket
import struct
from collections.abc import Sequence
from contextlib import suppress

from rotator.links.wire import reason

PRIVATE = (
    "127.0.0.0/8",
    "10.0.0.0/8",
    "172.16.0.0/12",
    "192.168.0.0/16",
    "169.254.0.0/16",
    "::1",
    "fc00::/7",
    "fe80::/10",
)
"""This computer, and the networks of homes and clubs."""


class Allowed:
    """The networks whose machines may connect, such as "192.168.1.0/24", "fd00::/8" or one address.

    `networks` None: every machine may connect. Raises ValueError for a text that is no network.
    """

    def __init__(self, networks: Sequence[str] | None = None) -> None:
        # Not strict: "192.168.1.5/24" stands for the whole network 192.168.1.0/24.
        self._networks = None if networks is None else [ipaddress.ip_network(text, strict=False) for text in networks]

    def __call__(self, host: str) -> bool:
        """Whether the machine with this address may connect."""
        if self._networks is None:
            return True
        try:
            address = ipaddress.ip_address(host.partition("%")[0])
        except ValueError:
            return False
        # A socket for both families shows an IPv4 machine as ::ffff:192.168.1.5.
        mapped = address.ipv4_mapped if isinstance(address, ipaddress.IPv6Address) else None
        return any((mapped or address) in network for network in self._networks)


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


LAST_OF_ROOT = 1023
NOT_OURS = "could not bind"
"""The begin of asyncio's text in Python 3.13, without an error number, if no address belongs to this machine."""


def cannot_listen(fault: OSError | UnicodeError, host: str, port: int, rival: str = "") -> str:
    """The whole sentence, in one line. `rival`: another part of the same file with this port; empty: none."""
    shown = f"[{host}]" if ":" in host else host
    return f"{shown}:{port}: cannot listen there: {_why(fault, host, port, rival)}"


def _why(fault: OSError | UnicodeError, host: str, port: int, rival: str) -> str:
    number = fault.errno if isinstance(fault, OSError) and not isinstance(fault, socket.gaierror) else None
    if number == errno.EADDRINUSE and rival:
        return (
            f"{os.strerror(number)}: {rival} of the same file has this port too: write another port for one of the two"
        )
    if number == errno.EADDRNOTAVAIL or (number is None and NOT_OURS in str(fault)):
        allow = (
            f', and allow = ["{host}"] for that machine'
            if _is_lan(host)
            else ", and in allow the machines that may connect"
        )
        return f"{os.strerror(errno.EADDRNOTAVAIL)}: {_ours()}; for the network write 0.0.0.0:{port}{allow}"
    if number == errno.EACCES and port <= LAST_OF_ROOT:
        return f"{os.strerror(number)}: ports up to {LAST_OF_ROOT} are root's: write one above, such as {port + 8000}"
    if isinstance(fault, socket.gaierror):
        return (
            f"{reason(fault)}: write an address: 127.0.0.1:{port} for programs on this machine, "
            f"0.0.0.0:{port} for the network too"
        )
    return reason(fault)


def _ours() -> str:
    return f"this machine has {', '.join([*(str(each.ip) for each in addresses()), '127.0.0.1'])}"


def _is_lan(host: str) -> bool:
    try:
        return ipaddress.ip_address(host).is_private
    except ValueError:
        return False
