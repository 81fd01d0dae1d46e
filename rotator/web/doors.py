"""Which requests are accepted: from which networks, under which names of the box, and from which pages.

Knows addresses and the headers Host, Origin and Sec-Fetch-Site. They keep out a foreign page in a visitor's browser,
which cannot forge them. Does not know request objects, nor what a request is for.
"""

from __future__ import annotations

import ipaddress
import re
from collections.abc import Iterable, Sequence

from rotator.links.allowed import PRIVATE, Allowed

_HOST = re.compile(r"(\[[0-9a-fA-F:.]+\]|[A-Za-z0-9.-]{1,253})(?::[0-9]{1,5})?")


class Doors:
    """`names`: of this computer. `allow`: the networks that may connect; None: private ones."""

    def __init__(self, names: Iterable[str], allow: Sequence[str] | None = None) -> None:
        self._names = {name.lower().rstrip(".") for name in names} | {"localhost"}
        self._names |= {f"{name}.local" for name in self._names if "." not in name and name != "localhost"}
        self._allowed = Allowed(PRIVATE if allow is None else allow)

    def lets_in(self, address: str) -> bool:
        """Whether a machine with this address may connect."""
        return self._allowed(address)

    def knows(self, host: str) -> bool:
        """Whether this is an address of the box, as the header Host names it.

        An IP address always is: a foreign page can point its own name at the box, but not an IP address.
        """
        found = _HOST.fullmatch(host)
        if found is None:
            return False
        name = found[1].lower().rstrip(".")
        try:
            ipaddress.ip_address(name.strip("[]"))
        except ValueError:
            return name in self._names
        return True

    @staticmethod
    def is_own(host: str, origin: str | None, site: str | None) -> bool:
        """Whether a request that changes something comes from the box's own page, or from no page at all.

        `origin`, `site`: the headers Origin and Sec-Fetch-Site; None: missing, as from curl.
        """
        if site is not None and site not in ("same-origin", "none"):
            return False
        return origin is None or origin.lower() in (f"http://{host.lower()}", f"https://{host.lower()}")
