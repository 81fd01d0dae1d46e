"""Every Raspberry Pi by the name it gives itself: its sections of config.txt, and whether it can be a USB device."""

from __future__ import annotations

import pytest

from rotator.setup.pi import SHORT_NAMES, known


@pytest.mark.parametrize(
    ("model", "socket", "sections"),
    [
        ("Zero W Rev 1.1", "micro-USB", "pi0 pi0w"),
        ("Zero 2 W Rev 1.0", "micro-USB", "pi0 pi0w pi02"),
        ("Model A Plus Rev 1.1", "USB-A", "pi1"),
        ("3 Model A Plus Rev 1.0", "USB-A", "pi3 pi3+"),
        ("4 Model B Rev 1.4", "USB-C", "pi4"),
        ("400 Rev 1.0", "USB-C", "pi4 pi400"),
        ("5 Model B Rev 1.0", "USB-C", "pi5"),
        ("Compute Module 4 Rev 1.0", "carrier", "pi4 cm4"),
        ("Compute Module 3 Plus Rev 1.0", "carrier", "pi3 cm3 cm3+"),
        ("Model B Plus Rev 1.2", None, "pi1"),
        ("2 Model B Rev 1.1", None, "pi2"),
        ("3 Model B Rev 1.2", None, "pi3"),
        ("3 Model B Plus Rev 1.3", None, "pi3 pi3+"),
    ],
)
def test_a_pi(model: str, socket: str | None, sections: str) -> None:
    pi = known(f"Raspberry Pi {model}\0")
    assert pi is not None
    assert (pi.model, pi.filters) == (f"Raspberry Pi {model}", set(sections.split()))
    assert bool(pi.power) == (socket is not None)
    assert (socket or "") in (pi.socket or "")
    assert (pi.socket is None) == (socket is None)


@pytest.mark.parametrize("model", ["", "Radxa ROCK 5B", "Raspberry Pi 9 Model B Rev 1.0"])
def test_a_board_nobody_here_knows(model: str) -> None:
    assert known(model) is None


@pytest.mark.parametrize("name", SHORT_NAMES.values())
def test_each_short_name_is_a_pi(name: str) -> None:
    assert known(f"Raspberry Pi {name} Rev 1.0") is not None
