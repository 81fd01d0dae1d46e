"""What the doctor reads from the running box: its faults count as errors, what holds it as warnings."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from hw.ports import AngleSource, Axis
from rotator.doctor.machine import Silent
from rotator.doctor.running import running_box
from rotator.exchange.faults import Fault, FaultKind, Missing, Notice
from rotator.exchange.orders import Mode
from rotator.exchange.status import AxisStatus, Status
from rotator.protocols.status_object import as_object
from tests.doctor.conftest import Pi

HEALTHY = Status(0.0, AxisStatus(0.0, 450.0, 20.0), AxisStatus(0.0, 180.0, 10.0, source=AngleSource.COUNTED))
FAULT = Fault(FaultKind.POT_OPEN, Axis.AZIMUTH, "reads 0.000", "0.02 to 0.98")


def told(pi: Pi, answer: Any) -> list[tuple[str, str]]:
    pi.change(ask_box=lambda: as_object(answer) if isinstance(answer, Status) else answer)
    return [(str(each.mark), each.found) for each in running_box(pi.machine)]


@pytest.mark.parametrize(
    ("answer", "found"),
    [
        (None, ("✓", "none runs now")),
        ("you may not use /run/rotator/console: use sudo", ("–", "you may not use /run/rotator/console: use sudo")),
        (
            Silent("the box does not answer within 5 s"),
            ("✗", "the box does not answer within 5 s: it stands still, and takes no stop"),
        ),
        (HEALTHY, ("✓", "it runs, and no axis has a fault")),
        (replace(HEALTHY, azimuth=replace(HEALTHY.azimuth, fault=FAULT)), ("✗", str(FAULT))),
        (replace(HEALTHY, latched="console#4"), ("!", "stopped by a rotator command: nothing moves until resume")),
        (
            replace(HEALTHY, latched="console#4", storm=True),
            ("!", "storm park by a rotator command: nothing else moves it until resume"),
        ),
        (replace(HEALTHY, mode=Mode.PARK), ("!", "the panel's switch is at PARK: programs move nothing")),
        (
            replace(HEALTHY, notices=("orders from x are ignored",)),
            ("!", "orders from x are ignored"),
        ),
        (
            replace(HEALTHY, elevation=replace(HEALTHY.elevation, missing=(Missing.HOMING,))),
            ("!", "elevation needs homing"),
        ),
        (
            replace(HEALTHY, elevation=replace(HEALTHY.elevation, notices=(Notice("motor hot"),))),
            ("!", "elevation: motor hot"),
        ),
    ],
)
def test_one_thing(pi: Pi, answer: Any, found: tuple[str, str]) -> None:
    assert told(pi, answer) == [found]


def test_all_of_it(pi: Pi) -> None:
    faulty = replace(HEALTHY.elevation, fault=replace(FAULT, axis=Axis.ELEVATION))
    ill = replace(HEALTHY, azimuth=replace(HEALTHY.azimuth, fault=FAULT), elevation=faulty, latched="panel")
    assert [mark for mark, _ in told(pi, ill)] == ["✗", "✗", "!"]
