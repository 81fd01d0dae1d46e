"""Guides the operator while a compass on the mast learns its iron: the antenna turns once round. The field over that
turn is an ellipse, whose middle and half axes become keys of the file.

Knows what to ask, and when a turn shows enough. Pure: no clock, no terminal, no chip, no file. The readings in degrees
mean nothing meanwhile.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from hw.ports import Ellipse
from rotator.calibrating.axis_guide import AxisGuide
from rotator.calibrating.entries import Word
from rotator.calibrating.facts import AxisFacts
from rotator.calibrating.guide import NOTHING_SAVED, Steps
from rotator.calibrating.question import Choice, Question
from rotator.calibrating.results import FieldLearnt
from rotator.control.sky.equations import solved

Field = tuple[float, float]

APART_UT = 1.0
"""A field nearer to the last one that was kept is not kept: an antenna that stands must not count more."""
ROUND = Choice("It has turned all the way", "\r")
SECTORS, LEAST_SECTORS = 12, 10
LEAST_POINTS = 40
MOST_OFF = 0.1
"""Rms, as a share of the radius: 6°."""
MOST_STRETCHED = 1.5


class NotLearnt(Exception):  # noqa: N818 - the turn has not shown enough; the program has not failed
    """Why no ellipse fits, as a sentence without its full stop."""


def fitted(points: Sequence[Field]) -> tuple[Ellipse, float]:
    """The ellipse through the points, its axes ahead and to the left, and how far off it a field lies: degrees, rms.

    Raises NotLearnt.
    """
    if len(points) < LEAST_POINTS:
        raise NotLearnt("the field has hardly changed: turn the antenna further round")
    middle = tuple(math.fsum(point[part] for point in points) / len(points) for part in (0, 1))
    rows = [(x * x, y * y, x, y) for x, y in ((ahead - middle[0], left - middle[1]) for ahead, left in points)]
    matrix = [[math.fsum(row[i] * row[j] for row in rows) for j in range(4)] for i in range(4)]
    a, b, c, d = solved(matrix, [math.fsum(row[i] for row in rows) for i in range(4)])
    if min(a, b) <= 0.0:
        raise NotLearnt("the field does not go round in a ring: turn the antenna further round")
    x, y = -c / (2.0 * a), -d / (2.0 * b)
    whole = 1.0 + a * x * x + b * y * y
    ellipse = Ellipse((middle[0] + x, middle[1] + y), (math.sqrt(whole / a), math.sqrt(whole / b)))
    units = [ellipse.unit(point) for point in points]
    seen = {int((math.atan2(left, ahead) / math.tau + 0.5) * SECTORS) % SECTORS for ahead, left in units}
    if len(seen) < LEAST_SECTORS:
        raise NotLearnt(f"it has seen {len(seen)} of {SECTORS} parts of a turn: turn the antenna further round")
    off = math.sqrt(math.fsum((math.hypot(*unit) - 1.0) ** 2 for unit in units) / len(units))
    if off > MOST_OFF:
        raise NotLearnt(
            "the field does not lie on a ring: something of iron, or a motor's current, disturbs it on the way, or the "
            "board does not stay level"
        )
    if not 1.0 / MOST_STRETCHED < ellipse.radius_ut[0] / ellipse.radius_ut[1] < MOST_STRETCHED:
        raise NotLearnt("iron on the boom stretches the ring too much: mount the board further from it")
    return ellipse, math.degrees(off)


class FieldGuide(AxisGuide):
    """Call `feel` with each field that the compass measures, ahead and to the left, in µT."""

    def __init__(self, facts: AxisFacts) -> None:
        super().__init__(facts)
        self._felt: list[Field] = []

    def feel(self, field_ut: Field) -> None:
        if not self._felt or math.dist(field_ut, self._felt[-1]) >= APART_UT:
            self._felt.append(field_ut)

    def _path(self) -> Steps:
        why = "The compass learns the iron around it. The antenna has to turn through its whole range, once."
        self._lead(why, *self._phrases.introduction[1:])
        page = Question("Turn it through its whole range, once.", (why,), "between", (ROUND,))
        yield
        yield from self._await_axis()
        while True:
            accepts = "Turn it through its whole range; then Enter."
            if (yield from self._ask(f"{accepts[:-1]}:", accepts, page)) is not Word.ENTER:
                continue
            try:
                ellipse, off_deg = fitted(self._felt)
            except NotLearnt as reason:
                self._say(f"Not yet: {reason}.")
                continue
            (x, y), (a, b) = ellipse.centre_ut, ellipse.radius_ut
            learnt = (
                f"Iron adds {x:.1f} µT ahead and {y:.1f} µT to the left; the earth's field is {a:.1f} and {b:.1f} µT.",
                f"   The headings were {off_deg:.1f}° beside the ring (rms).",
            )
            self._lead(*learnt)
            if (yield from self._agrees("Save it?", "save", tuple(line.strip() for line in learnt))):
                self.result = FieldLearnt(ellipse)
            else:
                self._say(NOTHING_SAVED)
            return

    def _report(self) -> None:
        self._notices = self._axis.notices  # what the readings in degrees show means nothing yet
        super()._report()

    @property
    def _readings_count(self) -> bool:
        return False
