"""A short pass for `rotator rehearse`, and the figures that it prints."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

Rotator = Callable[..., Any]
Figures = dict[str, Any]
Rows = list[tuple[float, float, float]]


def through_the_south(folder: Path) -> Path:
    """A pass of a minute."""
    path = folder / "south.csv"
    rows = [f"{t},{100 + t},{10 + t / 4}" for t in range(0, 61, 10)]
    path.write_text("t,az,el\n" + "\n".join(rows) + "\n")
    return path


def figures(done: Any) -> Figures:
    assert done.returncode == 0, done.stderr
    return dict(json.loads(done.stdout))
