"""Which machines, which names and which pages the box hears."""

from __future__ import annotations

from rotator.web.entrance import Doors
from tests.tables import every_row

DOORS = Doors(["shack-pi", "rotator", "antenna.example.net"])
OURS = (
    *("127.0.0.1:8232", "192.168.1.7", "[::1]:8232", "[fe80::1]", "10.0.0.1:80"),
    *("localhost:8232", "shack-pi", "shack-pi.local:8232", "ROTATOR.local", "rotator.local."),
    "antenna.example.net:8232",
)
FOREIGN = (
    *("", "evil.example", "rotator.local.evil.example", "127.0.0.1.evil.example:8232", "evilrotator"),
    *("antenna.example.net.local", "rotator:80:80", "rotator/", "user@rotator", "[::1", "rota tor", "a" * 300),
)
PRIVATE = ("127.0.0.1", "::1", "192.168.178.20", "10.1.2.3", "fd00::5", "::ffff:192.168.1.5")
INTERNET = ("8.8.8.8", "2001:db8::1", "172.32.0.1", "", "no address", "::ffff:8.8.8.8")


@every_row(("host", "known"), [*((each, True) for each in OURS), *((each, False) for each in FOREIGN)])
def test_the_box_knows_its_names_and_every_number_and_no_foreign_name(host: str, *, known: bool) -> None:
    """A foreign name may point at the box."""
    assert DOORS.knows(host) is known


@every_row(("address", "comes_in"), [*((each, True) for each in PRIVATE), *((each, False) for each in INTERNET)])
def test_private_networks_come_in_and_the_internet_does_not(address: str, *, comes_in: bool) -> None:
    assert DOORS.lets_in(address) is comes_in


def test_the_file_may_say_otherwise() -> None:
    doors = Doors([], ["192.168.1.20"])
    assert [doors.lets_in(each) for each in ("192.168.1.20", "192.168.1.21", "127.0.0.1")] == [True, False, False]


@every_row(
    ("origin", "site", "may"),
    [
        (None, None, True),
        ("http://rotator.local:8232", None, True),
        ("http://ROTATOR.local:8232", "same-origin", True),
        (None, "none", True),
        ("http://evil.example", None, False),
        ("http://rotator.local", None, False),
        ("http://rotator.local:8232.evil.example", None, False),
        ("null", None, False),
        ("", None, False),
        (None, "cross-site", False),
        (None, "same-site", False),
        ("http://rotator.local:8232", "cross-site", False),
    ],
)
def test_the_box_s_own_page_and_a_program_may_do_something_and_a_foreign_page_may_not(
    origin: str | None, site: str | None, *, may: bool
) -> None:
    assert DOORS.is_own("rotator.local:8232", origin, site) is may
