"""Names of senders, as a person reads them."""

from __future__ import annotations

import pytest

from rotator.orders import Source
from rotator.spoken import spoken


@pytest.mark.parametrize(
    ("text", "read"),
    [
        (f"stopped by {Source('console', 12)}: nothing moves", "stopped by a rotator command: nothing moves"),
        (f"{Source('console', 1)}, in a storm park", "a rotator command, in a storm park"),
        (str(Source("console")), "console"),  # a key at the box itself
        (str(Source("gs232b", 3)), "gs232b#3"),
        ("", ""),
    ],
)
def test_a_command_is_called_so_and_every_other_sender_by_its_name(text: str, read: str) -> None:
    assert spoken(text) == read
