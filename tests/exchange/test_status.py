"""The angle as programs and people are told it: the noise of an end stop is that end, and a true place is told."""

from __future__ import annotations

import random
import re
from collections.abc import Callable

import pytest

from rotator.exchange.status import AxisStatus
from rotator.protocols.console_session import ConsoleSession
from rotator.protocols.dcu1 import Dcu1Session
from rotator.protocols.easycomm import Level
from rotator.protocols.easycomm_session import EasycommSession
from rotator.protocols.pstrotator import PstRotatorSession
from rotator.protocols.rotctld_session import RotctldSession
from rotator.protocols.session import Box, Session
from tests.protocols.fed import Notebook
from tests.tables import every_row


def standing(azimuth_deg: float, elevation_deg: float, noise_deg: float = 0.1) -> Notebook:
    """A box whose axes read these angles."""
    return Notebook(
        AxisStatus(0.0, 360.0, angle_deg=azimuth_deg, noise_deg=noise_deg),
        AxisStatus(0.0, 90.0, angle_deg=elevation_deg, noise_deg=noise_deg),
    )


SESSIONS: dict[str, tuple[Callable[[Box], Session], bytes]] = {
    "rotctld": (RotctldSession, b"p\n"),
    "easycomm": (lambda box: EasycommSession(box, Level.II), b"AZ EL \n"),
    "easycomm for PstRotator": (lambda box: EasycommSession(box, Level.II, pstrotator=True), b"AZ EL \n"),
    "pstrotator": (PstRotatorSession, b"<PST>AZ?EL?</PST>"),
    "dcu1": (Dcu1Session, b"BI1;"),
    "console": (ConsoleSession, b"status\n"),
}


def told(name: str, box: Box) -> list[float]:
    """The angles of an answer, in its order."""
    make, question = SESSIONS[name]
    answer = b"".join(make(box).receive(question)).decode()
    assert "-0.0" not in re.sub(r"-0\.0\d*[1-9]", "", answer), "minus nothing"
    return [float(number) for number in re.findall(r"-?\d+\.\d+", answer)]


@every_row("name", SESSIONS)
def test_noise_on_the_horizon_has_no_sign(name: str) -> None:
    scatter = random.Random(1)
    for _ in range(2000):
        box = standing(scatter.gauss(0.0, 0.1), scatter.gauss(0.0, 0.1))
        for angle_deg in told(name, box):
            assert 0.0 <= angle_deg < 1.0, "neither below the end nor a turn away from it"


@every_row("name", ["rotctld", "easycomm", "easycomm for PstRotator", "pstrotator", "console"])
@every_row(("noise_deg", "angle_deg"), [(0.1, -0.6), (0.02, -0.2), (0.1, -3.0), (0.0, -0.1)])
def test_an_antenna_below_its_end_is_told_below(name: str, noise_deg: float, angle_deg: float) -> None:
    assert told(name, standing(90.0, angle_deg, noise_deg))[1] == pytest.approx(angle_deg, abs=0.051)


@every_row(("noise_deg", "angle_deg", "shown_deg"), [
    (0.1, 450.3, 450.0), (0.1, 450.6, 450.6), (0.1, -0.4, 0.0), (0.1, 12.34, 12.34), (0.1, 449.7, 449.7),
    (1.5, -0.9, 0.0), (1.5, -1.1, -1.1), (0.0, -1e-9, -1e-9), (0.0, 0.0, 0.0),
])  # fmt: skip
def test_both_ends(noise_deg: float, angle_deg: float, shown_deg: float) -> None:
    """However much a reading scatters, more than a degree beyond the end is a place of its own."""
    assert AxisStatus(0.0, 450.0, angle_deg=angle_deg, noise_deg=noise_deg).shown_deg == shown_deg


def test_a_place_that_is_not_known_stays_unknown() -> None:
    assert AxisStatus(0.0, 450.0).shown_deg is None
