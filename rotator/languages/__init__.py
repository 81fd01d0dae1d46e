"""The catalogues of the page's and the display's words, one for each language, and which one a reader gets.

A catalogue is a `.po` file as gettext, Babel and every translator's program know it; it is read as it is, so a box
needs none of these. The texts themselves are English, and what has no translation stays so. `make languages` brings the
catalogues up to date. Knows no text and no screen.
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Literal, get_args

from rotator.exchange.foreign import json_of

Language = Literal["en", "de", "fr", "es", "it", "pt", "cs"]
Wanted = Literal["auto", "en", "de", "fr", "es", "it", "pt", "cs"]
"""`auto`: what each reader's browser asks for."""
LANGUAGES: tuple[Language, ...] = get_args(Language)
DISPLAY = "display"
"""The context of the texts for a display of sixteen columns."""
VIEWS = "setup", "doctor"
"""Contexts of the texts that one view of the page shows and no other: they are loaded with that view."""
FORMS = "\v"
"""Between the forms of a message with a count, in the order of gettext: for one thing first, for many last."""
_PART = re.compile(r'^(msgctxt|msgid|msgid_plural|msgstr(?:\[\d\])?) ((?:"(?:[^"\\]|\\.)*"\s*)+)', re.MULTILINE)
_QUOTED = re.compile(r'"((?:[^"\\]|\\.)*)"')


@cache
def catalogue(language: str, context: str = "") -> Mapping[str, str]:
    """The translations by their English text; none for English. An unsure one (`fuzzy`) does not count.

    A message with a count stands there for one thing and for many, and has all forms of the language.
    """
    if language not in LANGUAGES or language == "en":
        return {}
    text = Path(__file__).with_name(f"{language}.po").read_text(encoding="utf-8")
    found: dict[str, str] = {}
    for block in text.split("\n\n"):
        parts = {name: "".join(map(_text, _QUOTED.findall(quoted))) for name, quoted in _PART.findall(block)}
        unsure = block.startswith("#, fuzzy") or "\n#, fuzzy" in block
        forms = [told for name, told in parts.items() if name.startswith("msgstr")]
        if all(forms) and parts.get("msgctxt", "") == context and not unsure:
            found |= {text: FORMS.join(forms) for name, text in parts.items() if name.startswith("msgid")}
    return found


def _text(quoted: str) -> str:
    return str(json_of(f'"{quoted}"'))


def reader_language(wanted: Wanted, accepted: str) -> Language:
    """The language for a reader whose browser sends `accepted` as its Accept-Language."""
    if wanted != "auto":
        return wanted
    ranked = []
    for at, part in enumerate(accepted[:200].replace(" ", "").split(",")):
        name, _, quality = part.partition(";q=")
        try:
            ranked.append((-float(quality or 1), at, name.partition("-")[0].lower()))
        except ValueError:
            continue
    names = (name for _, _, name in sorted(ranked))
    return next((each for name in names for each in LANGUAGES if each == name), "en")


def module(language: Language, view: str = "") -> bytes:
    """The catalogue, or what only this view of the page needs, as the page imports it: the keys in one text, the
    translations in another, a line each.

    A message without values is looked for as it stands: five letters tell it from all others.
    """
    told = catalogue(language, view)
    order = sorted(told, key=lambda text: ("{0}" in text, text))
    keys = json.dumps("\n".join(text if "{0}" in text else short(text) for text in order), ensure_ascii=False)
    words = json.dumps("\n".join(told[text] for text in order), ensure_ascii=False)
    return f'export const language = "{language}", keys = {keys}.split("\\n"), words = {words}.split("\\n");\n'.encode()


def short(text: str) -> str:
    """A text in five letters or fewer (FNV-1a, 25 bits): words.js does the same."""
    number = 0x811C9DC5
    for sign in text:
        number = ((number ^ ord(sign)) * 0x01000193) & 0xFFFFFFFF
    number, letters = number >> 7, ""
    while number:
        number, digit = divmod(number, 36)
        letters = "0123456789abcdefghijklmnopqrstuvwxyz"[digit] + letters
    return letters or "0"
