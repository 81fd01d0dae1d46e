"""A marked block goes into any file and out again, byte for byte."""

from __future__ import annotations

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotator.setup.blocks import Block
from rotator.setup.plan import SetupError

TOP = Block("rotator test", re.compile("ours=[0-9]"))
END = Block("rotator test", re.compile("ours=[0-9]"), last=True)
OTHER = Block("rotator other", re.compile("theirs"))

LINES = (b"[all]", b"[cm4]", b"#dtparam=spi=on", b"dtparam=audio=on", b"", b" caf\xe9", b"\xef\xbb\xbf#")
ENDS = (b"\n", b"\r\n", b"\r", b"")
ANY_FILE = st.one_of(
    st.binary(),
    st.lists(st.tuples(st.sampled_from(LINES), st.sampled_from(ENDS)).map(b"".join)).map(b"".join),
).map(lambda data: data.decode("utf-8", "surrogateescape"))


@pytest.mark.parametrize("block", [TOP, END], ids=["top", "end"])
@given(text=ANY_FILE, count=st.integers(1, 3))
def test_in_and_out_again_is_the_file_as_it_was(block: Block, text: str, count: int) -> None:
    longer = block.into(text, [f"ours={n}" for n in range(count)])
    assert longer != text
    assert block.without(longer) == text


@given(text=ANY_FILE)
def test_in_twice_changes_nothing(text: str) -> None:
    for block in (TOP, END):
        once = block.into(text, ["ours=1"])
        assert block.into(once, ["ours=1"]) == once


@given(text=ANY_FILE, first_out=st.booleans())
def test_two_blocks_leave_in_any_order(text: str, first_out: bool) -> None:
    both = OTHER.into(TOP.into(text, ["ours=1"]), ["theirs"])
    assert (OTHER.without(TOP.without(both)) if first_out else TOP.without(OTHER.without(both))) == text


@pytest.mark.parametrize("block", [TOP, END], ids=["top", "end"])
@given(before=ANY_FILE, after=ANY_FILE)
def test_what_a_person_wrote_around_it_meanwhile_stays(block: Block, before: str, after: str) -> None:
    # An editor that adds lines begins at the beginning of one.
    before += "" if before.endswith("\n") or not before else "\n"
    longer = before + block.into("", ["ours=1"]) + after
    assert block.without(longer) == before + after


def test_what_a_person_wrote_inside_it_stays() -> None:
    text = TOP.into("last\n", ["ours=1"]).replace("ours=1\n", "ours=1\nmine=2\n")
    assert TOP.without(text) == "mine=2\nlast\n"
    assert TOP.strangers(text) == ["mine=2"]


def test_new_lines_come_where_the_old_ones_were() -> None:
    text = "a\n" + TOP.into("b\n", ["ours=1"])
    assert TOP.into(text, ["ours=2"]) == text.replace("ours=1", "ours=2")
    assert TOP.into(text, []) == "a\nb\n"


def test_line_ends_as_in_the_file() -> None:
    assert TOP.into("a\r\n", ["ours=1"]) == "# rotator test: begin\r\nours=1\r\n# rotator test: end\r\na\r\n"


def test_no_line_feed_at_the_end_stays_so() -> None:
    assert END.into("a", ["ours=1"]) == "a\n# rotator test: begin\nours=1\n# rotator test: end"


@pytest.mark.parametrize("mark", ["begin", "end"])
def test_a_mark_alone_is_not_guessed_at(mark: str) -> None:
    with pytest.raises(SetupError, match="by hand"):
        TOP.without(f"a\n# rotator test: {mark}\nb\n")
