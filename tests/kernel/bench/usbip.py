"""A USB device in this process, plugged into the kernel's virtual host controller (vhci-hcd) over USB/IP.

Knows the wire format (Linux, Documentation/usb/usbip_protocol.rst) and enumeration. Does not know what the device does:
its vendor requests go to `control`, one after the other, in a thread of their own, so that a device may hang.
"""

from __future__ import annotations

import errno
import queue
import socket
import struct
import threading
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from tests.kernel.bench.waiting import until

VHCI = Path("/sys/devices/platform/vhci_hcd.0")
HEADER = struct.Struct(">5I28s")
SUBMIT, UNLINK, SUBMITTED, UNLINKED = 1, 2, 3, 4
FULL_SPEED = 2
FREE_PORT = 4

GET_DESCRIPTOR, STANDARD_IN, TYPE_MASK, VENDOR = 6, 0x80, 0x60, 0x40
DEVICE, CONFIGURATION, STRING = 1, 2, 3


class StallError(Exception):
    """Raised by a device that refuses a request."""


@dataclass(frozen=True, slots=True)
class Setup:
    """The eight bytes that begin a control transfer (USB 2.0, table 9-2)."""

    request_type: int
    request: int
    value: int
    index: int
    length: int


@dataclass(frozen=True, slots=True)
class Identity:
    vendor: int
    product: int
    name: str


Control = Callable[[Setup, bytes], bytes]
"""A request and the data that came with it -> the data it asks for. Raises StallError."""


class UsbDevice:
    """Plugged in by `plug`, gone after `unplug`; may be plugged in again."""

    def __init__(self, identity: Identity, control: Control) -> None:
        self._identity = identity
        self._control = control
        self._port: int | None = None

    def plug(self) -> None:
        ours, kernels = socket.socketpair()
        self._wire = ours
        self._requests: queue.SimpleQueue[tuple[int, Setup, bytes] | None] = queue.SimpleQueue()
        self._cancelled: set[int] = set()
        self._sending = threading.Lock()
        # "Thread-": a hung device must not count as a thread that a test left behind.
        for work in (self._listen, self._serve):
            threading.Thread(target=work, name=f"Thread-usb-{work.__name__}", daemon=True).start()
        self._port = _free_port()
        # A fresh number a plug: the kernel keeps the old one until the old device is quite gone.
        (VHCI / "attach").write_text(f"{self._port} {kernels.fileno()} {self._port + 1} {FULL_SPEED}")
        kernels.close()

    def unplug(self) -> None:
        """The device vanishes. The kernel lets go of it when everybody has closed it."""
        if self._port is not None:
            (VHCI / "detach").write_text(str(self._port))
            self._port = None
            self._requests.put(None)
            with suppress(OSError):
                self._wire.shutdown(socket.SHUT_RDWR)

    def _listen(self) -> None:
        wire = self._wire.makefile("rb")
        while len(header := wire.read(HEADER.size)) == HEADER.size:
            command, number, _device, inward, _endpoint, rest = HEADER.unpack(header)
            if command == UNLINK:
                (unlinked,) = struct.unpack_from(">I", rest)
                self._cancelled.add(unlinked)
                self._send(HEADER.pack(UNLINKED, number, 0, 0, 0, struct.pack(">i24x", -errno.ECONNRESET)))
                continue
            length = struct.unpack_from(">I", rest, 4)[0]
            setup = Setup(*struct.unpack("<BBHHH", rest[20:28]))
            self._requests.put((number, setup, b"" if inward else wire.read(length)))
        self._wire.close()

    def _serve(self) -> None:
        requests = self._requests
        while (request := requests.get()) is not None:
            number, setup, data = request
            try:
                status, answer = 0, self._answer(setup, data)[: setup.length]
            except StallError:
                status, answer = -errno.EPIPE, b""
            if number not in self._cancelled:
                actual = len(answer) if setup.request_type & STANDARD_IN else len(data)
                result = struct.pack(">iIIII8x", status, actual, 0, 0, 0)
                self._send(HEADER.pack(SUBMITTED, number, 0, 0, 0, result) + answer)

    def _send(self, packet: bytes) -> None:
        with self._sending, suppress(OSError):
            self._wire.sendall(packet)

    def _answer(self, setup: Setup, data: bytes) -> bytes:
        if setup.request_type & TYPE_MASK == VENDOR:
            return self._control(setup, data)
        if setup.request_type == STANDARD_IN and setup.request == GET_DESCRIPTOR:
            return self._descriptor(setup.value >> 8, setup.value & 0xFF)
        if setup.request_type & STANDARD_IN:
            return bytes(setup.length)
        return b""

    def _descriptor(self, kind: int, index: int) -> bytes:
        match kind:
            case 1:
                identity = self._identity
                return struct.pack(
                    "<BBHBBBBHHHBBBB", 18, DEVICE, 0x0110, 0xFF, 0, 0, 8, identity.vendor, identity.product, 0x0100,
                    0, 1, 0, 1,
                )  # fmt: skip
            case 2:
                interface = struct.pack("<BBBBBBBBB", 9, 4, 0, 0, 0, 0xFF, 0, 0, 0)
                return struct.pack("<BBHBBBBB", 9, CONFIGURATION, 18, 1, 1, 0, 0x80, 50) + interface
            case 3:
                text = struct.pack("<H", 0x0409) if index == 0 else self._identity.name.encode("utf-16-le")
                return struct.pack("<BB", 2 + len(text), STRING) + text
            case _:
                raise StallError


def _free_port() -> int:
    def free() -> list[int]:
        rows = [line.split() for line in (VHCI / "status").read_text().splitlines()[1:]]
        return [int(row[1]) for row in rows if row[0] == "hs" and int(row[2]) == FREE_PORT]

    return until(free, "a free port on the virtual USB host controller")[0]
