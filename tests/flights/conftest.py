"""The twelve passes on every kind of rotor take minutes: they run where they are asked for, `make test-flights`."""

from __future__ import annotations

from pathlib import Path

import pytest


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """Only where they are asked for by name."""
    asked = any("tests/flights" in argument for argument in config.args)
    return None if asked or collection_path == Path(__file__) else True
