"""The running box, and programs that send datagrams or write a file: each moves the antenna, and a stop stops it."""

from __future__ import annotations

import socket
import time
from collections.abc import Callable, Iterator
from contextlib import closing
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from rotator.protocols import wsjtx
from rotator.protocols.wsjtx import BodyDirection
from tests.boxes import FAST_ROTOR, free_udp_ports

if TYPE_CHECKING:
    from tests.foreign.conftest import RunningBox

Start = Callable[..., "RunningBox"]
PATIENCE_S = 60.0
TOLERANCE_DEG = 4.5
ALONE = FAST_ROTOR.replace("[elevation]\n", "[elevation]\nfitted = false\n")
"""A rotor with azimuth alone."""


class Rotctld:
    """Where the antenna is, from another of the box's links."""

    def __init__(self, port: int) -> None:
        self._connection = socket.create_connection(("127.0.0.1", port), PATIENCE_S)
        self._answers = self._connection.makefile("r")

    def position(self) -> tuple[float, float]:
        """Waits for the pots' first readings."""
        give_up_s = time.monotonic() + PATIENCE_S
        while True:
            self._connection.sendall(b"p\n")
            said = self._answers.readline()
            if said != "RPRT -6\n":
                return float(said), float(self._answers.readline())
            assert time.monotonic() < give_up_s, "it never knows where it is"
            time.sleep(0.02)

    def stop(self) -> None:
        self._connection.sendall(b"S\n")
        assert self._answers.readline() == "RPRT 0\n"

    def until(self, azimuth_deg: float, elevation_deg: float, meanwhile: Callable[[], object] = lambda: None) -> None:
        give_up_s = time.monotonic() + PATIENCE_S
        while True:
            at = self.position()
            if all(
                abs(is_deg - to) <= TOLERANCE_DEG for is_deg, to in zip(at, (azimuth_deg, elevation_deg), strict=True)
            ):
                return
            assert time.monotonic() < give_up_s, f"at {at}"
            meanwhile()
            time.sleep(0.05)

    def close(self) -> None:
        self._answers.close()
        self._connection.close()


def hearing(port: int = 0) -> socket.socket:
    """A socket of a program on this machine."""
    made = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    made.bind(("127.0.0.1", port))
    made.settimeout(PATIENCE_S)
    return made


@pytest.fixture
def udp_port() -> int:
    return free_udp_ports()


@pytest.fixture
def mouth() -> Iterator[socket.socket]:
    with hearing() as made:
        yield made


def udp(protocol: str, port: int, keys: str = "") -> str:
    return f'[[link]]\nprotocol = "{protocol}"\nudp = "127.0.0.1:{port}"\n{keys}'


def test_pstrotator(start_box: Start, udp_port: int, mouth: socket.socket) -> None:
    box = start_box(links=udp("pstrotator", udp_port))

    def send(text: bytes) -> None:
        mouth.sendto(b"<PST>" + text + b"</PST>", ("127.0.0.1", udp_port))

    with closing(Rotctld(box.rotctld_port)) as rotctld, hearing(udp_port + 1) as ears:
        rotctld.position()
        # Hamlib's model 3, slip and all
        send(b"<AZIMUTH>90.000000.2</AZIMUTH>")
        send(b"<ELEVATION>45.000000.2</ELEVATION>")
        rotctld.until(90, 45)
        send(b"AZ?")
        assert abs(float(ears.recv(100).decode().removeprefix("AZ:")) - 90) < TOLERANCE_DEG
        send(b"<TRACK>0</TRACK><AZIMUTH>30.0</AZIMUTH><ELEVATION>20.0</ELEVATION>")
        rotctld.until(30, 20)
        send(b"<AZIMUTH>300</AZIMUTH>")
        send(b"<STOP>1</STOP>")
        send(b"TGE?")
        assert ears.recv(100).startswith(b"TGE:")
        assert rotctld.position()[0] < 200
        send(b"<PARK>1</PARK>")
        rotctld.until(0, 0)
    assert box.stop() == 0


@pytest.mark.parametrize("rotor", [FAST_ROTOR, ALONE], ids=["two axes", "azimuth alone"])
def test_n1mm(start_box: Start, udp_port: int, mouth: socket.socket, rotor: str) -> None:
    keys = f'rotor_name = "G-5500"\nstatus_to = "127.0.0.1:{udp_port + 1}"\n'
    with hearing(udp_port + 1) as ears:
        box = start_box(extra=rotor, links=udp("n1mm", udp_port, keys))

        def send(message: bytes) -> None:
            mouth.sendto(b"<N1MMRotor>" + message + b"</N1MMRotor>", ("127.0.0.1", udp_port))

        with closing(Rotctld(box.rotctld_port)) as rotctld:
            name, said = ears.recv(100).decode().split(" @ ")
            assert name == "G-5500"
            assert (int(said) + 10) % 3600 <= 20, "it points north at first"
            send(b"<rotor>Beam</rotor><goazi>200.0</goazi><offset>0.0</offset>")
            send(b"<rotor>G-5500</rotor><goazi>55.0</goazi><offset>0.0</offset>")
            rotctld.until(55, 0)
            # More than a report has come while it turned; the last one is where it stands.
            name, said = ears.recv(100).decode().split(" @ ")
            while abs(int(said) / 10 - 55) > TOLERANCE_DEG:
                name, said = ears.recv(100).decode().split(" @ ")
            assert name == "G-5500"
            send(b"<rotor>G-5500</rotor><goazi>350.0</goazi><offset>0.0</offset>")
            send(b"<stop><rotor>G-5500</rotor><freqband>14</freqband></stop>")
            assert rotctld.position()[0] < 200
    assert box.stop() == 0


def test_macdoppler_until_a_stop_elsewhere(start_box: Start, udp_port: int, mouth: socket.socket) -> None:
    box = start_box(links=udp("macdoppler", udp_port))

    def report(azimuth_deg: float, elevation_deg: float) -> None:
        angles = f"Azimuth:{azimuth_deg:.2f}, Elevation:{elevation_deg:.2f}"
        mouth.sendto(f"00000001 Mac [AzEl Rotor Report:{angles}, SatName:XW-2C]".encode(), ("127.0.0.1", udp_port))

    with closing(Rotctld(box.rotctld_port)) as rotctld:
        rotctld.position()
        mouth.sendto(b"00000001 Mac [Sat Radio Report:Down Mhz:435.18, Down Mode:FM]", ("127.0.0.1", udp_port))
        report(39.0, 15.0)
        rotctld.until(39, 15)
        rotctld.stop()
        for azimuth_deg in range(200, 220):
            report(azimuth_deg, 15.0)
            assert abs(rotctld.position()[0] - 39) < 2 * TOLERANCE_DEG
    assert box.stop() == 0


@pytest.mark.parametrize(("rotor", "raised_deg"), [(FAST_ROTOR, 45), (ALONE, 0)], ids=["two axes", "azimuth alone"])
def test_wsjtx(start_box: Start, tmp_path: Path, rotor: str, raised_deg: float) -> None:
    path = tmp_path / "azel.dat"
    path.write_bytes(wsjtx.encode("Moon", BodyDirection(0, 200.0, 50.0)))
    box = start_box(extra=rotor, links=f'[[link]]\nprotocol = "wsjtx"\nfile = "{path}"\n')
    seconds = iter(range(3600, 36_000))

    def write() -> None:
        """Its clock is faster here than yours."""
        second = next(seconds)
        path.write_bytes(
            wsjtx.encode("Moon", BodyDirection(second, 90.0, 45.0))
            + wsjtx.encode("Sun", BodyDirection(second, 10.0, -20.0))
        )
        time.sleep(0.1)

    with closing(Rotctld(box.rotctld_port)) as rotctld:
        assert rotctld.position() == pytest.approx((0, 0), abs=1)
        rotctld.until(90, raised_deg, meanwhile=write)
    assert box.stop() == 0
