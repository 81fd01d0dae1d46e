"""Which machines may connect to a link.

Knows IPv4 and IPv6 addresses and networks. Does not know any link: a link asks with the address of its client.
"""

from __future__ import annotations

import ipaddress
from collections.abc import Sequence

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
