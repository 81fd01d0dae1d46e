"""The box on a fifth of a core: it is slow there, and nothing that it must do is left undone.

How slow is a figure of `python -m benchmarks.running.busy fifth`.
"""

from __future__ import annotations

import asyncio
import os
import statistics

import pytest

from benchmarks.running.busy import CASES, PROFILES, measure
from benchmarks.running.quota import NoQuotaError

SECONDS = 40
STOP_EVERY = 4
STOP_MS = 20.0
"""The longest median from a stop to the open relay."""


@pytest.mark.parametrize("kind", list(PROFILES))
def test_on_a_fifth_of_a_core_every_order_is_obeyed_and_no_cycle_is_late(kind: str) -> None:
    try:
        result = asyncio.run(measure(CASES["fifth"], SECONDS, kind, stop_every=STOP_EVERY))
    except NoQuotaError as reason:
        if os.environ.get("CI") == "true":
            pytest.fail(str(reason))
        pytest.skip(str(reason))
    # A stop opens the relay, a question is answered, and no watch takes the slowness for a fault.
    stops = SECONDS // STOP_EVERY
    seen = result.stops["S"]
    assert seen.unmet == 0
    assert len(seen.after_ms) + seen.idle == stops
    assert len(seen.after_ms) >= stops / 2
    assert statistics.median(seen.after_ms) < STOP_MS
    assert len(result.answers_ms) == SECONDS - stops
    assert result.said == []
