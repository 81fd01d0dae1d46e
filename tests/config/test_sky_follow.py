"""`[[sky.follow]]`: targets whose passes are wanted, and what to write instead of what is none."""

from __future__ import annotations

import re

import pytest

from rotator.config.load import ConfigError, parse


def test_a_name_is_enough() -> None:
    (iss,) = parse('[[sky.follow]]\nname = "ISS"\n', "x").sky.follow
    assert (iss.name, iss.priority, iss.min_culmination_deg) == ("ISS", 1.0, 0.0)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("[[sky.follow]]\npriority = 2\n", "the first [[sky.follow]]: name: must be given"),
        (
            "[[sky.follow]]\nname = 25544\n",
            "1 mistake\n  line 2: the first [[sky.follow]]: name = 25544: must be text in quotes",
        ),
        ('[[sky.follow]]\nname = "ISS"\nprio = 2\n', "no such key; did you mean priority?"),
        (
            '[[sky.follow]]\nname = "ISS"\npriority = 0\n',
            "the first [[sky.follow]]: priority = 0: must be greater than 0",
        ),
        ('[[sky.follow]]\nname = "ISS"\nmin_culmination_deg = 91\n', "must be less than or equal to 90"),
        ('[sky.follow]\nname = "ISS"\n', "must be a list in brackets; write [[sky.follow]]"),
        ('[sky]\nfollow = ["ISS"]\n', 'has a table of its own: write [[sky.follow]] and below it name = "ISS"'),
        ('[sky]\nfollow = "ISS"\n', 'has a table of its own: write [[sky.follow]] and below it name = "ISS"'),
        (
            '[[sky.follow]]\nname = "ISS"\n[[sky.follow]]\nname = "iss"\n',
            'follow[1] names "iss", as follow[0] does: take one out',
        ),
    ],
)
def test_what_is_wrong_is_told_with_what_to_write(text: str, said: str) -> None:
    with pytest.raises(ConfigError, match=re.escape(said)):
        parse(text, "x")
