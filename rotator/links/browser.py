"""Whether a connection begins as a browser's does: any web site can let the browsers that show it send bytes to a port.

Such a request may carry a whole order in its body, and a browser in the network is allowed to connect. Knows the first
bytes of HTTP and of TLS. None of the protocols but `pstrotatoraz` begins like this; that one judges requests itself.
"""

from __future__ import annotations

import re

_BEGINNING = re.compile(rb"(?:GET|HEAD|POST|PUT|PATCH|DELETE|OPTIONS|CONNECT|TRACE) |\x16\x03")
"""The first word of a request, or the greeting of https."""
LONGEST = len(b"OPTIONS ")


class Beginning:
    """The first bytes of one connection, in any pieces."""

    def __init__(self) -> None:
        self._bytes = b""

    def is_a_browsers(self, data: bytes) -> bool:
        """Take the next bytes. Returns whether the connection has begun as a browser's does."""
        if len(self._bytes) < LONGEST:
            self._bytes += data[: LONGEST - len(self._bytes)]
        return _BEGINNING.match(self._bytes) is not None
