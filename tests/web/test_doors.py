"""Which machines, which names and which pages the box hears."""

from __future__ import annotations

import pytest

from rotator.web.doors import Doors

DOORS = Doors(["shack-pi", "rotator", "antenna.example.net"])


@pytest.mark.parametrize(
    "host",
    [
        *("127.0.0.1:8232", "192.168.1.7", "[::1]:8232", "[fe80::1]", "10.0.0.1:80"),
        *("localhost:8232", "shack-pi", "shack-pi.local:8232", "ROTATOR.local", "rotator.local."),
        "antenna.example.net:8232",
    ],
)
def test_the_box_knows_its_names_and_every_number(host: str) -> None:
    assert DOORS.knows(host)


@pytest.mark.parametrize(
    "host",
    [
        *("", "evil.example", "rotator.local.evil.example", "127.0.0.1.evil.example:8232", "evilrotator"),
        *("antenna.example.net.local", "rotator:80:80", "rotator/", "user@rotator", "[::1", "rota tor", "a" * 300),
    ],
)
def test_a_foreign_name_that_points_at_the_box_is_not_heard(host: str) -> None:
    assert not DOORS.knows(host)


@pytest.mark.parametrize("address", ["127.0.0.1", "::1", "192.168.178.20", "10.1.2.3", "fd00::5", "::ffff:192.168.1.5"])
def test_private_networks_come_in(address: str) -> None:
    assert DOORS.lets_in(address)


@pytest.mark.parametrize("address", ["8.8.8.8", "2001:db8::1", "172.32.0.1", "", "no address", "::ffff:8.8.8.8"])
def test_the_internet_does_not(address: str) -> None:
    assert not DOORS.lets_in(address)


def test_the_file_may_say_otherwise() -> None:
    doors = Doors([], ["192.168.1.20"])
    assert doors.lets_in("192.168.1.20")
    assert not doors.lets_in("192.168.1.21")
    assert not doors.lets_in("127.0.0.1")


@pytest.mark.parametrize(
    ("origin", "site"),
    [(None, None), ("http://rotator.local:8232", None), ("http://ROTATOR.local:8232", "same-origin"), (None, "none")],
)
def test_the_box_s_own_page_and_a_program_may_do_something(origin: str | None, site: str | None) -> None:
    assert DOORS.is_own("rotator.local:8232", origin, site)


@pytest.mark.parametrize(
    ("origin", "site"),
    [
        ("http://evil.example", None),
        ("http://rotator.local", None),
        ("http://rotator.local:8232.evil.example", None),
        ("null", None),
        ("", None),
        (None, "cross-site"),
        (None, "same-site"),
        ("http://rotator.local:8232", "cross-site"),
    ],
)
def test_a_foreign_page_may_not(origin: str | None, site: str | None) -> None:
    assert not DOORS.is_own("rotator.local:8232", origin, site)
