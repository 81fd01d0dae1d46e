"""A drill as a value: a box, its world, and the events of both with their moments. Read from JSON, and written as JSON.

Knows names and numbers. Does not know how a drill is played, nor what the judges forbid.
"""

from __future__ import annotations

import json
from dataclasses import dataclass, field, replace
from typing import Any

FORMAT = "drill 1"
LINKS = ("gs232b", "gs232a", "rotctld", "rotctld-2", "easycomm2", "easycomm3", "pstrotator")
PEOPLE = ("console", "console-2")
PAGE = "page"
"""A person with a browser."""
PANEL, WORLD, CLOCK, PROGRAM = "panel", "world", "clock", "program"

Arg = float | str


@dataclass(frozen=True, slots=True)
class Event:
    """`who` does `what` at this moment of the drill: a link, a person, the panel, the world, the clock, the program."""

    at_s: float
    who: str
    what: str
    args: tuple[Arg, ...] = ()

    def number(self, place: int) -> float:
        return float(self.args[place])

    def text(self, place: int) -> str:
        return str(self.args[place])


@dataclass(frozen=True, slots=True)
class Drill:
    """`tables`: keys of the configuration in place of those of the shipped `profile`."""

    kind: str
    profile: str
    seconds: float
    start_deg: tuple[float, float]
    tables: dict[str, Any] = field(default_factory=dict)
    commissioning: str = ""
    """The axis that is treated as never set up; empty: none."""
    events: tuple[Event, ...] = ()
    seed: str = ""
    """The seed of the noise. It also names the drill from which this script was made."""
    left_alone: bool = False
    """No person sets up the axis that was never set up, or watches."""

    def with_events(self, events: tuple[Event, ...]) -> Drill:
        return replace(self, events=events)

    def until(self, seconds: float) -> Drill:
        """The same, cut off at this moment."""
        return replace(self, seconds=seconds, events=tuple(each for each in self.events if each.at_s < seconds))

    def to_json(self) -> str:
        head = {
            "format": FORMAT,
            "kind": self.kind,
            "profile": self.profile,
            "seconds": self.seconds,
            "start_deg": list(self.start_deg),
            "tables": self.tables,
            "commissioning": self.commissioning,
            **({"left_alone": True} if self.left_alone else {}),
            "seed": self.seed,
        }
        rows = ",\n".join(f"  {json.dumps([each.at_s, each.who, each.what, *each.args])}" for each in self.events)
        return f'{json.dumps(head)[:-1]},\n "events": [\n{rows}\n]}}\n'

    @classmethod
    def from_json(cls, text: str) -> Drill:
        """Raises ValueError for a text that is no drill."""
        try:
            content = json.loads(text)
            if content["format"] != FORMAT:
                raise ValueError(f"its format is not {FORMAT!r}")
            azimuth_deg, elevation_deg = content["start_deg"]
            return cls(
                kind=content["kind"],
                profile=content["profile"],
                seconds=float(content["seconds"]),
                start_deg=(float(azimuth_deg), float(elevation_deg)),
                tables=content["tables"],
                commissioning=content["commissioning"],
                left_alone=bool(content.get("left_alone", False)),
                events=tuple(Event(float(row[0]), row[1], row[2], tuple(row[3:])) for row in content["events"]),
                seed=content["seed"],
            )
        except (KeyError, TypeError, IndexError, AttributeError) as fault:
            raise ValueError(f"no drill: {type(fault).__name__}: {fault}") from None
