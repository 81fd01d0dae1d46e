"""A damaged stop stops, on every link; and no other command is taken for one."""

from __future__ import annotations

from typing import TYPE_CHECKING, get_args

from hw.ports import Axis
from rotator.config.links import FOLLOW, ProtocolName
from rotator.exchange.orders import Order, Stop
from rotator.links.udp import UdpLink
from rotator.links.wire import Wire
from rotator.protocols.console_session import ConsoleSession
from rotator.protocols.damaged import is_stop
from rotator.protocols.pstrotator import PstRotatorSession
from tests.protocols.fed import connected
from tests.tables import every_row

if TYPE_CHECKING:
    from tests.protocols.conftest import BenchBox

NO_STOP: tuple[ProtocolName, ...] = ("gs232-f1efw", "macdoppler", "wsjtx", "stellarium", FOLLOW)
"""These have no stop."""

LINES = [b"S", b"S;", b"S\0", b"\\Stop", b"\\STOP", b"STOP", b"Stop!", b"+S", b";S", b"\xff\0S", b"S \x1a", b"SSS",
         b"S 5", b"xSTOPx", b"STOP 180 45"]  # fmt: skip
XML = [b"STOP", b"<STOP>", b"<stop/>", b"< Stop />", b"<STOP>1</STOP", b"<STO", b"<S"]
DAMAGED: dict[str, list[bytes]] = {
    "rotctld": [line + b"\n" for line in [*LINES[:-2], b"P STOP 1", b"R x", b"S" + b"x" * 2000]],
    "gs232a": [line + b"\r" for line in [*LINES, b"S" + b"x" * 20_000]],
    "gs232b": [line + b"\r" for line in LINES],
    **{
        f"easycomm{level}": [
            line + b"\n" for line in [*LINES, b"SA SX", b"QA SE", b"SASE", b"SA,SE", b"SA1 SE1", b"SA\xffSE", b"SA S",
                                      b"AZ1x0 EL20.0 SE"]
        ]
        for level in "123"
    },
    "rc2800": [line + b"\r" for line in LINES],
    "dcu1": [b";", b"AS1;", b"as1;", b"AS;", b"AS2;", b"ASx1;", b"STOP;", b"AS1\r"],
    "pstrotator": [*(b"<PST>" + each + b"</PST>" for each in XML), *(b"<PST>" + each for each in XML), b"STOP",
                   b"<pst><stop>1</stop></pst", b"<PST>STOP?</PST>", b"<PST><STOPP>1</STOPP></PST>"],
    "n1mm": [*(b"<N1MMRotor>" + each + b"</N1MMRotor>" for each in XML[:-2]), *(b"<N1MMRotor>" + each for each in XML),
             b"<n1mmrotor><STOP><rotor>x</rotor></STOP></n1mmrotor>", b"<N1MMRotor> <stop > 1 </stop> </N1MMRotor>"],
    "pstrotatoraz": [b"GET /PstRotatorAz.htm?" + each + b" HTTP/1.1\r\nHost: 192.168.1.20\r\n\r\n"
                     for each in (b"cmd=stop", b"cmd=STOP", b"stop", b"az=5&cmd=stop", b"cmd=stop&x=" + b"1" * 5000)]
    + [b"GET /x?cmd=stop HTTP/9\r\n\r\n", b"GET /?cmd=stop\r\n\r\n", b"POST /?cmd=stop HTTP/1.1\r\nbad\r\n\r\n"],
    "lx200": [b":Q#", b":q#", b":QQ#", b":xQ#", b":Q\r", b":Q\n", b"Q#", b":Q:GR#", b":" + b"x" * 99 + b"Q#", b":Qx#"],
    "prosistel-d": [b"\x02" + each + b"\r" for each in (b"XG999", b"AG9x9", b"G999", b"STOP", b"S")]
    + [b"AG999\r", b"\x02\x02AG999xxxxxx\r\x02AG999\r\x02EG999\r", b"\x02AG998\r\x02EG978\r"],
    "prosistel-c": [b"\x02XG9999\r", b"\x02AG9x99\r", b"AG9999\r", b"\x02AG9998\r\x02BG9977\r"],
    **{
        model: [bytes.fromhex(each) for each in ("57" + "00" * 10 + "0F21", "57" + "00" * 9 + "020F20",
                                                 "57" + "00" * 10 + "0E20", "57" + "00" * 10 + "0F00")]
        for model in ("rot1prog", "rot2prog", "md01")
    },
}  # fmt: skip

OTHERS: dict[str, list[bytes]] = {
    "rotctld": [b"s\n", b"\\set_pos\n", b"\\set_p\n", b"set_pos 180 45\n", b"w STOP\n", b"# STOP\n",
                b"KEEPALIVE\n", b"P 180 45\n", b"\\send_cmd S\n", b"\\set_level SPEED 9\n"],
    "gs232b": [b"W235 025\r", b"X4\r", b"S235 025\r", b"M235\r", b"C2\r", b"P36\r"],
    "easycomm2": [b"AZ180.0 EL45.0\n", b"SUNSAT AZ180.0 EL45.0\n", b"SO-50 AZ180.0 EL45.0\n", b"ST26:11:21:18:00:00\n",
                  b"AZ23S.5 EL25.0\n", b"AZ EL\n", b"UP145900000 UMUSB\n"],
    "pstrotator": [b"<PST><STOP>0</STOP></PST>", b"<PST><STOP>0</STOP>", b"<PST><SATSELECT>NONSTOP</SATSELECT></PST>",
                   b"<PST>AZ?</PST>"],
    "n1mm": [b"<N1MMRotor><rotor>Stop</rotor><goazi>5.0</goazi></N1MMRotor>", b"<N1MMRotor><stop>0</stop></N1MMRotor>",
             b"<N1MMRotor><stop> False </stop>"],
    "lx200": [b":GR#", b":MS#", b":Sr15:44:00#"],
    "dcu1": [b"AP1235;AM1;", b"AI1;", b"ap1235;", b"AP1x35;"],
    "rc2800": [b"A235.0\r", b"E25\r", b"A\r"],
    "prosistel-d": [b"\x02AG180\r", b"\x02AS\r", b"\x02A?\r"],
    "md01": [bytes.fromhex("57" + "00" * 10 + "1F20"), bytes.fromhex("57 30 39 36 37 02 30 38 37 34 02 2F 20")],
    "pstrotatoraz": [b"GET /?az=5 HTTP/1.1\r\nHost: 192.168.1.20\r\nReferer: http://192.168.1.20/?cmd=stop\r\n\r\n"],
}  # fmt: skip


def stopped(orders: list[Order]) -> set[Axis]:
    return {axis for order in orders if isinstance(order, Stop) for axis in order.axes}


@every_row("protocol", DAMAGED)
def test_a_damaged_stop_stops_both_axes_and_moves_nothing(new_box: type[BenchBox], protocol: str) -> None:
    for said in DAMAGED[protocol]:
        box = new_box(at=(235, 25))
        session = connected(protocol, box)
        session.receive(said)
        session.finish()
        assert stopped(box.orders) == set(Axis), said
        assert box.motions == [], said


@every_row("protocol", ["rotctld", "gs232b", "easycomm2", "rc2800", "lx200", "prosistel-d", "dcu1"])
def test_a_stop_without_an_end_counts_when_the_connection_ends(new_box: type[BenchBox], protocol: str) -> None:
    box = new_box(at=(235, 25))
    session = connected(protocol, box)
    session.receive({"lx200": b":Q", "prosistel-d": b"\x02XG999", "dcu1": b"AS1"}.get(protocol, b"STOP"))
    session.finish()
    assert stopped(box.orders) == set(Axis)


@every_row("protocol", OTHERS)
def test_no_other_command_is_taken_for_a_stop(new_box: type[BenchBox], protocol: str) -> None:
    for said in OTHERS[protocol]:
        box = new_box(at=(235, 25))
        connected(protocol, box).receive(said)
        assert stopped(box.orders) == set(), said


def test_none_is_left_out() -> None:
    assert {*DAMAGED, *NO_STOP} == set(get_args(ProtocolName))


@every_row("line", [b"stop", b"STOP!", b"stop;", b"stpo", b"stopp", b"xx stop", b"s", b"sto",
                                  b"stop" + b" " * 500])  # fmt: skip
def test_at_the_console_too(new_box: type[BenchBox], line: bytes) -> None:
    box = new_box(at=(235, 25))
    assert ConsoleSession(box).receive(line + b"\n") == [b"ok\n"]
    assert box.orders == [Stop(latch=True)]


@every_row("line", [b"status", b"statsu", b"sky", b"setup", b"help", b"park stop", b"resume"])
def test_nor_at_the_console_is_another_word_one(new_box: type[BenchBox], line: bytes) -> None:
    box = new_box(at=(235, 25))
    ConsoleSession(box).receive(line + b"\n")
    assert stopped(box.orders) == set()


def test_a_datagram_too_long_is_dropped_but_for_a_stop(box: BenchBox) -> None:
    link = UdpLink(Wire("pst", "pstrotator", ""), "127.0.0.1", 1, lambda: PstRotatorSession(box))
    link.received(b"<PST><AZIMUTH>85</AZIMUTH></PST>" + b" " * 5000, ("127.0.0.1", 2))
    assert box.orders == []
    link.received(b"<PST><STOP>1</STOP></PST>" + b" " * 5000, ("127.0.0.1", 2))
    assert stopped(box.orders) == set(Axis)


@every_row("said", [b"KEEPALIVE", b"SET_POS 180 45", b"S235 025", b"AS1", b"", b"\xdf"])
def test_the_rule_itself(said: bytes) -> None:
    assert not is_stop(said)
