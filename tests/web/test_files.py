"""The page's own files: small, complete, and from nowhere else."""

from __future__ import annotations

import hashlib
import re
from functools import partial

from rotator.languages import LANGUAGES, VIEWS, Language, module
from rotator.web import assets
from tests.tables import every_row

FILES = assets.load()
OURS = sorted(path for path in FILES if "/vendor/" not in path and path != "/" and not path.endswith(".png"))


def test_with_the_words_of_the_longest_language_it_is_below_130_kib() -> None:
    """What counts: every file of the page, and the words that come with it. The words of one view alone come when a
    person opens it, and are counted for themselves."""
    first, *views = (max(map(partial(words, view=view), LANGUAGES)) for view in ("", *VIEWS))
    assert first + sum(len(asset.packed) for path, asset in FILES.items() if path != "/") <= 130 * 1024
    assert max(views) <= 30 * 1024


def words(language: Language, view: str) -> int:
    return len(assets.packed(assets.SCRIPT, module(language, view)).packed)


NAMED = ("www.w3.org", "//THIS-ADDRESS", "celestrak.org")
"""Addresses that no browser asks: of a drawing's language, in a command to type, and from which the box may fetch."""


@every_row("path", OURS)
def test_nothing_is_loaded_from_elsewhere(path: str) -> None:
    text = FILES[path].plain.decode()
    named = [url for url in re.findall(r"(?:https?:)?//[a-zA-Z0-9.-]+", text) if not url.endswith(NAMED)]
    assert [url for url in named if "://" in url] == []


@every_row("path", [path for path in OURS if path.endswith((".js", ".html"))])
def test_what_a_file_names_is_there(path: str) -> None:
    text = FILES[path].plain.decode()
    for name in re.findall(r'(?:from|src=|href=)\s*"(/[^"#]*)"', text):
        assert name in FILES or name == "/language.js" or name.startswith("/api/"), name


def test_each_library_has_its_licence() -> None:
    folder = assets.FOLDER / "vendor"
    for library, file in {"preact": "preact.mjs", "htm": "htm.mjs"}.items():
        assert (folder / file).is_file()
        assert (folder / f"LICENSE-{library}").is_file()


def test_libraries_are_as_they_were_put_in() -> None:
    folder = assets.FOLDER / "vendor"
    lines = [line.split() for line in (folder / "VERSIONS").read_text().splitlines()[3:]]
    named = {file: digest.removeprefix("sha256:") for _, _, file, digest in lines}
    assert named == {
        path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in folder.iterdir() if path.suffix
    }


def test_no_script_or_style_stands_in_the_page_itself() -> None:
    """The content security policy forbids both."""
    page = FILES["/"].plain.decode()
    assert not re.search(r"<script(?![^>]*\bsrc=)", page)
    assert "<style" not in page
    assert " style=" not in page
    assert not re.search(r"\son[a-z]+=", page)


def test_the_colour_of_a_simulated_rotor_is_used_for_nothing_else() -> None:
    style = FILES["/style.css"].plain.decode()
    rules = [line for line in style.splitlines() if "var(--sim)" in line]
    assert rules
    assert all(line.startswith(".sim") for line in rules)
