"""`[compass] at_start`: the ISEL rotor after power-on, with a compass on the boom, in simulated time."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import pytest

pytest.importorskip("moteus", reason="moteus is missing: pip install --no-deps moteus")

from rotator.assembly.calibration import open_compass
from rotator.calibrating.at_start import CompassAtStart
from rotator.calibrating.compass import CompassReader
from rotator.calibrating.compass_guide import SAMPLES
from rotator.calibrating.facts import north_facts
from rotator.config.load import ConfigError, parse
from rotator.exchange.orders import Aim, Confirm
from rotator.exchange.sources import Source
from tests.rotors.rig import AZ, EL, KINDS, PERSON, Box

ISEL = next(kind for kind in KINDS if kind.profile == "isel")
LEARNT_S = 16.0
"""The simulated compass has found its own errors by then."""


class Bench:
    def __init__(self, azimuth_deg: float, start_deg: tuple[float, float] | None = None, **tables: Any) -> None:
        compass = {"kind": "bno055", "at_start": True}
        mount = {"declination_deg": 4.0}
        self.box = Box(ISEL, start_deg or (azimuth_deg, 5.0), compass=compass, mount=mount, **tables)
        reader = open_compass(self.box.config, self.box.station.board)
        self.compass = CompassReader(reader, self.box.clock, None)
        self.start = CompassAtStart(north_facts(self.box.config, has_file=False))
        self.box.world.inject("azimuth-power-cycled")
        self.box.run(0.5)

    def wait(self, seconds: float) -> None:
        end_s = self.box.clock() + seconds
        while self.box.clock() < end_s:
            if self.start.wanted(self.box.status):
                self.compass.read()
                assert self.compass.latest is not None
                order = self.start.see(self.compass.latest, self.box.status)
                if order is not None:
                    self.box.order(order, by=Source("compass"))
            self.box.run(0.1)


@pytest.fixture
def bench() -> Iterator[Callable[..., Bench]]:
    opened: list[Bench] = []

    def make(azimuth_deg: float, **tables: Any) -> Bench:
        opened.append(Bench(azimuth_deg, **tables))
        return opened[-1]

    yield make
    for each in opened:
        each.box.close()


@pytest.mark.long
@pytest.mark.parametrize("azimuth_deg", [120.0, 200.0, 340.0])
def test_after_power_on_the_azimuth_knows_where_it_stands_and_nothing_turned(
    bench: Callable[..., Bench], azimuth_deg: float
) -> None:
    at = bench(azimuth_deg)
    assert at.box.axis(AZ).fault
    at.wait(LEARNT_S + 10.0)
    assert at.box.axis(AZ).fault is None
    assert at.box.axis(AZ).angle_deg == pytest.approx(azimuth_deg, abs=0.1), "the encoder gives the rest"
    assert at.box.boom_deg(AZ) == pytest.approx(azimuth_deg, abs=0.01)
    at.box.order(Aim(azimuth_deg - 20.0, 10.0))
    at.box.until_it_stands()
    assert (at.box.boom_deg(AZ), at.box.boom_deg(EL)) == pytest.approx((azimuth_deg - 20.0, 10.0), abs=0.05)


@pytest.mark.long
@pytest.mark.parametrize(
    ("elevation_deg", "limits", "known"),
    [
        (0.0, {}, True),
        (2.0, {"min_deg": -3}, True),
        (50.0, {}, True),
        (89.0, {}, True),
        (89.0, {"max_deg": 95}, True),
        (50.0, {"max_deg": 180}, False),
        (20.0, {"min_deg": -30}, False),
    ],
)
def test_gravity_tells_the_elevation_where_its_range_leaves_no_choice(
    bench: Callable[..., Bench], elevation_deg: float, limits: dict[str, float], known: bool
) -> None:
    at = bench(200.0, elevation=limits, start_deg=(200.0, elevation_deg))
    at.box.world.inject("elevation-power-cycled")
    at.box.run(0.5)
    assert at.box.axis(EL).fault
    at.wait(15.0)
    assert (at.box.axis(EL).fault is None) == known
    assert known or "no single place" in at.start.trouble
    assert at.box.boom_deg(EL) == pytest.approx(elevation_deg, abs=0.01), "nothing turned"
    if known:
        assert at.box.axis(EL).angle_deg == pytest.approx(elevation_deg, abs=0.1), "the encoder gives the rest"


@pytest.mark.long
@pytest.mark.parametrize(
    ("azimuth_deg", "says", "tables"),
    [
        (45.0, "45° or 405°", {}),
        (405.0, "45° or 405°", {}),
        (2.0, "or 36", {"azimuth": {"max_deg": 360}}),
    ],
)
def test_where_the_compass_leaves_a_choice_it_waits_for_a_person(
    bench: Callable[..., Bench], azimuth_deg: float, says: str, tables: dict[str, Any]
) -> None:
    at = bench(azimuth_deg, **tables)
    at.wait(LEARNT_S + 10.0)
    assert at.box.axis(AZ).fault
    assert says in at.start.trouble.replace("1°", "0°") or says in at.start.trouble


def test_a_compass_that_has_not_learnt_settles_nothing(bench: Callable[..., Bench]) -> None:
    at = bench(200.0)
    at.wait(7.0)
    assert at.box.axis(AZ).fault
    assert "knows its own error too little" in at.start.trouble


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ('[rotor]\ntype = "moteus"\n[compass]\nat_start = true\n', "needs a compass"),
        ('[compass]\nkind = "bno055"\nat_start = true\n[mount]\ndeclination_deg = 1\n', "rotor.type = moteus"),
        ('[rotor]\ntype = "moteus"\n[compass]\nkind = "bno055"\nat_start = true\n', "declination_deg"),
    ],
)
def test_a_file_that_cannot_mean_it_is_refused(text: str, why: str) -> None:
    with pytest.raises(ConfigError, match=why):
        parse(text, "test")


def test_where_a_person_was_faster_the_compass_is_asked_no_more(bench: Callable[..., Bench]) -> None:
    at = bench(120.0)
    at.box.run(LEARNT_S + 1.0)
    at.compass.read()
    assert at.compass.latest is not None
    at.box.order(Confirm(AZ, 120.0), by=PERSON)
    at.box.run(1.0)
    assert at.box.axis(AZ).fault is None
    assert [at.start.see(at.compass.latest, at.box.status) for _ in range(SAMPLES + 1)] == [None] * (SAMPLES + 1)
