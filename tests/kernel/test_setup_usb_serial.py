"""`rotator setup usb-serial --up` and `--down` in a real configfs: what the PC sees, and what they leave behind."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
import serial
from serial.tools import list_ports

from rotator.setup.gadget import Identity, down, up
from rotator.setup.plan import SetupError
from tests.kernel.bench.usb_serial import CONTROLLER, GADGETS
from tests.kernel.bench.waiting import PATIENCE_S, until
from tests.kernel.test_usb_serial import POSITION, Box

CONFIGFS, CONTROLLERS = GADGETS.parent, Path("/sys/class/udc")
IDENTITY = Identity("10000000abcdef01")
GADGET = GADGETS / "rotator"


@pytest.fixture(autouse=True)
def taken_down() -> Iterator[None]:
    yield
    down(CONFIGFS)
    until(lambda: not ports(), "the end of the PC's port")


def ports() -> list[str]:
    return [port.device for port in list_ports.comports() if port.device.startswith("/dev/ttyACM")]


def pc() -> str:
    return until(ports, "the PC's port")[0]


def setup(*words: str) -> str:
    command = [sys.executable, "-m", "rotator", "setup", "usb-serial", *words]
    done = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE_S, check=False)
    return done.stdout + done.stderr


def test_the_command_the_unit_runs() -> None:
    assert setup("--up", "--usb-id", "1209:0001") == f"USB serial port on {CONTROLLER}\n"
    device = pc()
    (port,) = [port for port in list_ports.comports() if port.device == device]
    assert (port.vid, port.pid, port.product) == (0x1209, 0x0001, "GS-232 Rotator")
    assert port.serial_number
    assert setup("--down") == ""
    until(lambda: not ports(), "the end of the PC's port")
    assert not GADGET.exists()


def test_the_class_that_windows_takes_as_a_port() -> None:
    up(CONFIGFS, CONTROLLERS, IDENTITY)
    port = Path("/sys/class/tty", Path(pc()).name, "device/..").resolve()
    said = {name: (port / name).read_text().strip() for name in ("bDeviceClass", "bDeviceSubClass", "serial")}
    assert said == {"bDeviceClass": "02", "bDeviceSubClass": "02", "serial": IDENTITY.serial}


def test_question_and_answer() -> None:
    up(CONFIGFS, CONTROLLERS, IDENTITY)
    device = pc()
    box = Box("/dev/ttyGS0")
    try:
        until(lambda: box.wire.state == "open", "the box's port open")
        with serial.Serial(device, 9600, timeout=PATIENCE_S) as port:
            port.write(b"C2\r")
            assert port.read(len(POSITION)) == POSITION
        # The box has the port open still: taking it away may not hang, and the link waits for it to come back.
        down(CONFIGFS)
        until(lambda: box.wire.state == "waiting for it", "the loss")
        up(CONFIGFS, CONTROLLERS, IDENTITY)
        until(lambda: box.wire.state == "open", "the box's port open again")
        with serial.Serial(pc(), 9600, timeout=PATIENCE_S) as port:
            port.write(b"C2\r")
            assert port.read(len(POSITION)) == POSITION
    finally:
        box.close()


def test_a_kernel_that_refuses_leaves_nothing_behind(tmp_path: Path) -> None:
    # A name under which it has no controller: it refuses at the very last step, and 6.1 says EBUSY of that.
    (tmp_path / "no_such_udc").mkdir()
    with pytest.raises(SetupError, match=r"cannot be built|is taken by another USB gadget"):
        up(CONFIGFS, tmp_path, IDENTITY)
    assert not GADGET.exists()
