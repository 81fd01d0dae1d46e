"""The boom's error at each point of a sky calibration, as a drawing (SVG): before, and with the new model.

At each point's place on the sky an enlarged arrow leads from the boom's intended direction to the target. Knows points
and models. Does not know how a model is found.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from rotator.control.sky.model_fit import Miss, SkyPoint, rms_deg
from rotator.control.sky.pointing_model import PointingModel
from rotator.views.sky_svg import SkySvg, document, dot, line, text

WIDTH, HEIGHT = 820, 720
SKY = SkySvg(430, 370, 300)
LONGEST_PX = 90
"""The length of the longest arrow."""
SCALES_DEG = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 30.0)


def residual_svg(points: Sequence[SkyPoint], before: PointingModel, after: PointingModel) -> str:
    was, left = ([point.miss(model) for point in points] for model in (before, after))
    longest_deg = max((math.hypot(*miss) for miss in (*was, *left)), default=0.0)
    scale_deg = next(scale for scale in SCALES_DEG if longest_deg <= 1.02 * scale or scale == SCALES_DEG[-1])
    degree_px = LONGEST_PX / scale_deg
    parts = [*SKY.backdrop()]
    places = [SKY.place((point.azimuth_deg, point.elevation_deg)) for point in points]
    for number, place in enumerate(places, start=1):
        parts += [dot(place, 5, "ink", "paper"), text(place[0] + 9, place[1] + 20, f"{number}", "start", "faint")]
    for misses, colour, width in ((was, "red", 2.0), (left, "blue", 3.0)):
        for point, miss in zip(points, misses, strict=True):
            parts.append(_arrow(point, miss, degree_px, colour, width))
    parts += _legend(points, before, after, scale_deg)
    return document(WIDTH, HEIGHT, "How far off the boom is at each point", parts)


def _arrow(point: SkyPoint, miss: Miss, degree_px: float, colour: str, width: float) -> str:
    """An arrow for an error to the right and upward, as seen from the station, on a sky seen from below, north up."""
    right, above = (part * degree_px for part in miss)
    angle = math.radians(point.azimuth_deg)
    x, y = SKY.place((point.azimuth_deg, point.elevation_deg))
    # To the right: along the circle clockwise. Upward: towards the middle.
    end = x + right * math.cos(angle) - above * math.sin(angle), y + right * math.sin(angle) + above * math.cos(angle)
    return line([(x, y), end], colour, width)


def _legend(points: Sequence[SkyPoint], before: PointingModel, after: PointingModel, scale_deg: float) -> Iterator[str]:
    lines = (("red", f"now: {rms_deg(points, before):.2f}° rms"), ("blue", f"then: {rms_deg(points, after):.2f}° rms"))
    for row, (colour, words) in enumerate(lines):
        y = 28 + row * 26
        yield line([(26, y - 6), (58, y - 6)], colour, 4)
        yield text(70, y, words)
    yield line([(26, HEIGHT - 26), (26 + LONGEST_PX, HEIGHT - 26)], "ink", 2)
    yield text(26 + LONGEST_PX + 10, HEIGHT - 20, f"{scale_deg:g}°", "start", "faint")
