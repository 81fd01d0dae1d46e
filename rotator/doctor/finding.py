"""A check, and its findings.

Knows their form. Knows nothing of the box.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, Generic, ParamSpec

from hw.ports import HardwareError

P = ParamSpec("P")


@dataclass(frozen=True, slots=True)
class Finding:
    """`ok` None: not checked, or nothing here to check. True with an `advice` is a warning."""

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
    """`advice`: where the user has to look, because the program cannot."""
    return Finding(None, found, advice)


def refused(about: str, fault: HardwareError) -> Finding:
    """The error of a driver as a finding; the text after its semicolon is the advice."""
    problem, _, cure = str(fault).partition("; ")
    return wrong(f"{about}: {problem}", f"{cure[:1].upper()}{cure[1:]}." if cure else "See docs/troubleshooting.md.")


def always(_config: Any) -> bool:
    return True


@dataclass(frozen=True, slots=True)
class Check(Generic[P]):
    """One check: its name, what it looks at in a sentence, and the function that looks."""

    name: str
    looks_at: str
    look: Callable[P, Iterator[Finding]]
    on_chips: bool = False
    """It looks at chips. A simulated station has them too."""
    concerns: Callable[[Any], bool] = always
    """Whether the configuration has anything of this kind; else the check is left out."""
