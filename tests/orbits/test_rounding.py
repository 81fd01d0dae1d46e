"""How a program's orders are rounded: Hamlib's clients hold them in single precision, and send six decimals of that."""

from __future__ import annotations

import struct
from collections.abc import Callable

import pytest

from rotator.exchange.sources import Source
from rotator.orbits.catalogue import Catalogue
from rotator.orbits.recognition import Recognised, StreamWatch
from rotator.orbits.stream_fit import FINEST_DEG, Heard, rounding_deg
from rotator.orbits.targets import find
from tests.orbits.streams import orders, path_of
from tests.tables import every_row
from tests.tracking.tracked_box import BERLIN, ELEMENTS, pass_of

HAMLIB = Source("rotctld", 1)


def as_sent(angle_deg: float) -> float:
    """As `P` of Hamlib's NET rotctl has it."""
    (single,) = struct.unpack("f", struct.pack("f", angle_deg))
    return float(f"{single:f}")


@every_row("digits", [0, 1, 2])
@every_row("sent", [float, as_sent])
def test_the_rounding_of_any_angle_is_found(digits: int, sent: Callable[[float], float]) -> None:
    step = 10.0**-digits
    for first in range(0, 3600, 7):
        told = [
            Heard(0.0, sent(round((first + at) * step % 360, digits)), sent(round(at * step, digits)))
            for at in range(1, 9)
        ]
        assert rounding_deg(told) == pytest.approx(max(step, FINEST_DEG))


LATE_S = (0.0, 0.3, 0.1, 0.2)
"""So late its orders come, one after the other."""


@every_row(("name", "digits"), [("iss", 0), ("iss", 1), ("iss", 2), ("so-50", 0), ("so-50", 1), ("rs-44", 1)])
@every_row("after_s", [130.0, 250.0])
def test_a_stream_of_hamlib_is_recognised(name: str, digits: int, after_s: float) -> None:
    satellite = find(name, BERLIN, Catalogue((str(ELEMENTS),)))
    rises_s = pass_of(name).aos_s
    assert rises_s is not None
    watch, begin_s = StreamWatch([satellite]), rises_s + after_s
    stream = orders(path_of(satellite), begin_s, 30, lambda deg: as_sent(round(deg, digits)))
    news = [watch.hear(HAMLIB, aim, begin_s + second + LATE_S[second % 4]) for second, aim in enumerate(stream)]
    assert any(isinstance(each, Recognised) for each in news)
