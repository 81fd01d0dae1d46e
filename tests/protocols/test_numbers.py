"""A number is a number however a program spells it, on every link that carries decimals as text; nothing else is one.

The oracle is Python's own `float` on the text with its comma made a point. Hamlib's own reader: tests/foreign.
"""

from __future__ import annotations

import random
from collections.abc import Callable
from typing import TYPE_CHECKING

import pytest

from rotator.exchange.orders import Aim
from rotator.protocols.console_session import ConsoleSession
from rotator.protocols.easycomm import Level
from rotator.protocols.easycomm_session import EasycommSession
from rotator.protocols.gs232 import Dialect
from rotator.protocols.gs232_session import Gs232Session
from rotator.protocols.macdoppler import MacDopplerSession
from rotator.protocols.n1mm import N1mmSession
from rotator.protocols.pstrotator import PstRotatorSession
from rotator.protocols.pstrotatoraz import PstRotatorAzSession
from rotator.protocols.rc2800 import Rc2800Session
from rotator.protocols.rotctld_session import RotctldSession
from rotator.protocols.session import Box, Session
from tests.search import examples
from tests.spelled import NO_NUMBERS, spelled
from tests.tables import every_row

if TYPE_CHECKING:
    from tests.protocols.conftest import BenchBox

SESSIONS: dict[str, tuple[Callable[[Box], Session], str]] = {
    "rotctld": (RotctldSession, "P {} {}\n"),
    "rotctld, a comma behind": (RotctldSession, "P {}, {}\n"),
    "easycomm1": (lambda box: EasycommSession(box, Level.I), "AZ{} EL{}\n"),
    "easycomm2": (lambda box: EasycommSession(box, Level.II), "AZ {} EL {}\n"),
    "macdoppler": (MacDopplerSession, "[AzEl Rotor Report:Azimuth:{}, Elevation:{}, SatName:X]"),
    "pstrotator": (PstRotatorSession, "<PST><AZIMUTH>{}</AZIMUTH><ELEVATION>{}</ELEVATION></PST>"),
    "pstrotator, track": (PstRotatorSession, "<PST><TRACK>{} {}</TRACK></PST>"),
    "console": (ConsoleSession, "point {} {}\n"),
}
AZIMUTH_ALONE: dict[str, tuple[Callable[[Box], Session], str]] = {
    "n1mm": (N1mmSession, "<N1MMRotor><rotor>x</rotor><goazi>{}</goazi></N1MMRotor>"),
    "pstrotatoraz": (PstRotatorAzSession, "GET /?az={} HTTP/1.1\r\nHost: 192.168.1.20\r\n\r\n"),
}
DIGITS_AT_FIRST: dict[str, tuple[Callable[[Box], Session], str]] = {
    # Controllers of whole degrees, where `-35` or `2e5` may be a damaged 135 or 215: a sign, and an exponent without a
    # sign, belong to a number with a decimal point.
    "gs232a": (lambda box: Gs232Session(box, Dialect.A), "W{} {}\r"),
    "rc2800": (Rc2800Session, "A{}\rE{}\r"),
}
ALL = SESSIONS | AZIMUTH_ALONE | DIGITS_AT_FIRST


def aimed(box: BenchBox, session: Session, said: str) -> tuple[float | None, float | None]:
    """Where the bytes send the antenna."""
    box.orders.clear()
    session.receive(said.encode())
    azimuth_deg = elevation_deg = None
    for order in box.orders:
        assert isinstance(order, Aim)
        azimuth_deg = azimuth_deg if order.azimuth_deg is None else order.azimuth_deg
        elevation_deg = elevation_deg if order.elevation_deg is None else order.elevation_deg
    return azimuth_deg, elevation_deg


@every_row("name", SESSIONS)
def test_each_link_reads_every_spelling(new_box: type[BenchBox], name: str) -> None:
    box = new_box(at=(235, 25))
    make, form = SESSIONS[name]
    session, seed = make(box), random.randrange(10**9)
    print(f"seed {seed}")  # noqa: T201
    rng = random.Random(seed)
    for _ in range(examples(300)):
        (azimuth, az_deg), (elevation, el_deg) = spelled(rng, 449), spelled(rng, 179)
        assert aimed(box, session, form.format(azimuth, elevation)) == (az_deg, el_deg), (azimuth, elevation)


@pytest.mark.parametrize("name", AZIMUTH_ALONE)
def test_so_does_each_with_one_bearing(box: BenchBox, name: str) -> None:
    make, form = AZIMUTH_ALONE[name]
    seed = random.randrange(10**9)
    print(f"seed {seed}")  # noqa: T201
    rng = random.Random(seed)
    for _ in range(examples(300)):
        azimuth, az_deg = spelled(rng, 359)
        if "+" in azimuth and name == "pstrotatoraz":
            continue  # a blank, in an address
        assert aimed(box, make(box), form.format(azimuth)) == (az_deg, None), azimuth


@every_row("name", DIGITS_AT_FIRST)
@every_row("text", ["45", "045", "0045", "45.0", "45.", "4.5e+01", "4.5e1", "450e-1", "45.000000000000000001"])
def test_a_controller_of_whole_degrees_reads_what_no_damage_makes(
    new_box: type[BenchBox], name: str, text: str
) -> None:
    box = new_box(at=(235, 25))
    make, form = DIGITS_AT_FIRST[name]
    assert aimed(box, make(box), form.format(text, text)) == (45.0, 45.0)


@every_row("name", ALL)
def test_what_is_no_number_moves_nothing_and_is_in_the_log(new_box: type[BenchBox], name: str) -> None:
    make, form = ALL[name]
    for text in NO_NUMBERS:
        box = new_box(at=(235, 25))
        said = form.format(text, "45") if form.count("{}") == 2 else form.format(text)
        if name == "rc2800":
            said = said.partition("\r")[0] + "\r"
        make(box).receive(said.encode())
        assert box.motions == [], text
        assert len(box.refused) == 1, text
