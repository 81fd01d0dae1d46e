"""One axis of a drill as its judges see it: the possible error of its sensor, its excuses, and the seconds they count.

Knows seconds and degrees. Does not know the world, the orders or the line of the table that a judge stands for:
`scene` says what excuses an axis, and `judges` counts the seconds.
"""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass, field

WELDED_S = 2.0
TRY_S = 2.0
SHOWN_S = 1.5
"""A weld that has turned the axis for this time can be known."""
ALONE_DEG = 1.0
COUNTED_PERIODS = 3
"""After this many periods of its contact without a change a counted axis can tell that it stands."""
START_S = 0.5
"""A motor may take this long to start; a shorter pulse of current is no try."""


@dataclass(slots=True)
class AxisCase:
    """What the judges keep of one axis. `slack_deg`: an error of its sensor that no box can notice."""

    low_deg: float
    high_deg: float
    tolerance_deg: float
    slack_deg: float = 1.0
    fitted: bool = True
    """Whether the rotor has this axis, by its file."""
    shift_deg: float = 0.0
    """Added to an angle on the rotor's own scale, it gives true degrees."""
    trusted: bool = True
    """Whether the box can know the angle of this axis. False: its count is lost, or its model is astray."""
    astray: bool = False
    """The hardware has led the model of this axis astray: the axis then moves to the angle of the model."""
    feels: bool = True
    """Whether the box has a reading of this axis. Without one it cannot know that the axis stands."""
    keeps_place: bool = False
    """An encoder on the output shows the angle also after a power cut of its controller."""
    counts: bool = False
    blind: bool = False
    """The contact of a counted axis is stuck: nothing shows that a welded relay turns the axis."""
    shown_ends: tuple[int, ...] = ()
    """The ends, 1 or -1, that a limit switch shows, also where the axis was never set up."""
    repeats: bool = False
    """The sensor repeats one reading: other faults of the sensor do not show."""
    befallen: bool = False
    """A trouble that no box can notice has spoilt its angle, or may have."""
    unheard: bool = False
    """Its ready-made controller does not hear the box, or does not obey its stop."""
    runs_down: bool = False
    """The program has died, and its ready-made controller goes on to its last target."""
    deaf: bool = False
    """The chip of the axis's control box does not hear: only a cut of its supply stops the axis."""
    misplaced: bool = False
    """Something may hold the axis at an angle that is no end by its limits and its sensor."""
    drifts: bool = False
    """The sensor has drifted: the axis meets one stop at several readings."""
    beside_deg: float = 0.0
    """How far a control box may turn after an order to hold: to the angle that its drifted sensor read then."""
    stalls: bool = False
    """The motor may have current and stand, at any angle."""
    ran_on_s: float = 0.0
    """For how long a welded relay has turned the axis since the box switched that relay off."""
    patience_s: float = TRY_S
    """How long the box may take to see that the axis stands."""
    beyond_s: float = 0.0
    at_stops_s: float = 0.0
    """How long the axis was driven against its stops since the latest release by a person."""
    away_s: float = 0.0
    idle_s: float = 0.0
    welded_s: float = 0.0
    weld_shown_s: float = 0.0
    """For how long a welded relay has turned the axis while the box did not feed its motor itself."""
    weld_known: bool = False
    """That was long enough to be seen, and the supply was cut afterwards."""
    fed_s: float = 0.0
    """For how long the motor has had current through the welded relay since then."""
    standing_s: float = 0.0
    pressed_s: float = 0.0
    """How long the axis stood in its latest run, until that run ended."""
    stood_s: float = 0.0
    """For how long a counted axis stood in short runs, taken together: `patience_s` of them is a try."""
    shorted_s: float = 0.0
    brake_harm: tuple[float, int] = (0.0, 0)
    sped_s: float = 0.0
    """For how long its speed input has been above its lowest, with the motor off."""
    alone_s: float = 0.0
    """For how long presses of an axis that was never set up, of which no person was one, have not moved it."""
    alone_deg: float = math.inf
    """Where it stands meanwhile."""
    winds_down_s: float = 0.0
    """Until this moment a motor may still slow down under current after a stop: that is no try."""
    tries_s: deque[float] = field(default_factory=deque)

    def beside_s(self, full_dps: float) -> float:
        return self.beside_deg / full_dps + START_S if self.beside_deg else 0.0

    @property
    def deaf_s(self) -> float:
        """How long the box may take to cut the supply of a control box that does not hear."""
        return max(WELDED_S, self.patience_s) if self.deaf else 0.0

    def alone(self, past_s: float, shaft_deg: float, *, stands: bool) -> None:
        """The box has fed the motor of an axis that no person watches."""
        if abs(shaft_deg - self.alone_deg) > ALONE_DEG:
            self.alone_s, self.alone_deg = 0.0, shaft_deg
        self.alone_s += past_s if stands else 0.0

    def weld_feeds(self, past_s: float, *, fed: bool, turns: bool) -> None:
        """What has passed since the look before, while the box did not feed the motor."""
        self.weld_known = self.weld_known or (not fed and self.weld_shown_s >= SHOWN_S)
        self.weld_shown_s = self.weld_shown_s + past_s if fed and turns else 0.0
        self.fed_s = self.fed_s + past_s if fed and self.weld_known else self.fed_s

    def weld_forgotten(self) -> None:
        """The relay is open again, or the program has ended."""
        self.weld_known, self.weld_shown_s, self.fed_s = False, 0.0, 0.0

    def rest(self, *, at_stop: bool) -> None:
        """The box feeds the motor no longer. The time beyond a limit goes on only while the axis stands at its stop.

        A counted axis cannot tell from one short run to the next that it stands: each run counts for itself.
        """
        self.pressed_s = self.standing_s or self.pressed_s
        self.beyond_s = self.beyond_s if at_stop and not self.counts else 0.0
        self.away_s = self.idle_s = self.standing_s = 0.0
        self.runs_down = False

    def stopped(self, winds_down_s: float) -> None:
        """The next order is a new try, also if the current never stopped."""
        self.beyond_s = self.standing_s = 0.0
        self.runs_down, self.winds_down_s = False, winds_down_s

    def press(self) -> None:
        """A person who sets the axis up watches it touch its stops: each press is a try of its own."""
        self.beyond_s = self.standing_s = 0.0
