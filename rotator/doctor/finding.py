"""What a check says, and what a check is.

Knows the form. Knows nothing of what there is to look at.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, Generic, ParamSpec

from hw.ports import HardwareError

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


def skipped(found: str, advice: str = "") -> Finding:
    """`advice`: where a person has to look, because the program cannot."""
    return Finding(None, found, advice)


def refused(about: str, fault: HardwareError) -> Finding:
    """What a driver says is wrong; after its semicolon it says what to do."""
    problem, _, cure = str(fault).partition("; ")
    return wrong(f"{about}: {problem}", f"{cure[:1].upper()}{cure[1:]}." if cure else "See docs/troubleshooting.md.")


def always(_config: Any) -> bool:
    return True


@dataclass(frozen=True, slots=True)
class Check(Generic[P]):
    """One thing to look at: its name, a sentence of what it looks at, and the look itself."""

    name: str
    looks_at: str
    look: Callable[P, Iterator[Finding]]
    on_chips: bool = False
    """It looks at chips, which a simulated station has as well."""
    concerns: Callable[[Any], bool] = always
    """Whether the configuration that it is given has anything of the kind; the check is left out where it has not."""
