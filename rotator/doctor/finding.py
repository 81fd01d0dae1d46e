"""What a check says, and what a check is.

Knows the form. Knows nothing of what there is to look at.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Generic, ParamSpec

P = ParamSpec("P")


@dataclass(frozen=True, slots=True)
class Finding:
    """`ok` None: not looked at, or nothing to look at here. `advice` beside a True makes it a warning."""

    ok: bool | None
    found: str
    advice: str = ""

    @property
    def mark(self) -> str:
        match self.ok:
            case None:
                return "–"
            case False:
                return "✗"
            case True:
                return "!" if self.advice else "✓"


def fine(found: str) -> Finding:
    return Finding(True, found)


def warn(found: str, advice: str) -> Finding:
    return Finding(True, found, advice)


def wrong(found: str, advice: str) -> Finding:
    return Finding(False, found, advice)


def skipped(found: str) -> Finding:
    return Finding(None, found)


@dataclass(frozen=True, slots=True)
class Check(Generic[P]):
    """One thing to look at: its name, a sentence of what it looks at, and the look itself."""

    name: str
    looks_at: str
    look: Callable[P, Iterator[Finding]]
    on_chips: bool = False
    """It looks at chips, which a simulated station has as well."""
