"""Every Raspberry Pi by the name it gives itself, and whether it can be a USB device."""

from __future__ import annotations

import pytest

from rotator.setup.pi import known


@pytest.mark.parametrize(
    ("model", "socket"),
    [
        ("Raspberry Pi Zero Rev 1.3", "micro-USB"),
        ("Raspberry Pi Zero W Rev 1.1", "micro-USB"),
        ("Raspberry Pi Zero 2 W Rev 1.0", "micro-USB"),
        ("Raspberry Pi Model A Rev 2", "USB-A"),
        ("Raspberry Pi Model A Plus Rev 1.1", "USB-A"),
        ("Raspberry Pi 3 Model A Plus Rev 1.0", "USB-A"),
        ("Raspberry Pi 4 Model B Rev 1.4", "USB-C"),
        ("Raspberry Pi 400 Rev 1.0", "USB-C"),
        ("Raspberry Pi 5 Model B Rev 1.0", "USB-C"),
        ("Raspberry Pi 500 Rev 1.0", "USB-C"),
        ("Raspberry Pi Compute Module 4 Rev 1.0", "carrier"),
        ("Raspberry Pi Compute Module 5 Rev 1.0", "carrier"),
        ("Raspberry Pi Compute Module 3 Plus Rev 1.0", "carrier"),
        ("Raspberry Pi Model B Rev 2", None),
        ("Raspberry Pi Model B Plus Rev 1.2", None),
        ("Raspberry Pi 2 Model B Rev 1.1", None),
        ("Raspberry Pi 3 Model B Rev 1.2", None),
        ("Raspberry Pi 3 Model B Plus Rev 1.3", None),
    ],
)
def test_the_socket(model: str, socket: str | None) -> None:
    pi = known(model + "\0")
    assert pi is not None
    assert pi.model == model
    assert (pi.socket is None) if socket is None else (pi.socket is not None and socket in pi.socket)
    assert bool(pi.power) == (socket is not None)


@pytest.mark.parametrize("model", ["", "Radxa ROCK 5B", "Raspberry Pi 9 Model B Rev 1.0"])
def test_a_board_nobody_here_knows(model: str) -> None:
    assert known(model) is None


@pytest.mark.parametrize(
    ("model", "filters"),
    [
        ("Raspberry Pi Zero 2 W Rev 1.0", {"pi0", "pi0w", "pi02"}),
        ("Raspberry Pi 400 Rev 1.0", {"pi4", "pi400"}),
        ("Raspberry Pi Compute Module 4 Rev 1.1", {"pi4", "cm4"}),
        ("Raspberry Pi 5 Model B Rev 1.0", {"pi5"}),
    ],
)
def test_the_sections_that_speak_of_it(model: str, filters: set[str]) -> None:
    pi = known(model)
    assert pi is not None
    assert pi.filters == filters
