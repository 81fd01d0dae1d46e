"""The passes of the next day: another process computes them, once for all who look."""

from __future__ import annotations

import asyncio
import sys
from pathlib import Path
from typing import Any

import pytest

from rotator.config.sky import NO_PLACE
from rotator.web.computed import ERROR_KEPT_S, Computed
from rotator.web.plan import KEPT_S, coming_passes
from tests.web.conftest import PATIENCE_S


def printing(text: str, code: int = 0, *, to: str = "stdout") -> tuple[str, ...]:
    return (sys.executable, "-c", f"import sys; sys.{to}.write({text!r}); sys.exit({code})")


async def computed(passes: Computed) -> dict[str, Any]:
    """Ask until they are there, as the page does."""
    async with asyncio.timeout(PATIENCE_S):
        while (answer := passes.answer()) is None:
            await asyncio.sleep(0.01)
        return answer


async def test_an_error_is_not_kept_for_long() -> None:
    now_s = [0.0]
    passes = coming_passes(printing("", 3), lambda: now_s[0])
    assert "error" in await computed(passes)
    now_s[0] = ERROR_KEPT_S
    assert passes.answer() is None
    await computed(passes)


async def test_they_are_kept_for_a_while(tmp_path: Path) -> None:
    counts = tmp_path / "counts"
    words = (sys.executable, "-c", f"open({str(counts)!r}, 'a').write('x'); print('[]')")
    now_s = [0.0]
    passes = coming_passes(words, lambda: now_s[0])
    assert passes.answer() is None, "no request waits for them"
    assert await asyncio.gather(computed(passes), computed(passes)) == [{"passes": []}] * 2
    assert counts.read_text() == "x"
    now_s[0] = KEPT_S
    await computed(passes)
    assert counts.read_text() == "xx"


async def test_new_elements_change_them(tmp_path: Path) -> None:
    """Also those that the box has fetched by itself, or that a person has copied there."""
    counts = tmp_path / "counts"
    words = (sys.executable, "-c", f"open({str(counts)!r}, 'a').write('x'); print('[]')")
    known: list[object] = [()]
    passes = coming_passes(words, lambda: 0.0, lambda: known[0])
    await computed(passes)
    assert passes.answer() is not None, "nothing is new"
    known[0] = ("ISS",)
    assert passes.answer() is None
    await computed(passes)
    assert passes.latest() == {"passes": []}
    assert counts.read_text() == "xx"


@pytest.mark.parametrize(
    ("words", "error"),
    [
        (None, NO_PLACE),
        (printing("rotator: name a target\n", 1, to="stderr"), "name a target"),
        (printing("no JSON"), "the passes cannot be read"),
        (printing("", 3), "the passes cannot be computed"),
    ],
)
def test_a_box_without_a_sky_says_why(words: tuple[str, ...] | None, error: str) -> None:
    answer = asyncio.run(computed(coming_passes(words, lambda: 0.0)))
    assert answer["error"].startswith(error)
