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


class Passes(Computed):
    """`words`: the command; None: the configuration has no place of the station. `clock` gives seconds.

    `elements` gives the elements of the satellites: the same object until one changes.
    """

    def __init__(
        self, words: Sequence[str] | None, clock: Callable[[], float], elements: Callable[[], object] = lambda: None
    ) -> None:
        super().__init__(
            words or (), clock, named="the passes", kept_s=KEPT_S, shaped=lambda rows: {"passes": rows[:MOST]}
        )
        self._elements = elements
        self._computed_for = elements()

    def answer(self) -> dict[str, Any] | None:
        """`passes`, or `error` with the reason. None: they are being computed; ask again."""
        if not self._words:
            return {"error": NO_PLACE}
        elements = self._elements()
        if elements is not self._computed_for:
            # Fetched, or copied into the folder.
            self._computed_for = elements
            self.forget()
        return super().answer()

    @property
    def known(self) -> list[dict[str, Any]] | None:
        """The last computed passes. If they are old, new ones are being computed. None: none yet."""
        latest = self.latest()
        return None if latest is None else latest.get("passes", [])
