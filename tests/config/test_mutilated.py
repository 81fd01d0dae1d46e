"""The shipped files after clumsy hands: whatever was done to one, it loads as it reads, or says what is wrong."""

from __future__ import annotations

import tomllib
from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import CliRunner
from hypothesis import given, settings
from hypothesis import strategies as st

from rotator.config.load import SIMULATED, ConfigError, parse, profiles, shipped
from rotator.config.model import Config
from tests.search import examples

FILES = [shipped(name) for name in (SIMULATED, *profiles())]
STRAY = st.sampled_from(
    [*"[]{}\"'=#,.;:°\\\t\r\u00a0“”\u200b\0ä*-_ ", "\n", "[[", "]]", '"""', "0,5", "[link]", "\n[link]\n", "= ", "COM3"]
)

VALUES = [
    *("0,5", '"x"', "x", "10 deg", "-1e9", "true", "yes", "[]", "[[1, 2]]", "{}", "", "nan", "{ a = 1 }", "[{}]"),
    *("1979-05-27", '[1, "x", [true]]', "0x48", "inf", '"""\nx\n"""'),
]

Rows = list[str]
Clumsy = Callable[[st.DataObject, Rows], None]


def row(data: st.DataObject, rows: Rows) -> int:
    return data.draw(st.integers(0, len(rows) - 1))


def delete(data: st.DataObject, rows: Rows) -> None:
    if len(rows) > 1:
        rows.pop(row(data, rows))


def double(data: st.DataObject, rows: Rows) -> None:
    rows.insert(row(data, rows), rows[row(data, rows)])


def swap(data: st.DataObject, rows: Rows) -> None:
    one, other = row(data, rows), row(data, rows)
    rows[one], rows[other] = rows[other], rows[one]


def comma_for_point(data: st.DataObject, rows: Rows) -> None:
    at = row(data, rows)
    rows[at] = rows[at].replace(".", ",", 1)


def stray(data: st.DataObject, rows: Rows) -> None:
    at = row(data, rows)
    column = data.draw(st.integers(0, len(rows[at])))
    rows[at] = rows[at][:column] + data.draw(STRAY) + rows[at][column:]


def lose(data: st.DataObject, rows: Rows) -> None:
    at = row(data, rows)
    begin = data.draw(st.integers(0, len(rows[at])))
    rows[at] = rows[at][:begin] + rows[at][begin + data.draw(st.integers(1, 12)) :]


def another_value(data: st.DataObject, rows: Rows) -> None:
    at = row(data, rows)
    key, sign, _ = rows[at].partition("=")
    if sign:
        rows[at] = f"{key}= {data.draw(st.sampled_from(VALUES))}"


CLUMSY: list[Clumsy] = [delete, double, swap, comma_for_point, stray, lose, another_value]


def mutilated(data: st.DataObject) -> str:
    rows = data.draw(st.sampled_from(FILES)).split("\n")
    for clumsy in data.draw(st.lists(st.sampled_from(CLUMSY), min_size=1, max_size=4)):
        clumsy(data, rows)
    return "\n".join(rows)


@settings(max_examples=examples(200), deadline=None)
@given(data=st.data())
def test_it_loads_as_it_reads_or_says_in_which_line_the_mistake_is(data: st.DataObject) -> None:
    text = mutilated(data)
    try:
        config = parse(text, "mine.toml")
    except ConfigError as wrong:
        mistakes = wrong.mistakes
    else:
        assert config == Config.model_validate(tomllib.loads(text))
        return
    assert mistakes
    count = text.count("\n") + 1
    for mistake in mistakes:
        assert mistake.text
        assert str(mistake).isprintable(), str(mistake)
        assert all(1 <= line <= count for line in mistake.lines)
        # Only what the file lacks has no line.
        assert mistake.lines or "needs" in mistake.text or "GPIO" in mistake.text or "must" in mistake.text, mistake
    assert [mistake.place for mistake in mistakes] == sorted(mistake.place for mistake in mistakes)


@settings(max_examples=examples(100), deadline=None)
@given(text=st.text(st.sampled_from("[]{}=\"'#,.-_ \n\tab01°\r\0\u00a0"), max_size=60))
def test_any_characters_at_all(text: str) -> None:
    try:
        config = parse(text, "mine.toml")
    except ConfigError as wrong:
        mistakes = wrong.mistakes
    else:
        assert config == Config.model_validate(tomllib.loads(text))
        return
    assert mistakes


@pytest.mark.parametrize("data", [b"", b"\xff\xfe[", b"\x80", b"[azimuth\n", b"\0", b"[[link]]\n", b"a = [" * 2000])
def test_a_command_ends_with_2_and_without_a_traceback(tmp_path: Path, data: bytes) -> None:
    from rotator.cli.main import cli

    path = tmp_path / "mine.toml"
    path.write_bytes(data)
    result = CliRunner().invoke(cli, ["off", "--config", str(path)])
    assert isinstance(result.exception, ConfigError)
