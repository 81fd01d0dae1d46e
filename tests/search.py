"""How far a search goes: `make test` tries a quarter of the examples of each, `make test-search` all of them.

Knows numbers of examples alone. A search is a test with hypothesis, or one with the mark
`search` that draws its own cases. What it looks for is the same in both.
"""

from __future__ import annotations

import os

WHOLE = os.environ.get("ROTATOR_SEARCH") == "whole"
LEAST = 10


def examples(most: int) -> int:
    return most if WHOLE else max(most // 4, min(most, LEAST))
