"""Secrets are taken out of what leaves the box, wherever they stand; the rest stays readable."""

from __future__ import annotations

import pytest

from rotator.config.load import parse
from rotator.web.redaction import REMOVED, Redaction, secrets_of


@pytest.mark.parametrize(
    ("text", "left"),
    [
        ("https://sky.example/gp.php?GROUP=amateur: 95 satellites", "https://sky.example/…: 95 satellites"),
        ("rfc2217://anna:s3cret@192.168.1.9:4000/x?log", "rfc2217://192.168.1.9:4000/…"),
        ("http://192.168.1.9:8232", "http://192.168.1.9:8232"),
        ("Authorization: Bearer abc.def-ghi", f"Authorization: {REMOVED}"),
        ("Cookie: rotator=abcdefgh; other=1", f"Cookie: {REMOVED}"),
        ("password = 'correct horse'", f"password = {REMOVED}"),
        ('{"api_key": "abc", "n": 1}', f'{{"api_key": {REMOVED}, "n": 1}}'),
        ("f" * 64, REMOVED),
        ("see " + "aB-_" * 10 + "xyz" + " there", f"see {REMOVED} there"),
        ("gs232b#1 > W235 025\\r", "gs232b#1 > W235 025\\r"),
        ("axis azimuth: 12 % of 450°, at 8f3a9c2", "axis azimuth: 12 % of 450°, at 8f3a9c2"),
    ],
)  # fmt: skip
def test_what_looks_like_a_secret_goes_and_the_rest_stays(text: str, left: str) -> None:
    assert Redaction().text(text) == left


def test_what_the_configuration_holds_goes_even_where_it_stands_alone() -> None:
    config = parse(
        """
[sky]
fetch = ["https://sky.example/api/KEYKEYKEYKEY99/tle?user=anna&key=tops3cret"]
[[link]]
protocol = "gs232b"
serial = "socket://bert:hidden99@10.0.0.2:7000"
""",
        "a test's file",
    )
    redaction = Redaction(secrets_of(config))
    said = "GET /api/KEYKEYKEYKEY99/tle?user=anna&key=tops3cret for anna; bert said hidden99, or tops3cret"
    for secret in ("KEYKEYKEYKEY99", "tops3cret", "hidden99", "bert", "anna"):
        assert secret not in redaction.text(said)


def test_a_name_is_replaced_by_what_stands_for_it() -> None:
    assert Redaction((), {"Anna's phone": "page#1"}).text("page: Anna's phone is paired") == "page: page#1 is paired"
