"""Every kind of fault has its texts and codes; every protocol that has a word for faults tells of each of them."""

from __future__ import annotations

import pytest

from hw.ports import Axis
from rotator.exchange.faults import Fault, FaultKind, Missing
from rotator.exchange.status import AxisStatus
from rotator.protocols.easycomm import Level
from rotator.protocols.easycomm_session import EasycommSession
from tests.protocols.fed import Notebook

EACH = pytest.mark.parametrize("kind", FaultKind, ids=lambda kind: kind.text)
FAULT_BIT = 8
"""Of EasyComm's status register."""


def answers(azimuth: AxisStatus) -> tuple[int, int]:
    """What EasyComm III answers to GS and GE."""
    state, errors = EasycommSession(Notebook(azimuth), Level.III).receive(b"GS\nGE\n")
    return int(state.decode().removeprefix("GS")), int(errors.decode().removeprefix("GE"))


@EACH
def test_easycomm_tells_of_it_in_both_registers(kind: FaultKind) -> None:
    state, errors = answers(AxisStatus(0.0, 450.0, angle_deg=100.0, fault=Fault(kind, Axis.AZIMUTH, "measured")))
    assert state & FAULT_BIT
    assert errors == kind.easycomm != 0


def test_without_a_fault_both_registers_are_clear() -> None:
    assert answers(AxisStatus(0.0, 450.0, angle_deg=100.0)) == (1, 0)


@pytest.mark.parametrize("missing", Missing, ids=lambda missing: missing.text)
def test_easycomm_tells_that_an_axis_is_not_commissioned(missing: Missing) -> None:
    assert answers(AxisStatus(0.0, 450.0, missing=(missing,)))[1] == 4


@EACH
def test_its_text_for_the_display_fits_beside_the_axis(kind: FaultKind) -> None:
    assert 0 < len(kind.lcd) <= len("STANDS STILL ")
    assert kind.lcd == kind.lcd.upper()


def test_no_two_have_the_same_texts() -> None:
    assert len({kind.text for kind in FaultKind}) == len({kind.lcd for kind in FaultKind}) == len(FaultKind)
