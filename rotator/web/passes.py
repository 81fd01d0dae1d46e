"""The passes of the next day for the page, as `rotator sky passes --json` prints them.

Knows the command. Does not know orbits.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from rotator.config.station import NO_PLACE
from rotator.web.computed import Computed, of_the_program
from rotator.web.schema import NUMBER, TEXT, YES, object_of, or_null, the

KEPT_S = 1200.0
MOST = 300
HOURS = 24
_MOMENT = the("with its time zone; null: not within this day", or_null(TEXT))
_PLANNED = object_of(
    {
        "set_off": the("when the antenna goes there", or_null(TEXT)),
        "from": or_null(TEXT),
        "until": or_null(TEXT),
        "wait_az_deg": or_null(NUMBER),
        "wait_el_deg": or_null(NUMBER),
        "over_the_top": or_null(YES),
        "lost_s": the("of the pass, to turns of the antenna", or_null(NUMBER)),
        "flown": YES,
        "reason": the("why it is left out, or not flown whole", or_null(TEXT)),
    }
)
PASS = object_of(
    {
        "name": TEXT,
        "aos": _MOMENT,
        "los": _MOMENT,
        "tca": the("when it is highest", TEXT),
        "aos_az_deg": or_null(NUMBER),
        "los_az_deg": or_null(NUMBER),
        "max_el_deg": NUMBER,
        "expected_error_deg": NUMBER,
        "plan": the("null: not in the plan", or_null(_PLANNED)),
    }
)


def command(path: Path) -> tuple[str, ...]:
    """The command that prints the passes of the configured targets, as JSON."""
    return of_the_program("sky", "passes", "--json", "--hours", str(HOURS), "--config", str(path))


class Passes:
    """`words`: the command; None: the configuration has no place of the station. `clock` gives seconds.

    `elements` gives the elements of the satellites: the same object until one changes.
    """

    def __init__(
        self, words: Sequence[str] | None, clock: Callable[[], float], elements: Callable[[], object] = lambda: None
    ) -> None:
        self._elements = elements
        self._computed_for = elements()
        self._computed = (
            Computed(words, clock, named="the passes", kept_s=KEPT_S, shaped=lambda rows: {"passes": rows[:MOST]})
            if words
            else None
        )

    @property
    def latest(self) -> list[dict[str, Any]] | None:
        """The last computed passes. If they are old, new ones are being computed. None: none yet."""
        if self._computed is None:
            return []
        self._look()
        latest = self._computed.latest()
        return None if latest is None else latest.get("passes", [])

    def forget(self) -> None:
        """Elements or priorities have changed: compute the passes again at the next request."""
        if self._computed:
            self._computed.forget()

    async def close(self) -> None:
        """End the process that computes."""
        if self._computed:
            await self._computed.close()

    def answer(self) -> dict[str, Any] | None:
        """`passes`, or `error` with the reason. None: they are being computed; ask again."""
        self._look()
        return self._computed.answer() if self._computed else {"error": NO_PLACE}

    def _look(self) -> None:
        """Forget the passes if elements are new: fetched, or copied into the folder."""
        elements = self._elements()
        if elements is not self._computed_for:
            self._computed_for = elements
            self.forget()
