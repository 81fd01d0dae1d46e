"""Texts of strangers that are small and cost much: each is refused before its reader sees it, and costs little."""

from __future__ import annotations

import ast
import io
import json
import tracemalloc
import zipfile
from pathlib import Path

import pytest

from rotator.backup.content import ABOUT, CONFIGURATION, BackupError, check
from rotator.config.load import ConfigError, parse
from rotator.exchange.foreign import DEEPEST, LONGEST_TOML, TooMuchError, json_of, toml_of, xml_of
from tests.tables import every_row

ROOT = Path(__file__).parents[2]
DOTTED = ".".join(["a"] * 20_000)
TOML = {
    "a key of many parts": f"{DOTTED} = 1",
    "with blanks": " . ".join(["a"] * 20_000) + " = 1",
    "each part in quotes, with the marks that end a key": ".".join(['"="'] * 20_000) + " = 1",
    "with quotes in the quotes": ".".join([r'"\""'] * 9_000) + " = 1",
    "a heading": f"[{DOTTED}]",
    "in a table of one line": f"x = {{{DOTTED} = 1}}",
    "behind a long text that ends in five quotes": f'x = {{y = """a""""" , {DOTTED} = 1}}',
    "behind one in plain marks": f"x = {{y = '''a''''' , {DOTTED} = 1}}",
    "a list of lists": "x = " + "[" * 20_000,
    "a list over lines": "x = [\n" * 20_000,
    "tables in tables": "x = " + "{a = " * 20_000,
    "many lines": "a = 1\n" * 60_000,
}


@every_row("what", TOML)
def test_no_toml_takes_the_box(what: str) -> None:
    tracemalloc.start()
    try:
        with pytest.raises(TooMuchError):
            toml_of(TOML[what])
        with pytest.raises(ConfigError) as told:
            parse(TOML[what], "rotator.toml")
        _, most_bytes = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert most_bytes < 40 * len(TOML[what]) + 4_000_000  # with 8 bytes for each pair of parts it was gigabytes
    assert len(told.value.mistakes) == 1


def test_a_small_backup_with_such_a_file_is_refused() -> None:
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as file:
        file.writestr(ABOUT, '{"format": "rotator backup 1"}')
        file.writestr(CONFIGURATION, f"{DOTTED}=1")
    assert len(packed.getvalue()) < 400
    with pytest.raises(BackupError, match="a key of more than 32 parts"):
        check(packed.getvalue())


def test_what_people_write_is_read() -> None:
    deep = "x = " + "[" * DEEPEST + "]" * DEEPEST
    assert toml_of(deep)
    text = 'a = "' + ". " * 99 + '"  # ' + "[" * 99 + "\n" + "b = [" + "0.5, " * 99 + "]\nc.d.e = 1.5\n"
    assert toml_of(text)["c"] == {"d": {"e": 1.5}}
    assert len(toml_of("a = '" + "x" * (LONGEST_TOML - 6) + "'")) == 1
    assert json_of(json.dumps({"name": "[" * 99 + '\\"' * 99})) == {"name": "[" * 99 + '\\"' * 99}


@every_row("text", ["[" * 500, '{"a":' * 500, '["' + '\\"' * 9 + '",' + "[" * 500, "1" * 5000, b"\xff[]"])
def test_no_json_ends_its_reader(text: str | bytes) -> None:
    """Python's own reader takes five hundred brackets, and who shows the value of it then fails."""
    with pytest.raises(ValueError):  # noqa: PT011 - of any kind
        json_of(text)


LAUGHS = "".join(f'<!ENTITY l{n} "{f"&l{n - 1};" * 10}">' for n in range(1, 10))


@every_row(
    "text",
    [
        f'<?xml version="1.0"?><!DOCTYPE a [<!ENTITY l0 "ha">{LAUGHS}]><a>&l9;</a>',
        '<!DOCTYPE a [<!ENTITY x SYSTEM "file:///etc/hostname">]><a>&x;</a>',
        '<!DOCTYPE a SYSTEM "http://example.org/a.dtd"><a/>',
        "<a>" * 100_000,
        "<a>&x;</a>",
        "",
    ],
)
def test_no_xml_grows_or_fetches(text: str) -> None:
    with pytest.raises(ValueError):  # noqa: PT011 - of any kind
        xml_of(text)


def test_a_text_of_others_is_read_in_one_place() -> None:
    readers = {"loads", "load", "parse", "fromstring", "XMLParser", "iterparse"}
    elsewhere = [
        f"{path.relative_to(ROOT)}:{node.lineno}"
        for path in sorted((ROOT / "rotator").rglob("*.py"))
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.Attribute)
        and node.attr in readers
        and isinstance(node.value, ast.Name)
        and node.value.id in ("json", "tomllib", "ElementTree", "pickle", "marshal", "yaml")
        and path.name != "foreign.py"
    ]
    assert elsewhere == []
