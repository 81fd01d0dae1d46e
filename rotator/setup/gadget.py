"""Builds and removes the USB device: one serial port (CDC ACM) in the kernel's configfs, on the Pi's USB controller.

Knows the layout of configfs/usb_gadget (Documentation/usb/gadget_configfs.rst in the kernel's source). Class 02 and
subclass 02 on the device make Windows 10 and 11 take their own usbser.sys, without an INF file. The serial number
makes Windows give the same COM number again, at any socket of the PC.
"""

from __future__ import annotations

import errno
import os
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from rotator.setup.plan import SetupError

NAME = "rotator"
FUNCTION = "acm.usb0"
ENGLISH = "strings/0x409"
CONFIGURATION = "configs/c.1"

LINUX_FOUNDATION, COMPOSITE = 0x1D6B, 0x0104


@dataclass(frozen=True, slots=True)
class Identity:
    """The identity that the device shows to the PC."""

    serial: str
    vendor: int = LINUX_FOUNDATION
    product: int = COMPOSITE

    def attributes(self) -> dict[str, str]:
        return {
            "idVendor": f"0x{self.vendor:04x}",
            "idProduct": f"0x{self.product:04x}",
            "bcdDevice": "0x0100",
            "bDeviceClass": "0x02",
            "bDeviceSubClass": "0x02",
            "bDeviceProtocol": "0x00",
            f"{ENGLISH}/serialnumber": self.serial,
            f"{ENGLISH}/manufacturer": "gs232-rotator",
            f"{ENGLISH}/product": "GS-232 Rotator",
            f"{CONFIGURATION}/{ENGLISH}/configuration": "serial port",
            f"{CONFIGURATION}/bmAttributes": "0x80",
            f"{CONFIGURATION}/MaxPower": "500",
        }


def up(configfs: Path, controllers: Path, identity: Identity, rmdir: Callable[[Path], None] = os.rmdir) -> str:
    """Build the device and bind it to the first controller. Returns the controller's name.

    A complete device stays as it is; a half-built one is removed first. `configfs` is usually /sys/kernel/config,
    `controllers` /sys/class/udc. Raises SetupError if there is no controller or another device has it; then no part
    of the device remains.
    """
    if not (configfs / "usb_gadget").is_dir():
        raise SetupError(f"{configfs}/usb_gadget is missing: run `sudo modprobe libcomposite` first")
    names = sorted(each.name for each in controllers.iterdir()) if controllers.is_dir() else []
    if not names:
        raise SetupError(
            "no USB device controller: run `sudo rotator setup usb-serial`, reboot, and try again; "
            "see `dmesg | grep dwc2`"
        )
    controller = names[0]
    gadget = configfs / "usb_gadget" / NAME
    if _reads(gadget / "UDC") == controller and _is_whole(gadget, identity):
        return controller
    _refuse_a_second(configfs, controllers, controller)
    down(configfs, rmdir)
    try:
        _build(gadget, identity)
        (gadget / "UDC").write_text(controller)
    except OSError as fault:
        with suppress(SetupError):
            down(configfs, rmdir)
        if fault.errno == errno.EBUSY:
            raise _busy(controller, _reads(controllers / controller / "function")) from fault
        raise SetupError(f"the USB device cannot be built: {fault.strerror}: {fault.filename}") from fault
    return controller


def down(configfs: Path, rmdir: Callable[[Path], None] = os.rmdir) -> None:
    """Unbind the device and remove it, also a half-built one. Raises SetupError."""
    gadget = configfs / "usb_gadget" / NAME
    if not gadget.is_dir():
        return
    try:
        if _reads(gadget / "UDC"):
            (gadget / "UDC").write_text("\n")
        for link in gadget.glob("configs/*/*"):
            if link.is_symlink():
                link.unlink()
        # configfs removes only folders without inner ones; it removes the folders that it made by itself.
        for pattern in ("configs/*/strings/*", "configs/*", "functions/*", "strings/*"):
            for folder in gadget.glob(pattern):
                rmdir(folder)
        rmdir(gadget)
    except OSError as fault:
        raise SetupError(f"the USB device cannot be taken down: {fault.strerror}: {fault.filename}") from fault


def _build(gadget: Path, identity: Identity) -> None:
    for folder in ("", ENGLISH, CONFIGURATION, f"{CONFIGURATION}/{ENGLISH}", f"functions/{FUNCTION}"):
        (gadget / folder).mkdir(parents=True, exist_ok=True)
    for name, value in identity.attributes().items():
        (gadget / name).write_text(value)
    (gadget / CONFIGURATION / FUNCTION).symlink_to(gadget / "functions" / FUNCTION)


def _is_whole(gadget: Path, identity: Identity) -> bool:
    linked = (gadget / CONFIGURATION / FUNCTION).is_symlink()
    return linked and all(_reads(gadget / name) == value for name, value in identity.attributes().items())


def _refuse_a_second(configfs: Path, controllers: Path, controller: str) -> None:
    for other in (configfs / "usb_gadget").glob("*/UDC"):
        if other.parent.name != NAME and _reads(other) == controller:
            raise _busy(controller, other.parent.name)
    function = _reads(controllers / controller / "function")
    if function.startswith("g_"):
        raise _busy(controller, function)


def _busy(controller: str, owner: str) -> SetupError:
    return SetupError(
        f"the USB controller {controller} is taken by {owner or 'another USB gadget'}, and it can have only one: "
        "switch that off (`sudo rpi-usb-gadget off`, or no g_... module at start) and reboot"
    )


def _reads(attribute: Path) -> str:
    """The text of an attribute; empty if it cannot be read."""
    try:
        return attribute.read_text().strip()
    except OSError:
        return ""
