"""A box of each kind, and boxes made to order; whatever a test has opened is closed."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import pytest

from tests.rotors.rig import KINDS, Box, Kind


@pytest.fixture
def new_box() -> Iterator[Callable[..., Box]]:
    boxes: list[Box] = []

    def make(kind: Kind, *args: Any, **tables: Any) -> Box:
        boxes.append(Box(kind, *args, **tables))
        return boxes[-1]

    yield make
    for box in boxes:
        box.close()


@pytest.fixture(params=KINDS, ids=lambda kind: kind.profile)
def kind(request: pytest.FixtureRequest) -> Kind:
    found: Kind = request.param
    return found


@pytest.fixture
def box(kind: Kind, new_box: Callable[..., Box]) -> Box:
    """Each kind of rotor as it is shipped, a second after it was switched on."""
    box = new_box(kind)
    box.run(1.0)
    return box
