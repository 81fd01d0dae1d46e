"""The check of moteus controllers: on simulated ones, and on the files of adapters and CAN interfaces."""

from __future__ import annotations

import time
from dataclasses import replace
from pathlib import Path
from typing import NoReturn

import pytest

from firmware_sim.rotors.moteus import MoteusAxisSpec, SimMoteusRotor
from hw.ports import Axis, HardwareError
from rotator.assembly.chips import Heard, ask_controllers
from rotator.config.load import parse
from tests.doctor.conftest import Pi, runs


@pytest.fixture
def moteus(pi: Pi) -> Pi:
    pytest.importorskip("moteus", reason="moteus is missing: pip install --no-deps moteus")
    pi.kind("moteus", "[moteus.azimuth]\ngeared = false\n[moteus.elevation]\ngeared = false\n")
    pi.write("/dev/fdcanusb")
    return pi


def test_two_controllers(moteus: Pi) -> None:
    port, azimuth, elevation, by_hand = moteus.found("moteus")
    assert port.found == "/dev/fdcanusb is there and may be opened"
    assert azimuth.found.startswith("azimuth: moteus 1, 24.0 V, ")
    assert azimuth.found.endswith("°C, at 90.0°")
    assert elevation.found.startswith("elevation: moteus 2, ")
    assert by_hand.mark == "–"
    assert "servo.timeout_mode" in by_hand.found
    assert "tview" in by_hand.advice


def test_they_are_asked_and_told_nothing(moteus: Pi) -> None:
    moteus.found("moteus")
    motor = moteus.world.controller("azimuth").motor
    assert (motor.mode.name, moteus.world.antenna()) == ("STOPPED", (90.0, 45.0))


@pytest.mark.parametrize(
    ("fault", "at", "mark", "found", "advice"),
    [
        ("azimuth-over-voltage", 1, "✗", "stopped by itself: supply voltage too high (34)", "Braking feeds the supply"),
        ("elevation-silent", 2, "✗", "elevation: moteus 2 does not answer", "is its id.id 2?"),
        ("azimuth-power-cycled", 1, "!", "does not know which way", "rotator confirm azimuth DEGREES."),
    ],
)
def test_a_controller_that_needs_a_person(
    moteus: Pi, fault: str, at: int, *, mark: str, found: str, advice: str
) -> None:
    if fault == "azimuth-power-cycled":
        moteus.kind("moteus")  # behind a gear
    moteus.world.inject(fault)
    told = moteus.found("moteus")[at]
    assert told.mark == mark
    assert found in told.found
    assert advice in told.advice
    runs(moteus)
    assert moteus.only("moteus").mark == "–"


def test_too_few_volts(moteus: Pi) -> None:
    heard = dict.fromkeys(Axis, Heard(volts=8.5, angle_deg=0.0))
    moteus.change(chips=replace(moteus.machine.chips, moteus=lambda _config: heard))
    assert moteus.found("moteus")[1].ok is False


def test_an_adapter_that_is_not_there(moteus: Pi) -> None:
    moteus.remove("/dev/fdcanusb")
    moteus.write("/dev/serial/by-id/usb-mjbots_fdcanusb_1234-if00")
    finding = moteus.only("moteus")
    assert (finding.ok, finding.found) == (False, "/dev/fdcanusb is not there")
    assert finding.advice.endswith("Known by name: /dev/serial/by-id/usb-mjbots_fdcanusb_1234-if00.")


@pytest.mark.parametrize(
    ("command", "mark", "words"),
    [
        ("/usr/bin/python3\0/usr/bin/tview", "✗", "held by"),
        ("/usr/local/bin/rotator\0calibrate", "–", "the box has it"),
    ],
)
def test_an_adapter_that_somebody_has(moteus: Pi, command: str, mark: str, words: str) -> None:
    moteus.write("/proc/77/cmdline", f"{command}\0")
    descriptors = moteus.machine.at("/proc/77/fd")
    descriptors.mkdir()
    (descriptors / "5").symlink_to(moteus.machine.at("/dev/fdcanusb"))
    finding = moteus.only("moteus")
    assert finding.mark == mark
    assert words in finding.found


def test_without_the_library(moteus: Pi) -> None:
    def missing(_config: object) -> NoReturn:
        raise HardwareError("moteus: its Python package cannot be loaded (No module named 'moteus')")

    moteus.change(chips=replace(moteus.machine.chips, moteus=missing))
    finding = moteus.found("moteus")[1]
    assert finding.ok is False
    assert "pip install --no-deps 'moteus>=1.1,<2'" in finding.advice


@pytest.mark.parametrize(
    ("files", "words"),
    [
        ({}, "there is no such CAN interface"),
        ({"flags": "0x40080", "mtu": "72"}, "is down"),
        ({"flags": "0x40081", "mtu": "16"}, "without CAN FD"),
        ({"flags": "0x40081", "mtu": "72"}, "can0 is up, with CAN FD"),
    ],
)
def test_a_can_interface_of_the_kernel(moteus: Pi, files: dict[str, str], words: str) -> None:
    moteus.kind("moteus", '[moteus]\ncan = "can0"\n')
    for name, text in files.items():
        moteus.write(f"/sys/class/net/can0/{name}", f"{text}\n")
    finding = moteus.found("moteus")[0]
    assert words in finding.found
    assert (finding.mark == "✓") is (files.get("mtu") == "72" and "81" in files["flags"])


def test_over_an_adapter_in_real_time(tmp_path: Path) -> None:
    pytest.importorskip("moteus", reason="moteus is missing: pip install --no-deps moteus")
    world = SimMoteusRotor(MoteusAxisSpec(1, start_deg=130.0), MoteusAxisSpec(2), time.monotonic)
    adapter = world.adapter(tmp_path / "fdcanusb")
    config = parse(
        f'[rotor]\ntype = "moteus"\n[moteus]\nport = "{adapter.path}"\n[moteus.azimuth]\ngeared = false\n', "test"
    )
    adapter.plug()
    try:
        heard = ask_controllers(config)
    finally:
        adapter.unplug()
    assert heard[Axis.AZIMUTH].angle_deg == pytest.approx(130.0, abs=0.1)
    assert heard[Axis.ELEVATION].volts == pytest.approx(24.0)
