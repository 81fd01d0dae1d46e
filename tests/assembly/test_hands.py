"""Hands on a simulated panel: each part that the file fits moves; every other request is refused with its reason."""

from __future__ import annotations

import pytest

from firmware_sim.clock import SimClock
from firmware_sim.rotors.rotor import SimRotor
from hw.buses.gpio import GpioInputs
from hw.ports import Axis, Direction
from rotator.assembly.hands import hands
from rotator.assembly.simulation import SimulatedStation
from rotator.config.load import parse
from rotator.exchange.orders import Mode
from rotator.protocols.panel_words import Hand, StopButton, ThrowJog, TurnKnob, TurnMode

AZ, PLUS = Axis.AZIMUTH, Direction.PLUS
FITTED = "[panel]\nmode_msb = 10\nmode_lsb = 9\nstop = 19\nazimuth_knob = 0\njog = 2\n"


def world(file: str) -> tuple[SimRotor, SimClock]:
    clock = SimClock()
    return SimulatedStation(parse(file, "box"), clock, None, (0.0, 0.0)).build(), clock


def test_each_part_moves() -> None:
    rotor, clock = world(FITTED)
    move, panel = hands(rotor), rotor.panel
    assert panel is not None
    centre_v = panel.jog_v()
    moves = (TurnMode(Mode.JOG), TurnKnob(AZ, 0.5), ThrowJog(AZ, PLUS, 2.0), StopButton(True))
    assert [move(hand) for hand in moves] == ["", "", "", ""]
    switches = GpioInputs(rotor.gpio, "/dev/gpiochip0", {"msb": 10, "lsb": 9, "stop": 19}, consumer="panel")
    assert switches.read() == {"msb": True, "lsb": True, "stop": False}, "3 is JOG; pressed, the contact is open"
    assert panel.adc.inputs[0]() == pytest.approx(1.65, abs=0.02)
    assert panel.jog_v() > centre_v
    clock.sleep(2.1)
    assert panel.jog_v() == centre_v, "released after its time"
    assert move(StopButton(False)) == ""
    assert switches.read()["stop"]


@pytest.mark.parametrize(
    ("hand", "key"),
    [
        (TurnKnob(Axis.ELEVATION, 0.5), "panel.elevation_knob"),
        (TurnKnob(AZ, 0.5), "panel.azimuth_knob"),
        (ThrowJog(AZ, PLUS, 1.0), "panel.jog"),
        (StopButton(True), "panel.stop"),
    ],
)
def test_a_part_that_is_not_fitted_is_named(hand: Hand, key: str) -> None:
    rotor, _ = world("[panel]\nmode_msb = 10\nmode_lsb = 9\n")
    assert hands(rotor)(hand) == f"this panel has no such part: {key} is not in the file"


def test_without_a_panel_or_on_real_hardware_it_is_refused() -> None:
    rotor, _ = world("")
    assert hands(rotor)(StopButton(True)).startswith("this box has no front panel")
    assert hands(None)(StopButton(True)).startswith("this box is on real hardware")
