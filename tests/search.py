"""How far a search goes: all of its examples in `make test-search`, an eighth of them wherever else it runs.

Knows numbers of examples alone. A search is a test with hypothesis, of which `make test` draws an eighth, or one with
the mark `search`, which `make test` leaves out: it draws its own cases, or sweeps over many that are dear, each a world
of its own. What it looks for is the same in both.
"""

from __future__ import annotations

import os
import random
from collections.abc import Sequence
from typing import TypeVar

WHOLE = os.environ.get("ROTATOR_SEARCH") == "whole"
SEED = os.environ.setdefault("ROTATOR_SEARCH_SEED", str(random.SystemRandom().randrange(10**6)))
"""What the drawn cases begin with: a new one each time, or the one that is given. All processes of a run share it."""
SHARE, LEAST = 8, 10
"""One case in so many, but of drawn examples no fewer than these."""
Case = TypeVar("Case")


def examples(most: int) -> int:
    return most if WHOLE else max(most // SHARE, min(most, LEAST))


def some(cases: Sequence[Case]) -> Sequence[Case]:
    """The cases of a sweep: every eighth from the first on, or all."""
    return cases if WHOLE else cases[::SHARE]
