"""What a receiver answers for its strength: Hamlib's rigctld's lines, and what is none."""

from __future__ import annotations

import pytest

from rotator.calibrating.receiver import BadAddress, NoStrength, address, question, strength_db, wants_vfo
from tests.tables import every_row


@pytest.mark.parametrize(("answer", "db"), [("-37\n", -37.0), ("0\n", 0.0), ("+12\r\n", 12.0), ("-54.5\n", -54.5)])
def test_a_strength(answer: str, db: float) -> None:
    assert strength_db(answer) == db


@every_row(
    ("answer", "says"),
    [
        ("RPRT -11\n", "has no S meter"),
        ("RPRT -5\n", "is it switched on"),
        ("nan\n", "is that a rigctld?"),
        ("HTTP/1.1 400 Bad Request\n", "is that a rigctld?"),
        ("-37 -38\n", "is that a rigctld?"),
        ("\n", "is that a rigctld?"),
    ],
)
def test_what_is_no_strength(answer: str, says: str) -> None:
    with pytest.raises(NoStrength, match=says.replace("?", r"\?")):
        strength_db(answer)


@pytest.mark.parametrize(
    ("answer", "wants"), [("0\n", False), ("1\n", True), ("CHKVFO 1\n", True), ("RPRT -11\n", False)]
)
def test_one_that_wants_a_vfo_in_each_question_gets_it(answer: str, wants: bool) -> None:
    assert wants_vfo(answer) is wants
    assert b"VFO" in question(names_vfo=True)
    assert b"VFO" not in question(names_vfo=False)


@every_row(
    ("text", "place"),
    [
        ("127.0.0.1:4540", ("127.0.0.1", 4540)),
        ("shack", ("shack", 4532)),
        ("[::1]:4532", ("::1", 4532)),
        ("[::1]", ("::1", 4532)),
        ("::1", ("::1", 4532)),
        ("fe80::2:4540", ("fe80::2:4540", 4532)),
    ],
)
def test_an_address(text: str, place: tuple[str, int]) -> None:
    assert address(text) == place


@every_row("text", ["", ":4532", "shack:", "shack:x", "shack:0", "shack:70000", "/dev/ttyUSB0:"])
def test_no_address(text: str) -> None:
    with pytest.raises(BadAddress, match=r"write it as 127\.0\.0\.1:4532"):
        address(text)
