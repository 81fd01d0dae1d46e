"""A USB cable with a serial port at each end: /dev/ttyGS0, the box's, and /dev/ttyACM0, the PC's.

Knows how Linux makes a USB serial gadget (configfs) and how its virtual cable (dummy_hcd) is pulled. Knows nothing of
what is said over it.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import Self

from tests.kernel.bench.waiting import until

GADGETS = Path("/sys/kernel/config/usb_gadget")
CONTROLLER = "dummy_udc.0"
USB_DEVICES = Path("/sys/bus/usb/devices")
ACM = Path("/sys/class/tty")


class UsbSerialCable:
    """The cable, plugged in. Identity as in the recipe for a Raspberry Pi: a plain port that Windows takes as such."""

    vendor, product, serial = 0x1D6B, 0x0104, "GS232-0001"

    def __init__(self) -> None:
        self.box = "/dev/ttyGS0"
        self._gadget = GADGETS / "bench"
        self._build()
        (self._gadget / "UDC").write_text(CONTROLLER)
        self._device = until(self._found, "the gadget on the PC's bus")[0]
        until(lambda: os.access(self.box, os.R_OK), self.box)
        self.pc = self._await_pc()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    def pull(self) -> None:
        """The PC lets go of the device, as when the plug is drawn."""
        (self._device / "authorized").write_text("0")
        until(lambda: not self._ports(), "the end of the PC's port")

    def plug(self) -> str:
        """The PC's port, which may have another number now."""
        (self._device / "authorized").write_text("1")
        self.pc = self._await_pc()
        return self.pc

    def close(self) -> None:
        (self._gadget / "UDC").write_text("\n")
        (self._gadget / "configs/c.1/acm.usb0").unlink()
        for folder in ("configs/c.1/strings/0x409", "configs/c.1", "functions/acm.usb0", "strings/0x409", "."):
            (self._gadget / folder).rmdir()
        until(lambda: not self._ports(), "the end of the PC's port")

    def _build(self) -> None:
        self._gadget.mkdir()
        for name, value in {
            "idVendor": f"0x{self.vendor:04x}",
            "idProduct": f"0x{self.product:04x}",
            "bDeviceClass": "2",
            "bDeviceSubClass": "2",
            "strings/0x409/serialnumber": self.serial,
            "strings/0x409/manufacturer": "gs232-rotator",
            "strings/0x409/product": "GS-232 serial port",
            "configs/c.1/strings/0x409/configuration": "serial",
        }.items():
            path = self._gadget / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(value)
        function = self._gadget / "functions/acm.usb0"
        function.mkdir()
        (self._gadget / "configs/c.1/acm.usb0").symlink_to(function)

    def _found(self) -> list[Path]:
        serials = USB_DEVICES.glob("*/serial")
        return [serial.parent for serial in serials if serial.read_text().strip() == self.serial]

    def _ports(self) -> list[str]:
        # devtmpfs names a port as soon as the kernel knows it.
        return sorted(path.name for path in ACM.glob("ttyACM*"))

    def _await_pc(self) -> str:
        name = until(self._ports, "the PC's port")[0]
        path = f"/dev/{name}"
        until(lambda: os.access(path, os.R_OK | os.W_OK), path)
        return path
