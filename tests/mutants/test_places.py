"""Which places of a file are changed, and how. Without Cosmic Ray there is nothing to test."""

from __future__ import annotations

import random

import pytest

pytest.importorskip("cosmic_ray", reason="cosmic-ray is missing: make mutants puts it in")

from benchmarks.mutants.places import Mutant, mutants

SOURCE = '''"""A file."""

from __future__ import annotations

LEAST = 5


def wide(a: int | None, *, b: float = 2.0) -> int | None:
    """Do it."""
    a.close()
    a.b = LEAST
    return None if a is None or b < LEAST else a
'''


def changed(source: str, seed: int = 1, sample: int | None = None) -> list[Mutant]:
    return mutants(source, sample, random.Random(seed))


def test_each_mutant_changes_one_line_and_says_which() -> None:
    for mutant in changed(SOURCE):
        now = mutant.source.splitlines()
        different = [at for at, (a, b) in enumerate(zip(SOURCE.splitlines(), now, strict=True), 1) if a != b]
        assert different == [mutant.line]
        assert (mutant.was, mutant.now) == (SOURCE.splitlines()[mutant.line - 1].strip(), now[mutant.line - 1].strip())


def test_calls_and_attributes_are_dropped_numbers_and_comparisons_changed() -> None:
    seen = {mutant.now for seed in range(25) for mutant in changed(SOURCE, seed)}
    assert {"pass", "LEAST = 6", "return None if a is not None or b < LEAST else a"} <= seen
    assert {"return None if a is None and b < LEAST else a", "return None if a is None or b >= LEAST else a"} <= seen


def test_a_port_has_no_code_that_could_be_wrong() -> None:
    port = '''
class Drive(Protocol):
    @property
    def driven(self) -> bool:
        """Whether it is on."""

    def run(self, *, seconds: float = 2.0) -> None: ...
'''
    assert [mutant for seed in range(25) for mutant in changed(port, seed)] == []


def test_by_a_direction_nothing_is_divided() -> None:
    seen = {mutant.now for seed in range(60) for mutant in changed("gone_deg = (to_deg - from_deg) * way\n", seed)}
    assert "gone_deg = (to_deg - from_deg) + way" in seen
    assert "gone_deg = (to_deg - from_deg) / way" not in seen
    seen = {mutant.now for seed in range(60) for mutant in changed("gone_deg = speed_dps * seconds\n", seed)}
    assert "gone_deg = speed_dps / seconds" in seen
