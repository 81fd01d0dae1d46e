"""The catalogues: which one a reader gets, and what no translation may do. What is missing: `make languages-check`."""

from __future__ import annotations

import pytest

from docs.languages.__main__ import mistakes, texts
from rotator.languages import DISPLAY, LANGUAGES, Wanted, catalogue, module, reader_language, short

OTHERS = [language for language in LANGUAGES if language != "en"]


@pytest.mark.parametrize(
    ("wanted", "accepted", "language"),
    [
        ("auto", "de-AT,de;q=0.9,en;q=0.8", "de"),
        ("auto", "pl,cs;q=0.5,fr;q=0.7", "fr"),
        ("auto", "en-GB,de;q=0.9", "en"),
        ("auto", "cs; q=0.5, fr ; q=0.7", "fr"),
        ("auto", "pt-BR", "pt"),
        ("auto", "xx, de;q=what", "en"),
        ("auto", "", "en"),
        ("cs", "de", "cs"),
        ("en", "de", "en"),
    ],
)
def test_the_language_of_a_reader(wanted: Wanted, accepted: str, language: str) -> None:
    assert reader_language(wanted, accepted) == language


@pytest.mark.parametrize("language", OTHERS)
def test_what_is_translated_keeps_its_values_and_fits_the_display(language: str) -> None:
    assert [line for line in mistakes(language) if "no translation" not in line] == []


def test_no_two_messages_have_the_same_key() -> None:
    messages = [text for text, context in texts() if context != DISPLAY]
    assert len(set(messages)) == len(messages), "twice: of all views, and of one"
    assert len({short(text) for text in messages}) == len(messages)


def test_english_needs_no_catalogue() -> None:
    assert catalogue("en") == catalogue("auto") == {}
    assert b'words = ""' in module("en")
    assert ("STANDS STILL", DISPLAY) in texts()
