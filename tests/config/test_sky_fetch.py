"""`[sky] fetch`, `serve` and `allow`: one address or many, and what cannot be meant."""

from __future__ import annotations

import pytest

from rotator.config.load import parse
from rotator.config.mistake import ConfigError

ADDRESS = "https://example.org/elements.php?GROUP=amateur&FORMAT=json"


def test_nothing_is_fetched_or_served_unless_it_is_asked_for() -> None:
    sky = parse("", "test").sky
    assert (sky.fetch, sky.serve, sky.allow) == ([], None, None)


def test_one_address_needs_no_list() -> None:
    assert parse(f'[sky]\nfetch = "{ADDRESS}"', "test").sky.fetch == [ADDRESS]
    both = [ADDRESS, "http://[fd00::5]:8233/elements"]
    assert parse(f"[sky]\nfetch = {both}", "test").sky.fetch == both


@pytest.mark.parametrize(
    "text",
    [
        "example.org/elements",
        "ftp://example.org/elements",
        "file:///etc/passwd",
        "https://",
        "https://me:secret@example.org/elements",
        "http://example.org/two words",
        "http://example.org:99999/elements",
        "http://example.org/\\u00e9l\\u00e9ments",
    ],
)
def test_what_is_no_address_is_told_with_one_that_is(text: str) -> None:
    with pytest.raises(ConfigError, match="must be an address such as"):
        parse(f'[sky]\nfetch = "{text}"', "test")


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (f'fetch = ["{ADDRESS}", "{ADDRESS}"]', "stands there twice: take one out"),
        ('serve = "8233"', 'must be "host:port"'),
        ('allow = ["192.168.1.0/24"]', 'allow is for serve, which says where others fetch: serve = "0.0.0.0:8233"'),
        ('serve = "0.0.0.0:8233"\nallow = ["home"]', "must be an address or a network"),
    ],
)
def test_other_mistakes(text: str, told: str) -> None:
    with pytest.raises(ConfigError) as mistake:
        parse(f"[sky]\n{text}", "test")
    assert told in str(mistake.value)
