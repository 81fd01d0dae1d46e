"""The box on a fifth of a core: it is slow there, and nothing that it must do is left undone.

How slow is a figure of `python -m benchmarks.small_machine`, which runs for an hour.
"""

from __future__ import annotations

import os
import statistics

import pytest

from benchmarks.quota import NoQuotaError
from benchmarks.small_machine import KINDS, measure

SECONDS = 40
STOP_EVERY = 4
STOP_MS = 20.0
"""The longest median from a stop to the open relay."""


@pytest.mark.parametrize("kind", list(KINDS))
def test_on_a_fifth_of_a_core_every_order_is_obeyed_and_no_cycle_is_late(kind: str) -> None:
    try:
        result = measure(SECONDS, kind, stop_every=STOP_EVERY)
    except NoQuotaError as reason:
        if os.environ.get("CI") == "true":
            pytest.fail(str(reason))
        pytest.skip(str(reason))
    # A stop opens the relay, a question is answered, and no watch takes the slowness for a fault.
    stops = SECONDS // STOP_EVERY
    assert result.stops.unmet == 0
    assert len(result.stops.after_ms) + result.stops.idle == stops
    assert len(result.stops.after_ms) >= stops / 2
    assert statistics.median(result.stops.after_ms) < STOP_MS
    assert len(result.answers_ms) == 1 + SECONDS - stops
    assert result.warnings == []
