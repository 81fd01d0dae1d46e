"""rotctld's extended protocol: any punctuation in front, and the answer comes in records with labels.

Transcripts are of the genuine server 4.5.4 with its dummy rotor.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from rotator.protocols.rotctld import VERBS, Request, encode, requests
from rotator.protocols.rotctld_session import RotctldSession
from tests.tables import every_row

if TYPE_CHECKING:
    from tests.protocols.conftest import BenchBox

EXTENDED = [
    ("+p", "get_pos:\nAzimuth: 235.00\nElevation: 25.00\nRPRT 0\n"),
    (";p", "get_pos:;Azimuth: 235.00;Elevation: 25.00;RPRT 0\n"),
    ("|p", "get_pos:|Azimuth: 235.00|Elevation: 25.00|RPRT 0\n"),
    ("-p", "get_pos:-Azimuth: 235.00-Elevation: 25.00-RPRT 0\n"),
    ("+P 14 7", "set_pos: 14 7\nRPRT 0\n"),
    ("+\\set_pos 14 7", "set_pos: 14 7\nRPRT 0\n"),
    (";P 1000 1000", "set_pos: 1000 1000;RPRT -1\n"),
    ("+S", "stop:\nRPRT 0\n"),
    ("+K", "park:\nRPRT 0\n"),
    ("+R 1", "reset: 1\nRPRT 0\n"),
    ("+M 8 50", "move: 8 50\nRPRT 0\n"),
    ("+v SPEED", "get_level: SPEED\n4\nRPRT 0\n"),
    (";v SPEED", "get_level: SPEED;4\nRPRT 0\n"),
    ("+v FOO", "get_level: FOO\nRPRT -1\n"),
    (";V ?", "set_level: ?;SPEED \nRPRT 0\n"),
    ("+s", "get_status:\nStatus flags: \nRPRT 0\n"),
    ("+w S", "send_cmd: S\nRPRT -11\n"),
    ("+l FN42rh", "loc2lonlat: FN42rh\nLongitude: -70.541667\nLatitude: 42.312500\nRPRT 0\n"),
    ("+L -70.5 42.3 6", "lonlat2loc: -70.5 42.3 6\nLocator: FN42SH\nRPRT 0\n"),
    ("+D 70 30 36 1", "dms2dec: 70 30 36 1\nDec Degrees: -70.510000\nRPRT 0\n"),
    (";d -70.51", "dec2dms: -70.51;Degrees: 70;Minutes: 30;Seconds: 36.000000;S/W: 1;RPRT 0\n"),
    ("+E 70 30.6 0", "dmmm2dec: 70 30.6 0\nDec Deg: 70.510000\nRPRT 0\n"),
    ("+e -70.51", "dec2dmmm: -70.51\nDegrees: 70\nDec Minutes: 30.600000\nS/W: 1\nRPRT 0\n"),
    ("+A 30", "a_sp2a_lp: 30\nLong Path Deg: 210.000000\nRPRT 0\n"),
    ("+a 1000", "d_sp2d_lp: 1000\nLong Path km: 39032.000000\nRPRT 0\n"),
    (
        "+B -70.5 42.3 10.2 50.1",
        "qrb: -70.5 42.3 10.2 50.1\nQRB Distance: 5963.774144\nQRB Azimuth: 52.000000\nRPRT 0\n",
    ),
    (
        "+\\dump_state",
        "dump_state:\nrotctld Protocol Ver: 1\nRotor Model: 603\n"
        "Minimum Azimuth: 0.000000\nMaximum Azimuth: 450.000000\n"
        "Minimum Elevation: 0.000000\nMaximum Elevation: 180.000000\nSouth Zero: 0\nrot_type=AzEl\ndone\nRPRT 0\n",
    ),
]


@every_row(("line", "answer"), EXTENDED)
def test_records_with_labels(new_box: type[BenchBox], line: str, answer: str) -> None:
    """In one piece: CQRLOG and others read once."""
    box = new_box(at=(235, 25))
    assert RotctldSession(box).receive(line.encode() + b"\n") == [answer.encode()]


def test_the_separator_is_for_one_command(box: BenchBox) -> None:
    plain, labelled = b"235.00\n25.00\n", b"get_pos:;Azimuth: 235.00;Elevation: 25.00;RPRT 0\n"
    assert RotctldSession(box).receive(b"p;p p\n") == [plain, labelled, plain]


@every_row("line", ["+", "?", "p;", ";;", "+foo", "P 10 20 +"])
def test_a_separator_with_no_command_behind_it_is_no_command(new_box: type[BenchBox], line: str) -> None:
    box = new_box(at=(235, 25))
    assert RotctldSession(box).receive(line.encode() + b"\n") == [b"RPRT -4\n"]
    assert box.orders == []


@every_row("mark", "+;|,:.-/@\"'!*(=~[^$&%<{?")
def test_extended_requests_read_back_as_they_are_written(mark: str) -> None:
    separator = "\n" if mark == "+" else mark
    for verb in VERBS:
        if verb.letter != "Q":
            request = Request(
                verb.name, tuple("12"[: verb.arguments]) if verb.arguments < 3 else ("1",) * verb.arguments
            )
            request = Request(request.name, request.arguments, separator)
            assert list(requests(encode(request).decode("latin-1").strip())) == [request]
