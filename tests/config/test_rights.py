"""Who may do what on a link: the keys for it, and what is said of those that make no sense."""

from __future__ import annotations

import pytest

from rotator.config.load import parse
from rotator.config.model import Config
from tests.config.texts import faults

LINK = '[[link]]\nprotocol = "rotctld"\ntcp = "0.0.0.0:4533"\n'


def test_left_out_everybody_may_everything() -> None:
    (link,) = parse(LINK, "x").link
    assert (link.read_only, link.allow, link.most_clients, link.most_per_s) == (False, None, 128, 100)


def test_given() -> None:
    text = LINK + 'read_only = true\nallow = ["192.168.1.0/24", "fd00::/8"]\nmost_clients = 2\nmost_per_s = 5\n'
    (link,) = parse(text, "x").link
    assert (link.read_only, link.allow) == (True, ["192.168.1.0/24", "fd00::/8"])
    assert (link.most_clients, link.most_per_s) == (2, 5)


@pytest.mark.parametrize(
    ("keys", "fault"),
    [
        ("allow = [1]", "the first [[link]]: allow[0] = 1: must be text in quotes"),
        (
            'allow = "192.168.1.0/24"',
            'the first [[link]]: allow = "192.168.1.0/24": must be a list in brackets',
        ),
        (
            'allow = ["192.168.1"]',
            'the first [[link]]: allow: "192.168.1" must be an address or a network, such as "192.168.1.0/24"',
        ),
        ("most_per_s = 0", "the first [[link]]: most_per_s = 0: must be greater than or equal to 1"),
        ('name = "a>b"', "the first [[link]]: name: 'a>b' must be printable characters, and none of < > #"),
        ('name = "a#1"', "the first [[link]]: name: 'a#1' must be printable characters, and none of < > #"),
    ],
)
def test_what_cannot_be(keys: str, fault: str) -> None:
    assert faults(LINK + keys) == [fault]


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        (
            '[[link]]\nprotocol = "rotctld-follow"\nconnect = "shack:4533"\nread_only = true',
            "the first [[link]]: rotctld-follow does nothing but give orders: leave out read_only",
        ),
        (
            '[[link]]\nprotocol = "gs232b"\npty = "x"\nallow = ["::1"]',
            "the first [[link]]: allow is for links that others connect to over a network: leave it out",
        ),
    ],
)
def test_what_makes_no_sense(text: str, fault: str) -> None:
    assert faults(text) == [fault]


def test_a_wrong_item_of_a_list_hides_no_other_fault() -> None:
    said = faults(f"{LINK}allow = [1, 2]\nbaud = 1\n[azimuth]\ncalibration = [[0.1, 0], [0.9]]\nmin_deg = 500\n")
    assert {fault.partition(" = ")[0].partition(": min")[0] for fault in said} == {
        "the first [[link]]: allow[0]", "the first [[link]]: allow[1]", "the first [[link]]: baud",
        "azimuth.calibration[1][1]: must be given",
    }  # fmt: skip


def test_where_the_monitor_is() -> None:
    assert parse("", "x").monitor.path is None
    assert parse('[monitor]\npath = "/run/x/monitor"\n', "x").monitor.path == "/run/x/monitor"
    assert Config().monitor.path is None
