"""What a change of the file is, key by key: for a person who does not read TOML."""

from __future__ import annotations

from typing import Any

import pytest

from rotator.config.proposal import Proposal

TWO = '[[link]]\nprotocol = "gs232b"\npty = "a"\n[[link]]\nprotocol = "rotctld"\ntcp = "127.0.0.1:4533"\n'
ONE = '[[link]]\nprotocol = "rotctld"\ntcp = "127.0.0.1:4533"\n'
RADIO = {"protocol": "gs232b", "pty": "a"}


@pytest.mark.parametrize(
    ("before", "after", "changes"),
    [
        ("[azimuth]\nmax_deg = 450\n", "[azimuth]\nmax_deg = 360 # a stop\n", [(("azimuth", "max_deg"), 450, 360)]),
        ("", '[station]\nlocator = "JO62qm"\n', [(("station", "locator"), None, "JO62qm")]),
        ("[mount]\npark_azimuth_deg = 9\n", "[mount]\n", [(("mount", "park_azimuth_deg"), 9, None)]),
        (TWO, TWO.replace('"a"', '"b"'), [(("link", 0, "pty"), "a", "b")]),
        (TWO, ONE, [(("link", 0), RADIO, None)]),
        (ONE, TWO, [(("link", 0), None, RADIO)]),
        ("# one\n", "# two\n", []),
    ],
)
def test_the_keys_that_change(before: str, after: str, changes: list[Any]) -> None:
    found = Proposal(before, after, ()).changes
    assert [(each.place, each.before, each.after) for each in found] == changes
