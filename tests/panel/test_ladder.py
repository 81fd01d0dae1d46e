"""The ladder of resistors behind the jog switches: which share of the supply is which throw."""

from __future__ import annotations

from itertools import pairwise

from hw.ports import Direction
from rotator.panel.ladder import HALF_BAND, LEVELS, level, thrown
from tests.panel.person import MINUS, OFF, PLUS
from tests.tables import every_row


def test_the_ladder_s_levels_are_those_of_its_description() -> None:
    described = {
        (MINUS, MINUS): 0.232, (MINUS, OFF): 0.288, (OFF, MINUS): 0.353, (MINUS, PLUS): 0.426, (OFF, OFF): 0.500,
        (PLUS, MINUS): 0.574, (OFF, PLUS): 0.647, (PLUS, OFF): 0.712, (PLUS, PLUS): 0.768,
    }  # fmt: skip
    assert {throw: round(share, 3) for throw, share in LEVELS.items()} == described


def test_no_two_bands_meet() -> None:
    assert min(high - low for low, high in pairwise(sorted(LEVELS.values()))) > 2 * HALF_BAND


@every_row("throw", LEVELS)
def test_a_band_is_as_wide_as_resistors_of_one_percent_and_a_supply_3_percent_off(
    throw: tuple[Direction, Direction],
) -> None:
    share = level(throw)
    worst = 2 * 0.01 * share * (1 - share) + 0.03 * share
    if throw != (PLUS, PLUS):  # two at once may fall out of their band: that is no jog either
        assert thrown(share - worst * 0.99) == thrown(share + worst * 0.99) == throw


@every_row("share", [0.0, 0.1, 0.32, 0.39, 0.46, 0.54, 0.61, 0.68, 0.9, 1.0, 1.05])
def test_a_reading_between_bands_or_at_an_end_is_nothing(share: float) -> None:
    assert thrown(share) is None
