"""A receiver's strength from Hamlib's real rigctld (its dummy rig), and from the simulator's look-alike beside it."""

from __future__ import annotations

import socket
import subprocess
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import pytest

from firmware_sim.parts.rigctld import SimRigctld
from rotator.calibrating.receiver import Receiver, Strength
from tests.boxes import free_port

DUMMY_RIG = "1"
PATIENCE_S = 20.0


@contextmanager
def asked(place: tuple[str, int], close: Callable[[], None] = lambda: None) -> Iterator[Receiver]:
    receiver = Receiver(place, time.monotonic, close)
    receiver.start()
    try:
        yield receiver
    finally:
        receiver.stop()


def awaited(receiver: Receiver, wanted: Callable[[Strength], bool]) -> Strength:
    """What it tells, as soon as it is what is wanted."""
    until_s = time.monotonic() + PATIENCE_S
    while time.monotonic() < until_s:
        told = receiver.latest()
        if told is not None and wanted(told):
            return told
        time.sleep(0.02)
    raise AssertionError(f"never told: {receiver.latest()}")


@pytest.mark.parametrize("options", [(), ("--vfo",)])
def test_the_real_rigctld_tells_its_dummys_strength_and_is_missed_when_it_ends(
    options: tuple[str, ...], need_program: Callable[[str, str], str]
) -> None:
    port = free_port()
    rigctld = [need_program("rigctld", "libhamlib-utils"), "-m", DUMMY_RIG, "-t", str(port), *options]
    with (
        subprocess.Popen(rigctld, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process,
        asked(("127.0.0.1", port)) as receiver,
    ):
        first = awaited(receiver, lambda told: not told.problem)
        assert -80 < first.strength_db < 80
        awaited(receiver, lambda told: told.at_s > first.at_s)
        process.kill()
        process.wait()
        gone = awaited(receiver, lambda told: bool(told.problem))
        assert f"the receiver at 127.0.0.1:{port}: " in gone.problem


def test_the_look_alike_answers_as_the_real_one_and_a_number_only_to_the_right_question() -> None:
    alike = SimRigctld(lambda: -37.4)
    with asked(alike.place, alike.close) as receiver:
        assert awaited(receiver, lambda told: not told.problem).strength_db == -37
        with socket.create_connection(alike.place) as line:
            for asks, answer in (
                (b"\\chk_vfo\n", b"0\n"),
                (b"\\get_level STRENGTH\n", b"-37\n"),
                (b"f\n", b"RPRT -11\n"),
            ):
                line.sendall(asks)
                assert line.recv(64) == answer
