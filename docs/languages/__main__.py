"""`make languages`: brings each catalogue up to date with the texts of the page, its sentences and the display.

`--check` changes nothing, names what has no translation or cannot be shown, and ends with 1 if there is any.
"""

from __future__ import annotations

import re
import sys
from collections import Counter
from collections.abc import Iterable
from functools import cache

from babel.messages.catalog import Catalog, Message
from babel.messages.pofile import read_po, write_po

from docs.languages import page_texts, sentences
from rotator.languages import DISPLAY, LANGUAGES, VIEWS

FOLDER = sentences.ROOT / "rotator/languages"
STATIC = sentences.ROOT / "rotator/web/static"
SINGLE = (
    # Of stop.js.
    *("NOT HEARD: use the box's own switch", "not heard yet: trying again", "trying again"),
    *(
        "azimuth",
        "elevation",
        "and",
        "AZIMUTH",
        "ELEVATION",
        "TURNING",
        "AT REST",
        "ON TARGET",
        "{0} ON TARGET, {1} AT REST",
    ),
    *(
        "FAULT {0}",
        "UNCALIBRATED {0}",
        "closed",
        "waiting",
        "ready",
        "listening",
        "open",
        "connecting",
        "connected",
        "pot",
    ),
    *(
        "CUT MOTOR POWER!",
        "CUT THE MOTOR POWER",
        "SWITCH IT OFF!",
        "{0}, limit {1}",
        "{0} (rotator help {1})",
        "on",
        "off",
        "doubted",
        "today",
    ),
    *("N", "NE", "E", "SE", "S", "SW", "W", "NW", "now", "done", "good", "warning", "errors", "simulated"),
    *(
        "the plan rests for {0} more, {1}",
        "no internet here, or the server's name is wrong",
        "{0} warning",
        "{0} warnings",
        "{0} satellite",
        "{0} satellites",
        "AUTO",
        "MANUAL",
        "JOG",
        "PARK",
        "next",
        "North",
        "East",
        "South",
        "West",
        "Yes",
        "Back",
        "Directions",
        "Times",
        "Limits",
    ),
    *(f"Turn it {way}." for way in ("clockwise", "up")),
    *(f"Now turn it back, {way}." for way in ("counter-clockwise", "down")),
    *(f"Did the antenna turn {way}?" for way in ("clockwise, seen from above", "up")),
    *(f"Did it turn back, {way}?" for way in ("counter-clockwise", "down")),
    *("AOS in {0}", "LOS in {0}", "begins in {0}", "ends in {0}"),
    *("clockwise", "counter-clockwise", "up", "down", "UP", "DOWN"),
)
"""Words that are no sentence, so that nothing finds them by itself."""
OF_SETUP = (
    *("whole", "bus", "address", "input", "none", "N1MM Logger+, by UDP"),
    "The file begins as the shipped one of this rotor. `rotator help wiring` shows each.",
    "One is enough to begin; a [[link]] more for each other. `rotator help programs` lists them all.",
    "The Pi can be a COM port of the PC: `sudo rotator setup usb-serial` makes it one.",
    *(f"{{0}} = {{1}}: must be {expected}" for expected in ("a number", "a whole number", "one of {2}")),
    *(f"{{0}} = {{1}}: must be {less} than or equal to {{2}}" for less in ("less", "greater")),
    *(f"{{0}} = {{1}}: must be {less} than {{2}}" for less in ("less", "greater")),
    "{0}: must be given",
)
OF_THE_DOCTOR = (
    *("free", "awake", "calibrated", "a place", "under-voltage", "throttled", "simulated: {0}"),
    *("64-bit", "32-bit", "{0}: 0x{1} answers"),
    *("over the top the antenna meets {0} too", "{0} stands on the other turn of the azimuth too"),
)
"""What else these views say that nothing finds by itself."""
_MANY = re.compile(r"^(\{0\} [a-z]+)s\b")
"""How a message for many things begins: that for one thing, if the program has it, stands in the same entry."""
COLUMNS = re.compile(r"[ -\[\]-}]*")
"""What both character sets of an HD44780 have: ASCII without the backslash and the tilde."""


@cache
def texts() -> dict[tuple[str, str], str]:
    """Each message with its context (`display`, a view of the page, or none), and where it stands."""
    found: dict[tuple[str, str], str] = {}
    display = sentences.display_texts()
    for path in sorted(STATIC.glob("*.js")):
        if path.name != "stop.js":
            found |= {(text, ""): path.name for text in page_texts.messages(path.read_text(encoding="utf-8"))}
    found |= {(text, ""): "faults.py" for text in sentences.fault_texts()}
    found |= {(text, ""): "words.py" for text in SINGLE}
    for view, rooms in sentences.ROOMS.items():
        for path in [path for room in rooms for path in sentences.files(room)]:
            here = {(text, view): path.name for text in sentences.messages(path) if text not in display}
            found |= {each: name for each, name in here.items() if (each[0], "") not in found}
    for view, where, there in (
        ("setup", "settings", sentences.meanings()),
        ("setup", "programs.py", [*sentences.of_programs(), *OF_SETUP]),
        ("doctor", "checks.py", [*sentences.names_of_checks(), *OF_THE_DOCTOR]),
    ):
        found |= {(text, view): where for text in there if (text, "") not in found}
    return found | {(text, DISPLAY): f"display, {width} columns" for text, width in display.items()}


def plurals(messages: Iterable[str]) -> dict[str, str]:
    """The message for many things by that for one thing."""
    known = set(messages)
    pairs = ((_MANY.sub(r"\1", text), text) for text in known if _MANY.match(text))
    return {one: many for one, many in pairs if one in known}


def read(language: str) -> Catalog:
    path = FOLDER / f"{language}.po"
    if not path.exists():
        return Catalog(language, project="gs232-rotator", charset="utf-8")
    with path.open("rb") as file:
        return read_po(file, language, charset="utf-8")


def written(language: str) -> None:
    """The catalogue with today's messages: what is translated stays, what is no message any more goes."""
    before = read(language)
    now = Catalog(language, header_comment=f"# The {language} words of gs232-rotator: see CONTRIBUTING.md, Languages.")
    now.mime_headers[:] = []
    many = plurals(text for text, _ in texts())
    for (text, context), where in sorted(texts().items(), key=lambda each: (each[0][1], each[1], each[0][0])):
        old = before.get(text, context or None) or next(
            # A text has moved from a view to all of them, or the other way.
            (each for view in ("", *VIEWS) if context != DISPLAY and (each := before.get(text, view or None))),
            None,
        )
        if text in many.values():
            continue
        now.add(
            (text, many[text]) if text in many else text,
            old.string if old and isinstance(old.string, tuple) is (text in many) else "",
            auto_comments=[where],
            flags=old.flags if old else (),
            context=context or None,
        )
    with (FOLDER / f"{language}.po").open("wb") as file:
        write_po(file, now, width=0, omit_header=True)


def mistakes(language: str) -> list[str]:
    """What is wrong with a catalogue, in sentences."""
    catalogue, display = read(language), sentences.display_texts()
    found = []
    many = plurals(text for text, _ in texts()).values()
    for text, context in texts():
        if text in many:
            continue
        message = catalogue.get(text, context or None)
        found += [
            f"{language}: {problem}: {text!r}"
            for problem in _wrong(text, message, display.get(text, 0) if context == DISPLAY else 0)
        ]
    return found


def _wrong(text: str, message: Message | None, columns: int) -> list[str]:
    forms = () if message is None else message.string if isinstance(message.string, tuple) else (message.string,)
    if message is None or not all(forms) or message.fuzzy:
        return ["no translation"]
    return [problem for told in forms for problem in _wrong_in(text, str(told), columns)]


def _wrong_in(text: str, told: str, columns: int) -> list[str]:
    found = []
    if Counter(re.findall(r"\{\d+\}", text)) != Counter(re.findall(r"\{\d+\}", told)):
        found.append("other placeholders")
    if ("<" in told and "<" not in text) or ('"' in told and '"' not in text):
        found.append("a sign that would end a tag")
    if columns and len(told) > columns:
        found.append(f"{told!r} has more than {columns} columns")
    if columns and not COLUMNS.fullmatch(told):
        found.append(f"{told!r} has signs that the display lacks")
    return found


def main(words: list[str]) -> int:
    others = [language for language in LANGUAGES if language != "en"]
    if "--check" in words:
        wrong = [line for language in others for line in mistakes(language)]
        print("\n".join(wrong) or "Every text is translated.")
        return 1 if wrong else 0
    for language in others:
        written(language)
        print(f"{language}: {sum('no translation' in line for line in mistakes(language))} texts without translation")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
