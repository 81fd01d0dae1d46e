"""The links that a picture of the box shows."""

from __future__ import annotations

import pytest

from rotator.links.wire import Wire


@pytest.fixture
def wires() -> list[Wire]:
    return [
        Wire("gs232b", "gs232b", "run/gs232", "open as /dev/pts/3", b"W235 025\r", b""),
        Wire("rotctld", "rotctld", "127.0.0.1:4533", "2 clients", b"p\n", b"231.26\n24.04\n"),
    ]
