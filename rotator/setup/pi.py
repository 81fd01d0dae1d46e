"""The models of Raspberry Pi: names, sections of config.txt, the socket for USB device mode, and the power supply then.

Knows the names in /proc/device-tree/model; reads no file. The Pi 1 B, 2 B, 3 B and 3 B+ have a USB hub between the
processor and their sockets, and a hub cannot work as a device.
"""

from __future__ import annotations

from dataclasses import dataclass

FROM_THE_PC = "The PC's socket also powers the Pi; with a supply of its own, use a cable without the 5 V wire."
A_TO_A = (
    "It takes a USB A-to-A cable with its 5 V wire cut, and the Pi's own supply: with the wire, two supplies fight."
)
PI_4 = (
    "A PC's socket gives 0.5 to 0.9 A and a Pi 4 can take more: feed it 5 V through the header "
    "and use a cable without the 5 V wire."
)
PI_5 = "A PC's socket cannot power a Pi 5: feed it 5 V through the header or PoE and use a cable without the 5 V wire."
CARRIER = "Power the carrier board as its manual says, and not from the PC."

MICRO_USB = "the micro-USB socket marked USB"
USB_A = "the USB-A socket"
USB_C = "the USB-C socket"
CARRIER_PORT = "the carrier board's USB device socket"


@dataclass(frozen=True, slots=True)
class Pi:
    model: str
    """The Pi's full name, with the revision."""
    filters: frozenset[str]
    """The sections of config.txt that apply to it."""
    socket: str | None
    """The socket for USB device mode; None: no socket can do that."""
    power: str = ""
    """How to power the Pi while that socket is connected to a PC."""


_MODELS: tuple[tuple[str, str, str | None, str], ...] = (
    ("Zero 2 W", "pi0 pi0w pi02", MICRO_USB, FROM_THE_PC),
    ("Zero W", "pi0 pi0w", MICRO_USB, FROM_THE_PC),
    ("Zero", "pi0", MICRO_USB, FROM_THE_PC),
    ("Model A", "pi1", USB_A, A_TO_A),
    ("Model B", "pi1", None, ""),
    ("2 Model B", "pi2", None, ""),
    ("3 Model A Plus", "pi3 pi3+", USB_A, A_TO_A),
    ("3 Model B Plus", "pi3 pi3+", None, ""),
    ("3 Model B", "pi3", None, ""),
    ("4 Model B", "pi4", USB_C, PI_4),
    ("400", "pi4 pi400", USB_C, PI_4),
    ("500", "pi5 pi500", USB_C, PI_5),
    ("5 Model B", "pi5", USB_C, PI_5),
    ("Compute Module 5", "pi5 cm5", CARRIER_PORT, CARRIER),
    ("Compute Module 4S", "pi4 cm4s", CARRIER_PORT, CARRIER),
    ("Compute Module 4", "pi4 cm4", CARRIER_PORT, CARRIER),
    ("Compute Module 3", "pi3 cm3 cm3+", CARRIER_PORT, CARRIER),
    ("Compute Module 0", "pi0 pi0w pi02 cm0", CARRIER_PORT, CARRIER),
    ("Compute Module", "pi1 cm1", CARRIER_PORT, CARRIER),
)
"""Name, sections, socket, power. Of two names with the same beginning, the longer comes first."""

MODEL_FILTERS = frozenset(" ".join(filters for _, filters, _, _ in _MODELS).split())


def known(model: str) -> Pi | None:
    """The Pi of this name, of any revision; None for an unknown board."""
    name = model.rstrip("\0").strip()
    for prefix, filters, socket, power in _MODELS:
        if name.startswith(f"Raspberry Pi {prefix}"):
            return Pi(name, frozenset(filters.split()), socket, power)
    return None


def short_name(name: str) -> str:
    """`zero2w` of "Zero 2 W", `3b+` of "3 Model B Plus", `cm4` of "Compute Module 4"."""
    words = name.lower().replace("compute module", "cm").replace("model", "").replace("plus", "+")
    return words.replace(" ", "")


SHORT_NAMES = {short_name(name): name for name, *_ in _MODELS}
"""The full names by the short ones, for a card whose Pi is not here."""
