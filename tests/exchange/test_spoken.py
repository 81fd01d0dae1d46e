"""Names of senders, as a person reads them."""

from __future__ import annotations

from rotator.exchange.sources import MQTT, PERSONS, TRACKER, Source
from rotator.exchange.spoken import sender, short_sender, spoken
from tests.tables import every_row


@every_row(
    ("text", "read"),
    [
        (f"stopped by {Source('console', 12)}: nothing moves", "stopped by a rotator command: nothing moves"),
        (f"{Source('console', 1)}, in a storm park", "a rotator command, in a storm park"),
        (str(Source("gs232b", 3)), "gs232b#3"),
        ("stopped by keyboard, in a storm park", "stopped by the keyboard, in a storm park"),
        (
            "orders from mqtt are ignored: stopped by panel",
            "orders from Home Assistant (MQTT) are ignored: stopped by the panel",
        ),
        ("panel holds the antenna", "the panel holds the antenna"),
        (
            "the page is full; no panel, no keyboard; stopped by panel-2",
            "the page is full; no panel, no keyboard; stopped by panel-2",
        ),
        ("page#2 has set the mode, panel moves the antenna", "the page has set the mode, the panel moves the antenna"),
        ("", ""),
    ],
)
def test_a_command_is_called_so_and_every_other_sender_by_its_name(text: str, read: str) -> None:
    assert spoken(text) == read
    assert spoken(read) == read, "a text that was made for a person stays as it is"


SAID = {
    "keyboard": ("the keyboard", "KEYBOARD"),
    "console#3": ("a rotator command", "COMMAND"),
    "page#2": ("the page", "PAGE"),
    "panel": ("the panel", "PANEL"),
    "calibrate": ("the calibration", "CALIBRATE"),
    "mqtt": ("Home Assistant (MQTT)", "MQTT"),
    "track": ("the box itself", "THE BOX"),
    "rotctld#4": ("rotctld", "ROTCTLD"),
    "the damaged state file": ("the damaged state file", "DAMAGED STATE FILE"),
    "Anna": ("Anna", "ANNA"),
}


@every_row("name", SAID)
@every_row("rest", ["", " before the restart", ", in a storm park"])
def test_each_sender_has_one_word(name: str, rest: str) -> None:
    said, short = SAID[name]
    assert sender(name + rest) == said + rest
    assert short_sender(name + rest).startswith(short)
    if name.partition("#")[0] in PERSONS:
        assert spoken(f"stopped by {name}{rest}: nothing moves") == f"stopped by {said}{rest}: nothing moves"


def test_every_kind_of_person_has_a_word() -> None:
    assert {name.partition("#")[0] for name in SAID} >= {*PERSONS, MQTT, TRACKER}


@every_row(
    ("host", "said"),
    [
        ("10.99.14.2", "rotctld, from 10.99.14.2"),
        ("::ffff:10.99.14.2", "rotctld, from 10.99.14.2"),
        ("127.0.0.1", "rotctld, from this computer"),
        ("::1", "rotctld, from this computer"),
        ("fe80::1", "rotctld, from fe80::1"),
        ("", "rotctld"),
    ],
)
def test_a_program_is_known_by_its_machine(host: str, said: str) -> None:
    assert sender("rotctld#4", host) == said
