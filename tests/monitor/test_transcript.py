"""The form of a transcript: what a person reads is, byte for byte, what was said."""

from __future__ import annotations

from datetime import datetime

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from rotator.exchange.sources import Source
from rotator.monitor.transcript import (
    At,
    LinkNote,
    NotATranscript,
    Peer,
    Piece,
    Remark,
    Way,
    encode_at,
    encode_link,
    encode_peer,
    encode_piece,
    parse,
    unescape,
)
from tests.tables import every_row

MOMENT = datetime(2026, 11, 21, 18, 3, 22, 114_600)
BOX = Source("gs232b", 1)


@every_row(
    ("data", "line"),
    [
        (b"W235 025\r", r"18:03:22.114 gs232b#1 > W235 025\r"),
        (b"\\dump_state\n", r"18:03:22.114 gs232b#1 > \\dump_state\n"),
        (b"AZ EL ", r"18:03:22.114 gs232b#1 > AZ EL\x20"),
        (b"\t#\0\xff<>", r"18:03:22.114 gs232b#1 > \t#\x00\xff<>"),
        (b"\\hex 57", r"18:03:22.114 gs232b#1 > \\hex 57"),
    ],
)
def test_a_piece_as_text(data: bytes, line: str) -> None:
    assert encode_piece(MOMENT, BOX, Way.IN, data) == line
    assert parse(line) == Piece(64_800 + 3 * 60 + 22.114, BOX, Way.IN, data)


def test_a_piece_of_a_binary_protocol() -> None:
    line = encode_piece(MOMENT, Source("md01"), Way.OUT, b"W\x05\x09\x20", text=False)
    assert line == r"18:03:22.114 md01 < \hex 57 05 09 20"
    assert parse(line) == Piece(64_800 + 3 * 60 + 22.114, Source("md01"), Way.OUT, b"W\x05\x09\x20")


def test_what_is_no_piece() -> None:
    note = LinkNote("my link", {"protocol": "gs232b", "tcp": "[::1]:4001"})
    assert parse(encode_link(note)) == note
    assert encode_at(At(235.0, -0.001, "my link#2")) == "# at 235.00 0.00, under my link#2"
    assert parse("# at 235.00 -0.5, under my link#2") == At(235.0, -0.5, "my link#2")
    assert parse("# at 235 25") == At(235.0, 25.0)
    assert parse("# 12 lines left out here: read too slowly") == Remark("12 lines left out here: read too slowly")
    assert parse("") == Remark("")


@given(
    st.binary(min_size=1, max_size=60),
    st.sampled_from(Way),
    st.booleans(),
    st.builds(Source, st.sampled_from(["gs232b", "my link", "a:b"]), st.integers(0, 999)),
)
@example(b" ", Way.IN, True, BOX)
@example(b"> < # at 1 2", Way.OUT, True, BOX)
def test_it_round_trips_in_one_line_of_printable_characters(data: bytes, way: Way, text: bool, source: Source) -> None:
    line = encode_piece(MOMENT, source, way, data, text=text)
    assert line.isascii()
    assert line.isprintable()
    assert line == line.rstrip()
    piece = parse(line)
    assert isinstance(piece, Piece)
    assert (piece.source, piece.way, piece.data) == (source, way, data)


@every_row(
    "line",
    [
        "W235 025",
        "18:03 gs232b#1 > C2",
        "18:03:22.114 gs232b#1 = C2",
        r"18:03:22.114 gs232b#1 > \q",
        r"18:03:22.114 gs232b#1 > \x5",
        r"18:03:22.114 gs232b#1 > \hex 5",
        "18:03:22.114 gs232b#1 > ü",
        '# link gs232b {"protocol": }',
    ],
)
def test_what_is_no_transcript_is_said_to_be_none(line: str) -> None:
    with pytest.raises(NotATranscript):
        parse(line)


def test_the_fault_is_shown_where_it_is() -> None:
    with pytest.raises(NotATranscript, match="character 3 is no escape"):
        unescape(r"C2\y")


def test_the_machine_of_a_connection() -> None:
    peer = Peer(Source("rotctld", 2), "192.168.1.20")
    assert encode_peer(peer) == "# rotctld#2 comes from 192.168.1.20"
    assert parse(encode_peer(peer)) == peer
