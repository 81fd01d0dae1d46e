"""The drive with its thread and mjbots' library in real time: on the simulated adapter, and on a CAN channel."""

from __future__ import annotations

import contextlib
import errno
import logging
import os
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.tables import every_row

pytest.importorskip("moteus", reason="moteus is missing: pip install --no-deps moteus")

from firmware_sim.moteus.bus import Frame, padded
from firmware_sim.moteus.motor import Mode
from firmware_sim.rotors.moteus import MoteusAxisSpec, SimMoteusRotor
from hw.moteus.bus import MOTEUS_THREAD, MoteusBus
from hw.moteus.drive import MoteusDrive
from hw.moteus.library import CanChannel, SerialPort
from hw.moteus.orders import MoteusSpec
from hw.ports import Axis, HardwareError

pytestmark = pytest.mark.quiet

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
DEADLINE_S = 8.0


def wait_for(what: Callable[[], bool]) -> float:
    """Returns how long it took."""
    started_s = time.monotonic()
    while not what():
        assert time.monotonic() - started_s < DEADLINE_S, "it never came"
        threading.Event().wait(0.005)
    return time.monotonic() - started_s


class Bench:
    def __init__(self, path: Path) -> None:
        self.world = SimMoteusRotor(
            MoteusAxisSpec(1), MoteusAxisSpec(2, rev_per_turn=-1.0, zero_rev=-0.25), time.monotonic
        )
        self.adapter = self.world.adapter(path)
        self.drive = MoteusDrive(MoteusSpec(1), MoteusSpec(2, rev_per_turn=-1.0, zero_rev=-0.25), time.monotonic)
        self.bus = MoteusBus(self.drive, SerialPort(str(path)))

    def aim(self, axis: Axis, angle_deg: float, rate_dps: float = 0.0) -> None:
        self.drive.aim(axis, angle_deg, rate_dps, time.monotonic() + 0.3)

    def answers(self, axis: Axis = AZ) -> bool:
        return self.complaint(axis) == ""

    def complaint(self, axis: Axis = AZ) -> str:
        try:
            self.drive.sensor(axis).read()
        except HardwareError as error:
            return str(error)
        return ""

    def reaches(self, axis: Axis, angle_deg: float) -> Callable[[], bool]:
        """On a busy machine its thread may have been held up: then no answer is fresh, and it is asked again."""

        def there() -> bool:
            with contextlib.suppress(HardwareError):
                self.aim(axis, angle_deg)
                return abs(self.drive.sensor(axis).read() - angle_deg) < 0.01
            return False

        return there

    def mode(self, axis: Axis) -> Mode:
        self.world.antenna()
        return self.world.controller(axis.value).motor.mode


@pytest.fixture
def bench(tmp_path: Path) -> Iterator[Bench]:
    bench = Bench(tmp_path / "fdcanusb")
    bench.adapter.plug()
    bench.bus.start()
    try:
        wait_for(lambda: bench.answers(AZ) and bench.answers(EL))
        yield bench
    finally:
        bench.bus.close()
        bench.adapter.unplug()


def test_an_order_does_not_wait_for_the_next_cycle(bench: Bench) -> None:
    wait_for(bench.reaches(AZ, 0.0))
    lines = bench.world.lines.transcript
    took_s = []
    for _ in range(15):
        bench.drive.off()
        lines.clear()
        wait_for(lambda: sum("8001 01000A0E200000C07F" in line for line in lines) > 2)  # parked: NaN, every 0.08 s
        lines.clear()
        bench.aim(AZ, 0.0)
        took_s.append(wait_for(lambda: any("8001 01000A0E2000000000" in line for line in lines)))
    assert sorted(took_s)[7] < 0.02


def test_unplugged_for_50_ms_it_goes_on_and_the_log_tells_it(bench: Bench, caplog: pytest.LogCaptureFixture) -> None:
    """A try counts where this machine gave every thread its turn: held up for longer, an adapter is as good as away."""
    wait_for(bench.reaches(AZ, 2.0))
    complaints: set[str] = set()
    counted = 0
    for _ in range(10):
        wait_for(lambda: bench.reaches(AZ, 60.0)() or bench.world.antenna()[0] > 12.0)
        bench.world.inject("adapter-unplugged")
        away_s = time.monotonic()
        threading.Event().wait(0.05)
        bench.world.clear("adapter-unplugged")
        heard: set[str] = set()
        looked_s, held_up_s = away_s, 0.0
        while looked_s < away_s + 0.55:
            try:
                bench.aim(AZ, 2.0)  # raises nothing while the controller carries out its last order
                heard.add(bench.complaint(AZ))
            except HardwareError as error:
                heard.add(str(error))
            threading.Event().wait(0.01)
            now_s = time.monotonic()
            looked_s, held_up_s = now_s, max(held_up_s, now_s - looked_s)
        wait_for(bench.reaches(AZ, 2.0))
        if held_up_s < 0.1:
            counted += 1
            complaints |= heard
        if counted == 2:
            break
    assert counted == 2, "this machine was too busy ten times"
    assert complaints == {""}
    assert bench.drive.faults() == {}
    assert "azimuth: moteus answers again, after 0." in caplog.text


def test_unplugged_until_its_watchdog_stops_it_takes_the_next_order(bench: Bench) -> None:
    wait_for(bench.reaches(AZ, 2.0))
    bench.world.inject("adapter-unplugged")
    wait_for(lambda: not bench.answers(AZ))
    assert "plug" in bench.complaint(AZ)
    wait_for(lambda: bench.mode(AZ) is Mode.TIMEOUT)
    bench.world.clear("adapter-unplugged")
    wait_for(lambda: bench.answers(AZ))
    wait_for(bench.reaches(AZ, 3.0))
    assert bench.drive.faults() == {}


def test_closing_decelerates_and_ends_the_thread(bench: Bench) -> None:
    wait_for(lambda: bench.reaches(AZ, 300.0)() or bench.world.antenna()[0] > 4.0)
    bench.bus.close()
    stopped_deg = bench.world.antenna()[0]
    assert bench.world.controller("azimuth").motor.set_point.velocity_rev_s == pytest.approx(0.0, abs=1e-4)
    wait_for(lambda: bench.mode(AZ) is Mode.TIMEOUT)
    assert bench.world.antenna()[0] == pytest.approx(stopped_deg, abs=0.05)
    assert MOTEUS_THREAD not in [thread.name for thread in threading.enumerate()]


def test_no_adapter_is_a_sentence_and_it_is_found_when_it_comes(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    caplog.set_level(logging.DEBUG, "hw.moteus.bus")
    bench = Bench(tmp_path / "fdcanusb")
    bench.bus.start()
    try:
        wait_for(lambda: "there is no such port: plug the adapter in" in bench.complaint())
        with pytest.raises(HardwareError, match="there is no such port"):
            bench.aim(AZ, 10.0)
        wait_for(lambda: "next try in 0.5 s" in caplog.text)
        assert "next try in 0.1 s" in caplog.text, "each pause is twice the one before"
        bench.adapter.plug()
        wait_for(bench.answers)
    finally:
        bench.bus.close()
        bench.adapter.unplug()


class Refuses(CanChannel):
    """A port of which the kernel says why it cannot be opened."""

    def __call__(self, moteus: Any) -> Any:
        raise OSError(int(self.interface), os.strerror(int(self.interface)))


@every_row(
    ("number", "words"),
    [
        (errno.ENOENT, "there is no such port: plug the adapter in"),
        (errno.EACCES, "no permission: add the user to the group dialout"),
        (errno.EPERM, "no permission: add the user to the group dialout"),
        (errno.ENODEV, "there is no such CAN interface: bring it up with ip link"),
        (errno.ENETDOWN, "the CAN interface is down: ip link set can0 up"),
        (errno.EIO, "the adapter has gone"),
    ],
)
def test_why_a_port_does_not_open_is_a_sentence_with_what_to_do(number: int, words: str) -> None:
    drive = MoteusDrive(MoteusSpec(1), MoteusSpec(2), time.monotonic)
    bus = MoteusBus(drive, Refuses("can0", str(number)))
    bus.start()
    try:
        wait_for(lambda: "not connected" not in _complaint(drive, AZ))
        assert f"moteus: can0: {words}" in _complaint(drive, AZ)
    finally:
        bus.close()


@contextlib.contextmanager
def on_a_can_channel(world: SimMoteusRotor, channel: str) -> Iterator[None]:
    """The simulated controllers as nodes of python-can's in-process bus."""
    can = pytest.importorskip("can", reason="python-can is missing: pip install python-can")
    node = can.Bus(interface="virtual", channel=channel, fd=True)
    ending = threading.Event()

    def serve() -> None:
        while not ending.is_set():
            if message := node.recv(timeout=0.05):
                for reply in world.can.send(Frame(message.arbitration_id, bytes(message.data))):
                    node.send(
                        can.Message(
                            arbitration_id=reply.arbitration_id,
                            is_extended_id=reply.arbitration_id > 0x7FF,
                            data=padded(reply.data),
                            is_fd=True,
                            bitrate_switch=True,
                        )
                    )

    thread = threading.Thread(target=serve, name="can-node")
    thread.start()
    try:
        yield
    finally:
        ending.set()
        thread.join()
        node.shutdown()


def test_a_can_channel_does_as_well_and_there_the_library_itself_never_gives_up() -> None:
    world = SimMoteusRotor(MoteusAxisSpec(1), MoteusAxisSpec(2), time.monotonic)
    drive = MoteusDrive(MoteusSpec(1), MoteusSpec(2), time.monotonic)
    bus = MoteusBus(drive, CanChannel("bench", interface="virtual"))

    def reached() -> bool:
        with contextlib.suppress(HardwareError):
            drive.aim(AZ, 5.0, 0.0, time.monotonic() + 0.3)
        return abs(world.antenna()[0] - 5.0) < 0.01

    with on_a_can_channel(world, "bench"):
        bus.start()
        try:
            wait_for(reached)
            world.inject("elevation-silent")
            wait_for(lambda: "does not answer" in _complaint(drive, EL))
            assert _complaint(drive, AZ) == ""
        finally:
            bus.close()


def _complaint(drive: MoteusDrive, axis: Axis) -> str:
    try:
        drive.sensor(axis).read()
    except HardwareError as error:
        return str(error)
    return ""
