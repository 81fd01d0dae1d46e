"""How often each machine has its day, from which seed, and the end of what a test started.

`pytest tests/machines --times 100 --seed 7`: a hundred days each. Without a seed each run has a new one, and the head
of the report says which.
"""

from __future__ import annotations

import os
import random
import secrets
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.machines.shack import Shack

SEED = "ROTATOR_MACHINES_SEED"
"""Carries the seed to the worker processes, which must all have the same."""
DAYS = 1
"""Days of each machine, where the command does not say how many."""


def pytest_configure(config: pytest.Config) -> None:
    given = config.getoption("--seed", None)
    os.environ.setdefault(SEED, str(given if given is not None else secrets.randbelow(10**6)))


def pytest_report_header() -> str:
    return f"machines: --seed {os.environ[SEED]}"


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """A test that takes `chance` runs once a day, each time with another seed."""
    if "chance" in metafunc.fixturenames:
        first, times = int(os.environ[SEED]), metafunc.config.getoption("--times") or DAYS
        metafunc.parametrize("chance", range(first, first + times), indirect=True)


@pytest.fixture
def chance(request: pytest.FixtureRequest) -> random.Random:
    """The day's source of random places and times."""
    return random.Random(f"{request.node.originalname} {request.param}")


@pytest.fixture
def shack(tmp_path: Path) -> Iterator[Callable[..., Shack]]:
    """`shack(profile, keys)` sets up a machine; the program ends with the test."""
    machines: list[Shack] = []

    def set_up(profile: str, keys: dict[str, Any] | None = None) -> Shack:
        folder = tmp_path / f"{profile}{len(machines)}"
        folder.mkdir()
        machines.append(Shack(folder, profile, keys or {}))
        return machines[-1]

    yield set_up
    for machine in machines:
        machine.close()
