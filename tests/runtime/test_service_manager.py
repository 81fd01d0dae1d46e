"""What a service manager hears, on a real socket: sd_notify(3) and sd_watchdog_enabled(3)."""

from __future__ import annotations

import json
import os
import socket
from collections.abc import Iterator
from pathlib import Path

import pytest

from firmware_sim.clock import SimClock
from rotator.runtime.service_manager import ServiceManager


class Manager:
    """The end of the socket that systemd would hold."""

    def __init__(self, folder: Path) -> None:
        self.path = folder / "notify"
        self._socket = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self._socket.bind(str(self.path))
        self._socket.setblocking(False)

    def heard(self) -> list[str]:
        messages = []
        while True:
            try:
                messages.append(self._socket.recv(4096).decode())
            except BlockingIOError:
                return messages

    def close(self) -> None:
        self._socket.close()


@pytest.fixture
def manager(tmp_path: Path) -> Iterator[Manager]:
    made = Manager(tmp_path)
    yield made
    made.close()


@pytest.fixture
def clock() -> SimClock:
    return SimClock(50.0)


def test_ready_and_stopping(manager: Manager, clock: SimClock) -> None:
    notifier = ServiceManager({"NOTIFY_SOCKET": str(manager.path)}, clock)
    notifier.ready()
    notifier.stopping()
    notifier.close()
    assert manager.heard() == ["READY=1", "STOPPING=1"]


def test_a_new_start_may_be_silent_for_longer(manager: Manager, clock: SimClock) -> None:
    environment = {"NOTIFY_SOCKET": str(manager.path), "WATCHDOG_USEC": "5000000"}
    ending = ServiceManager(environment, clock)
    ending.pausing()
    ending.close()
    begun = ServiceManager(environment, clock)
    begun.ready()
    begun.resumed()
    begun.close()
    assert manager.heard() == ["WATCHDOG_USEC=60000000", "READY=1", "WATCHDOG_USEC=5000000"]


def test_four_signs_of_life_in_the_time_allowed(manager: Manager, clock: SimClock) -> None:
    notifier = ServiceManager({"NOTIFY_SOCKET": str(manager.path), "WATCHDOG_USEC": "5000000"}, clock)
    for _ in range(100):  # five seconds of a control loop at 20 Hz
        notifier.alive()
        clock.sleep(0.05)
    notifier.close()
    assert manager.heard() == ["WATCHDOG=1"] * 4


@pytest.mark.parametrize("asked", [{}, {"WATCHDOG_USEC": "soon"}, {"WATCHDOG_USEC": "5000000", "WATCHDOG_PID": "1"}])
def test_without_a_watchdog_of_ours_it_is_silent(manager: Manager, clock: SimClock, asked: dict[str, str]) -> None:
    notifier = ServiceManager({"NOTIFY_SOCKET": str(manager.path), **asked}, clock)
    notifier.alive()
    notifier.pausing()
    notifier.resumed()
    notifier.close()
    assert manager.heard() == []


def test_a_socket_without_a_file(clock: SimClock) -> None:
    name = f"rotator-test-{os.getpid()}"
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as listening:
        listening.bind("\0" + name)
        notifier = ServiceManager({"NOTIFY_SOCKET": "@" + name}, clock)
        notifier.ready()
        notifier.close()
        assert listening.recv(100) == b"READY=1"


def test_without_a_service_manager_or_with_one_that_has_gone_nothing_happens(tmp_path: Path, clock: SimClock) -> None:
    for environment in ({}, {"NOTIFY_SOCKET": str(tmp_path / "nobody")}):
        notifier = ServiceManager(environment, clock)
        notifier.ready()
        notifier.alive()
        notifier.leave("lines", "text")
        notifier.close()


def test_it_leaves_word_in_the_folder_that_it_was_given(tmp_path: Path, clock: SimClock) -> None:
    notifier = ServiceManager({"RUNTIME_DIRECTORY": f"{tmp_path}:/elsewhere"}, clock)
    notifier.leave("relay-lines.json", json.dumps({"chip": "/dev/gpiochip0"}))
    notifier.close()
    assert json.loads((tmp_path / "relay-lines.json").read_text()) == {"chip": "/dev/gpiochip0"}
