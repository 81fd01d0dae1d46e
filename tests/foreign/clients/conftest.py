"""A box for a foreign program: its own process with the links that the program wants, and the truth about its antenna.

Knows how to start and end it. The box itself, and where its antenna really is, are the machines' `Shack`: the simulated
world's own file says it, never the program and never the box.
"""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.boxes import FAST_ROTOR
from tests.machines.shack import Shack


@pytest.fixture
def box_with(tmp_path: Path) -> Iterator[Callable[..., Shack]]:
    """`box_with(link, …)` starts a fast simulated rotor with these links, at 0/0. A `serial` link becomes a pty."""
    boxes: list[Shack] = []

    def start(*links: dict[str, Any]) -> Shack:
        folder = tmp_path / f"box{len(boxes)}"
        folder.mkdir()
        boxes.append(Shack(folder, "g5500", {**tomllib.loads(FAST_ROTOR), "link": list(links)}))
        boxes[-1].start()
        return boxes[-1]

    yield start
    for box in boxes:
        box.close()
