"""The passes of the next day for the page, as `rotator sky passes --json` prints them.

Knows the command. Does not know orbits.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Annotated, Any

from typing_extensions import TypedDict

from rotator.config.station import NO_PLACE
from rotator.web.computed import Computed, of_the_program
from rotator.web.schema import the

KEPT_S = 1200.0
MOST = 300
HOURS = 24
_Moment = Annotated[str | None, the("with its time zone; null: not within this day")]
_Planned = TypedDict(
    "_Planned",
    {
        "set_off": Annotated[str | None, the("when the antenna goes there")],
        "from": str | None,
        "until": str | None,
        "wait_az_deg": float | None,
        "wait_el_deg": float | None,
        "over_the_top": bool | None,
        "lost_s": Annotated[float | None, the("of the pass, to turns of the antenna")],
        "flown": bool,
        "reason": Annotated[str | None, the("why it is left out, or not flown whole")],
    },
)


class Pass(TypedDict):
    name: str
    aos: _Moment
    los: _Moment
    tca: Annotated[str, the("when it is highest")]
    aos_az_deg: float | None
    los_az_deg: float | None
    max_el_deg: float
    expected_error_deg: float
    plan: Annotated[_Planned | None, the("null: not in the plan")]


ManyPasses = TypedDict("ManyPasses", {"passes": list[Pass]})


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
