"""The names of senders as a person reads them: one word for each, the same on the screen, the display, the page and in
the log.

Knows the form of such a name, and the words for a stop or a storm park that it has ordered. Objects for programs keep
the name itself, which tells two connections apart: `console#8` is a command that a person typed in a terminal, `page#2`
a browser on the box's page, `rotctld#3` a program's third connection. Does not know who may give which order.
"""

from __future__ import annotations

import re

COMMAND, PAGE = "a rotator command", "the page"
_PERSONS = {
    "keyboard": ("the keyboard", "KEYBOARD"),
    "console": (COMMAND, "COMMAND"),
    "page": (PAGE, "PAGE"),
    "panel": ("the panel", "PANEL"),
    "calibrate": ("the calibration", "CALIBRATE"),
    "mqtt": ("Home Assistant (MQTT)", "MQTT"),
    "track": ("the box itself", "THE BOX"),
}
"""By the name of a sender: what a person reads, and what a display of sixteen characters has room for."""
_NAMES = "|".join(_PERSONS)
_NUMBERED = re.compile(r"\b(console|page)#[0-9]+")
_PLAIN = re.compile(
    rf"(?<=\bby )(?:{_NAMES})\b(?![#-])|(?<=\borders from )(?:{_NAMES})\b(?![#-])"
    rf"|(?<!\bthe )\b(?:{_NAMES})(?= moves the antenna| holds the antenna| has set the mode)"
)
"""A name without a number is an English word too: it is a name only where one stands."""
_HERE = ("127.", "::1")


def held(*, storm: bool) -> tuple[str, str]:
    """What holds the antenna until a person releases it, and what that means. Between the two stands the sender."""
    return (
        ("storm park by", "nothing else moves it until resume")
        if storm
        else ("stopped by", "nothing moves until resume")
    )


def held_by(sender: str, *, storm: bool) -> str:
    what, until = held(storm=storm)
    return f"{what} {sender}: {until}"


def spoken(text: str) -> str:
    """A text for a person, with its senders' names as a person says them."""
    text = _NUMBERED.sub(lambda found: _PERSONS[found[1]][0], text)
    return _PLAIN.sub(lambda found: _PERSONS[found[0]][0], text)


def sender(name: str, host: str = "") -> str:
    """One sender as a person says it. `host`: the address of the machine it is connected from; empty: not known."""
    plain, number, rest = _parts(name)
    if plain in _PERSONS:
        return _PERSONS[plain][0] + rest
    if host:
        return f"{plain}, from {'this computer' if host.startswith(_HERE) else host.removeprefix('::ffff:')}{rest}"
    return plain + rest if number else name


def short_sender(name: str) -> str:
    """The same for a small display: in capitals, one word where there is one."""
    plain, _, rest = _parts(name)
    return _PERSONS[plain][1] if plain in _PERSONS else (plain + rest).removeprefix("the ").upper()


def _parts(name: str) -> tuple[str, str, str]:
    """`console#2 before the restart`: the name, the number, the rest."""
    found = re.match(r"([^#,\s]+)#?([0-9]*)(.*)", name, re.DOTALL)
    return (found[1], found[2], found[3]) if found else (name, "", "")
