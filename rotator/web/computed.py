"""Answers for the page, as JSON, that a process of its own computes: kept for a while, and computed once for all.

An answer takes seconds of a small Pi's core; neither the control nor a STOP may wait for it. Knows commands and their
answers. Does not know what is computed.
"""

from __future__ import annotations

import asyncio
import sys
from collections.abc import Callable, Sequence
from typing import Any

from rotator.config.sky import NO_PLACE
from rotator.exchange.foreign import json_of

ERROR_KEPT_S, TAKES_S = 10.0, 120.0
LEAST_PRIORITY = ("nice", "-n", "19")


def of_the_program(*words: str) -> tuple[str, ...]:
    """A command of this program, with the lowest priority."""
    return (*LEAST_PRIORITY, sys.executable, "-m", "rotator", *words)


class Computed:
    """`words`: the command; None: the configuration has no place of the station. `named`: what it prints, for an error.

    `shaped` makes the answer from the command's JSON. `good`: the exit codes with which the JSON is complete. `clock`
    gives seconds. `source` gives what the answer is computed from: the same object until that changes.
    """

    def __init__(
        self,
        words: Sequence[str] | None,
        clock: Callable[[], float],
        source: Callable[[], object] = lambda: None,
        *,
        named: str,
        kept_s: float,
        shaped: Callable[[Any], dict[str, Any]],
        good: Sequence[int] = (0,),
    ) -> None:
        self._words = words or ()
        self._clock = clock
        self._source, self._computed_for = source, source()
        self._named = named
        self._kept_s = kept_s
        self._shaped = shaped
        self._good = good
        self._computing: asyncio.Task[None] | None = None
        self._kept: dict[str, Any] = {}
        self._until_s = 0.0

    def answer(self) -> dict[str, Any] | None:
        """The answer, or `error` with the reason. None: it is being computed; ask again."""
        if not self._words:
            return {"error": NO_PLACE}
        if (now := self._source()) is not self._computed_for:
            self._computed_for = now
            self.forget()
        if self._clock() < self._until_s:
            return self._kept
        if self._computing is None or self._computing.done():
            self._computing = asyncio.create_task(self._compute(), name=f"page: {self._named}")
        return None

    def latest(self) -> dict[str, Any] | None:
        """The last answer. If it is old, a new one is being computed. None: no answer yet."""
        return self.answer() or self._kept or None

    async def close(self) -> None:
        """End the process that computes."""
        computing = self._computing
        self.forget()
        if computing is not None:
            await asyncio.gather(computing, return_exceptions=True)

    def forget(self) -> None:
        """The source of the answer has changed: compute the answer again at the next request."""
        self._until_s = 0.0
        if self._computing is not None:
            self._computing.cancel()
            self._computing = None

    async def newest(self) -> dict[str, Any]:
        """Wait until it is computed. Returns the same as `answer`."""
        while (answer := self.answer()) is None:
            assert self._computing is not None, "an answer that is missing is being computed"
            await asyncio.wait([self._computing])
        return answer

    async def _compute(self) -> None:
        try:
            self._kept = await self._answer()
        except OSError as fault:
            self._kept = {"error": f"{self._named} cannot be computed: {fault}"}
        self._until_s = self._clock() + (ERROR_KEPT_S if "error" in self._kept else self._kept_s)

    async def _answer(self) -> dict[str, Any]:
        pipe = asyncio.subprocess.PIPE
        process = await asyncio.create_subprocess_exec(
            *self._words, stdin=asyncio.subprocess.DEVNULL, stdout=pipe, stderr=pipe
        )
        try:
            async with asyncio.timeout(TAKES_S):
                out, err = await process.communicate()
            if process.returncode in self._good:
                return self._shaped(json_of(out))
        except TimeoutError:
            return {"error": f"{self._named} are not computed within {TAKES_S:g} s"}
        except ValueError as fault:
            return {"error": f"{self._named} cannot be read: {fault}"}
        finally:
            if process.returncode is None:
                process.kill()
                await process.wait()
        lines = err.decode("utf-8", "replace").strip().splitlines()
        return {"error": (lines or [f"{self._named} cannot be computed"])[-1].removeprefix("rotator: ")}
