"""A stream of bytes cut into lines: every line end, any pieces, bounded memory."""

from __future__ import annotations

from hypothesis import given, settings
from hypothesis import strategies as st

from rotator.protocols.lines import LineReader
from tests.search import examples
from tests.tables import every_row

LIMIT = 8


@every_row(
    ("stream", "lines"),
    [
        (b"C2\r", [b"C2"]),  # Hamlib
        (b"C2\n", [b"C2"]),  # Termite, set so
        (b"C2\r\n", [b"C2"]),  # SDRangel
        (b"\r\n\r\n", [b"", b""]),
        (b"\r\r\n\n", [b"", b"", b""]),
        (b"S\r\r", [b"S", b""]),  # Hamlib's GS-232B ends each command twice
        (b"\n\r", [b"", b""]),
        (b"A\rE\nS\r", [b"A", b"E", b"S"]),
        (b"\0\xff\x1b\r", [b"\0\xff\x1b"]),
        (b"C2", []),
        (b"", []),
    ],
)
def test_cr_and_lf_both_end_a_line(stream: bytes, lines: list[bytes]) -> None:
    assert LineReader(LIMIT).feed(stream) == lines


def test_flush_ends_the_line_where_it_is() -> None:
    reader = LineReader(LIMIT)
    reader.feed(b"p")
    assert reader.flush() == b"p"
    assert reader.pending == b""
    reader.feed(b"Z" * 9)
    assert reader.flush() is None
    assert reader.feed(b"p\n") == [b"p"]


@settings(max_examples=examples(200), deadline=None)
@given(st.lists(st.lists(st.sampled_from([b"\r", b"\n", b"W", b"2", b" "]), max_size=30).map(b"".join)))
def test_pieces_make_no_difference_and_memory_is_bounded(pieces: list[bytes]) -> None:
    reader = LineReader(LIMIT)
    lines = []
    for piece in pieces:
        lines += reader.feed(piece)
        assert len(reader.pending) <= LIMIT
    spoken = b"".join(pieces).replace(b"\r\n", b"\r").replace(b"\n", b"\r").split(b"\r")[:-1]
    assert lines == [line if len(line) <= LIMIT else None for line in spoken]
