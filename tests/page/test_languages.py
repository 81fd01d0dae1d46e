"""The page in the reader's language: what the program finds in its texts, a browser finds too; nothing is cut off."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import pytest
from playwright.sync_api import Page

from docs.languages import __main__ as catalogues
from docs.languages import page_texts
from hw.ports import Axis
from rotator.exchange.faults import Fault, FaultKind
from rotator.languages import FORMS, LANGUAGES, catalogue
from rotator.languages import VIEWS as WITH_WORDS
from tests.page.conftest import Station, pair

STATIC = Path(catalogues.STATIC)
VIEWS = "", "sky", "setup", "doctor", "paired", "wires", "log", "files"
OTHERS = [language for language in LANGUAGES if language != "en"]
CUT = """async (templates) => {
    const { cut } = await import("/words.js");
    return templates.map((texts) => { const found = []; cut(texts, (text) => void found.push(text)); return found; });
}"""
SAID = """async (texts) => {
    const { said, wordsOf } = await import("/words.js");
    await Promise.all(["setup", "doctor"].map(wordsOf));
    return texts.map(said);
}"""
SHOWN = {"setup": ".step", "doctor": ".doctor li", "log": ".log"}
"""What comes later than its view."""
MISSED = 'import("/words.js").then(({ missed }) => [...missed])'
ENGLISH = re.compile(r"\b(?:the|of|and|is|are|its|with|from|must|not|warnings?)\b")
"""No other language of the page has these words."""
CUT_OFF = """() => [...document.querySelectorAll("button, h1, h2, h3, summary, nav a, label, .lamps li, dt")]
    .filter((each) => each.offsetParent && each.scrollWidth > each.clientWidth + 1)
    .filter((each) => getComputedStyle(each).display !== "inline")
    .map((each) => `${each.tagName} ${each.innerText}`)"""


def test_a_browser_finds_the_texts_that_the_catalogues_have(
    start: Callable[..., Station], visit: Callable[..., Page]
) -> None:
    templates = [
        each.texts
        for path in sorted(STATIC.glob("*.js"))
        for each in page_texts.literals(path.read_text(encoding="utf-8"))
        if each.tag == "html"
    ]
    assert len(templates) > 100
    page = visit(start())
    assert page.evaluate(CUT, templates) == [page_texts.cut(texts) for texts in templates]


@pytest.mark.parametrize("language", OTHERS)
def test_a_sentence_is_taken_for_no_other_one(
    start: Callable[..., Station], visit: Callable[..., Page], language: str
) -> None:
    page = visit(start(page=f'language = "{language}"'))
    assert page.evaluate("document.documentElement.lang") == language
    filled: dict[str, str] = {}
    for text, told in [each for view in ("", *WITH_WORDS) for each in catalogue(language, view).items()]:
        if re.search(r"[A-Za-z]{3}", re.sub(r"\{\d+\}", "", text)):
            filled[_with_values(text)] = _with_values(told, text)
    wrong = [
        (text, found, told)
        for (text, told), found in zip(filled.items(), page.evaluate(SAID, list(filled)), strict=True)
        if found != told
    ]
    assert wrong == []


def test_a_count_has_the_form_of_its_language(start: Callable[..., Station], visit: Callable[..., Page]) -> None:
    page = visit(start(page='language = "cs"'))
    counts = ["1 satellite", "3 satellites", "17 satellites", "ISS does not rise within 3 days"]
    told = page.evaluate(SAID, counts)
    assert told[:3] == ["1 družice", "3 družice", "17 družic"]
    assert "3" in told[3], "a message without forms"


def test_sentences_with_names_and_times_are_said_one_after_the_other(
    start: Callable[..., Station], visit: Callable[..., Page]
) -> None:
    page = visit(start(page='language = "de"'))
    english = (
        "Only buttons that this browser holds turn it. Chosen by Anna's phone.",
        "The plan rests for 9:50 min more, after an order of Anna's phone.",
        "azimuth.min_deg = -400.5: must be greater than or equal to -360",
    )
    assert page.evaluate(SAID, english) == [
        "Nur Tasten, die dieser Browser hält, drehen sie. Gewählt von: Anna's phone.",
        "Der Plan ruht noch 9:50 min, nach einem Befehl von Anna's phone.",
        "azimuth.min_deg = -400.5: muss mindestens -360 sein",
    ]


@pytest.mark.parametrize("language", OTHERS)
def test_a_fault_is_said_whole(start: Callable[..., Station], visit: Callable[..., Page], language: str) -> None:
    page, words = visit(start(page=f'language = "{language}"')), catalogue(language)
    seen = "its motor runs {0}, but it stands at {1}°"
    for kind in FaultKind:
        fault = Fault(kind, Axis.AZIMUTH, seen.format("up", "5.0"), "1.0°/s", act_now="CUT MOTOR POWER!")
        (said,) = page.evaluate(SAID, [str(fault)])
        measured = words.get(seen, seen).format(words.get("up", "up"), "5.0")
        for text in (kind.text, measured, "CUT MOTOR POWER!"):
            assert words.get(text, text) in said
        advice = kind.advice.replace("AXIS", "{0}")
        assert words.get(advice, advice).replace("{0}", words.get("azimuth", "azimuth")) in said


def _with_values(text: str, of: str = "") -> str:
    """Numbers in place of values; of two that touch in the English text `of`, the second is a clause."""
    text = text.rsplit(FORMS, maxsplit=1)[-1]
    clauses = re.findall(r"(?<=\})\{(\d+)\}", of or text)
    return re.sub(r"\{(\d+)\}", lambda it: f"{', ' if it[1] in clauses else ''}{17 * (1 + int(it[1]))}", text)


@pytest.mark.parametrize("language", OTHERS)
def test_no_word_is_cut_off_and_no_sentence_is_english(
    start: Callable[..., Station], visit: Callable[..., Page], language: str
) -> None:
    """Each view of a paired browser, on a phone and on a laptop. The log is English."""
    station = start()
    first = visit(station)
    pair(first)
    page = visit(station, locale=language, storage_state=first.context.storage_state())
    found = []
    for view in VIEWS:
        page.goto(f"{station.url}/#{view}")
        page.reload()
        page.locator(SHOWN.get(view, "main")).first.wait_for()
        for step in page.locator(".step > summary").all():
            step.evaluate("summary => summary.click()")
        for width in (320, 390, 1366):
            page.set_viewport_size({"width": width, "height": 900})
            found += [f"#{view}, {width} px: {each}" for each in page.evaluate(CUT_OFF)]
        english = [each for each in page.evaluate(MISSED) if "/" not in each and ENGLISH.search(each)]
        found += [f"#{view}: {each}" for each in english if view != "log"]
    assert found == []
