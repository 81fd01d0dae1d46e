"""The check of moteus controllers: on simulated ones, and on the files of adapters and CAN interfaces."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any, NoReturn

import pytest

from firmware_sim.rotors.moteus import MoteusAxisSpec, SimMoteusRotor
from hw.ports import Axis, HardwareError
from rotator.assembly.chips import Heard, ask_controllers
from rotator.config.load import parse
from tests.doctor.conftest import Pi
from tests.doctor.rows import Row, named, of

pytest.importorskip("moteus", reason="moteus is missing: pip install --no-deps moteus")

GEARLESS = "[moteus.azimuth]\ngeared = false\n[moteus.elevation]\ngeared = false\n"
BY_ID = "/dev/serial/by-id/usb-mjbots_fdcanusb_1234-if00"
CAN0 = "/sys/class/net/can0/"


def row(
    found: str, more: str = GEARLESS, files: dict[str, str | None] | None = None, broken: str = "", **others: Any
) -> Row:
    return Row("moteus", found, of("moteus"), more, files or {"/dev/fdcanusb": ""}, broken=broken, **others)


def can(found: str, **files: str) -> Row:
    return row(found, '[moteus]\ncan = "can0"\n', {f"{CAN0}{name}": f"{text}\n" for name, text in files.items()})


def asked(answer: Callable[[object], Any]) -> Callable[[Pi], None]:
    """What the controllers answer, or the library."""
    return lambda pi: pi.change(chips=replace(pi.machine.chips, moteus=answer))


def missing(_config: object) -> NoReturn:
    raise HardwareError("moteus: its Python package cannot be loaded (No module named 'moteus')")


def held(pi: Pi) -> None:
    descriptors = pi.machine.at("/proc/77/fd")
    descriptors.mkdir()
    (descriptors / "5").symlink_to(pi.machine.at("/dev/fdcanusb"))


def asked_and_not_told(pi: Pi) -> None:
    pi.found("moteus")
    assert (pi.world.controller("azimuth").motor.mode.name, pi.world.antenna()) == ("STOPPED", (90.0, 45.0))


@pytest.mark.parametrize(
    "row",
    [
        row("✓ /dev/fdcanusb is there and may be opened → \n✓ azimuth: moteus 1, 24.0 V, ", spoil=asked_and_not_told),
        row("°C, at 90.0° → \n✓ elevation: moteus 2, "),
        row("– servo.timeout_mode, servopos.position_min and position_max cannot be asked for from here → Look once"),
        row("stopped by itself: supply voltage too high (34) → Braking feeds", broken="azimuth-over-voltage"),
        row("✗ elevation: moteus 2 does not answer", broken="elevation-silent"),
        row("is its id.id 2? As sold all are 1.", broken="elevation-silent"),
        row("rotator confirm azimuth DEGREES.", "", broken="azimuth-power-cycled"),
        row("– the box is running", is_running=True),
        row(
            "✗ azimuth: moteus 1, 8.5 V, 0 °C, which is too little",
            spoil=asked(lambda _config: dict.fromkeys(Axis, Heard(volts=8.5, angle_deg=0.0))),
        ),
        row("pip install --no-deps 'moteus>=1.1,<2'", spoil=asked(missing)),
        row(f"Known by name: {BY_ID}.", files={BY_ID: ""}),
        row("✗ /dev/fdcanusb is not there", files={BY_ID: ""}),
        row(
            "✗ /dev/fdcanusb is held by",
            files={"/dev/fdcanusb": "", "/proc/77/cmdline": "/usr/bin/python3\0/usr/bin/tview\0"},
            spoil=held,
        ),
        row(
            "– /dev/fdcanusb: the box has it",
            files={"/dev/fdcanusb": "", "/proc/77/cmdline": "/usr/local/bin/rotator\0calibrate\0"},
            spoil=held,
        ),
        can("✗ can0: there is no such CAN interface"),
        can("✗ can0 is down", flags="0x40080", mtu="72"),
        can("✗ can0 is up without CAN FD", flags="0x40081", mtu="16"),
        can("✓ can0 is up, with CAN FD", flags="0x40081", mtu="72"),
    ],
    ids=named,
)
def test_what_is_found(pi: Pi, row: Row) -> None:
    row.judge(pi)


def test_over_an_adapter_in_real_time(tmp_path: Path) -> None:
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
