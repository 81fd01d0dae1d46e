"""The drawing of a pass: what is in it, where the sky's places are, and that it stays a drawing for any flight."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Sequence
from dataclasses import replace

import pytest

from rotator.control.sky.mount import Mount, Range, Sector
from rotator.rehearsal.flight import Summary
from rotator.views.pass_svg import SKY, Flown, draw
from rotator.views.sky_svg import SkySvg
from rotator.views.trace import Sample

SVG = "{http://www.w3.org/2000/svg}"
QUIET = Summary(1.0, 2.0, 3.0, relay_starts=3, motor_s=10.0)


def flight(samples: Sequence[Sample], summary: Summary = QUIET) -> Flown:
    return Flown("the antenna", "blue", samples, summary)


def crossing(off_deg: float = 1.0, seconds: int = 600) -> list[Sample]:
    """From west to east over the south, with two starts of azimuth and one of elevation."""
    return [
        Sample(
            t, 270 - t / seconds * 180, 40 * math.sin(t / seconds * math.pi), 270 - t / seconds * 180, off_deg, *drives
        )
        for t, drives in (
            (t, (int(t in range(50, 60)) - int(t in range(300, 320)), int(t == 90))) for t in range(seconds)
        )
    ]


def words(drawing: str) -> list[str]:
    return [each.text or "" for each in ET.fromstring(drawing).iter(f"{SVG}text")]


def test_each_axis_has_a_tick_for_each_click() -> None:
    drawing = draw("ISS <1>", [flight(crossing())])
    assert "2 clicks" in words(drawing)
    assert "1 click" in words(drawing)
    assert "ISS <1>" in words(drawing)
    ticks = [each.attrib["d"].count("M") for each in ET.fromstring(drawing).iter(f"{SVG}path")]
    assert ticks == [2, 1]


def test_a_motor_without_relays_has_bars_for_as_long_as_it_turned() -> None:
    drawing = draw("the Moon", [flight(crossing(), replace(QUIET, relay_starts=None))])
    assert not [word for word in words(drawing) if "click" in word]
    assert {word for word in words(drawing) if word.startswith("turned")} == {"turned 30 s", "turned 1 s"}


@pytest.mark.parametrize("long_s", [20, 600, 86_000])
def test_a_pass_of_any_length_has_a_scale_that_can_be_read_and_a_size_that_can_be_sent(long_s: int) -> None:
    samples = [Sample(t, 100.0, 30.0, 100.0, 30.0, 0, 0) for t in range(0, long_s, max(1, long_s // 20_000))]
    drawing = draw("the Sun", [flight(samples)])
    assert len(drawing) < 150_000
    assert "0 min" in words(drawing)
    assert len(words(drawing)) < 90


def test_a_swing_right_round_leaves_the_rest_of_the_errors_to_be_seen() -> None:
    calm = crossing()
    swung = [replace(each, antenna_az=each.antenna_az + 170, antenna_el=each.target_el) for each in calm[300:305]]
    near = [replace(each, antenna_el=each.target_el + 1) for each in calm]
    told = words(draw("ISS", [flight([*near[:300], *swung, *near[305:]])]))
    assert "1°" in told
    assert "0.5°" in told
    assert [word for word in told if word.endswith("° at worst")]


def test_over_the_top_and_on_the_second_turn_the_antenna_is_where_it_points() -> None:
    sky = SkySvg(0, 0, 90)
    assert sky.place((0, 0)) == pytest.approx((0, -90))
    assert sky.place((90, 60)) == pytest.approx((30, 0))
    assert sky.place((270, 120)) == pytest.approx(sky.place((90, 60)))
    assert sky.place((450, 60)) == pytest.approx(sky.place((90, 60)))


def test_trees_and_sectors_and_the_ends_of_the_turn_are_drawn_where_there_are_any() -> None:
    free = Mount(Range(0, 450), Range(0, 90))
    assert not [part for part in SKY.backdrop(free) if "<path" in part or "dasharray" in part]
    chimney = Sector("chimney", Range(200, 220), Range(0, 30), 2.0)
    fenced = Mount(Range(0, 350), Range(0, 180), horizon=((0.0, 5.0), (90.0, 20.0)), sectors=(chimney,))
    drawn = list(SKY.backdrop(fenced))
    assert sum("<path" in part for part in drawn) == 2
    assert sum("dasharray" in part for part in drawn) == 2
    assert {"trees and roofs", "forbidden"} <= set(words(draw("ISS", [flight(crossing())], fenced)))


def test_a_pass_that_never_rises_is_drawn_all_the_same() -> None:
    under = [replace(each, target_el=-5.0) for each in crossing()]
    assert words(draw("ISS", [flight(under)]))
