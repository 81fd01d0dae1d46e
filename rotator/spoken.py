"""The names of senders as a person reads them: `console#8` is a command that a person typed in a terminal, `page#2`
a browser on the box's page.

Knows the form of such a name, and the words for a stop or a storm park that it has ordered. Logs and objects for
programs keep the name itself, which tells two connections apart.
"""

from __future__ import annotations

import re

COMMAND, PAGE = "a rotator command", "the page"
_NAMES = re.compile(r"\b(console|page)#[0-9]+")


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
    return _NAMES.sub(lambda found: COMMAND if found[1] == "console" else PAGE, text)
