"""Debian's rotctld and this box side by side: the same answers to the byte, but where the box means to be better.

The genuine server drives its dummy rotor. Both are asked `_` after each line, so that silence can be told from
slowness.
"""

from __future__ import annotations

import re
import socket
import subprocess
import time
from collections.abc import Callable, Iterator
from contextlib import closing
from typing import TYPE_CHECKING

import pytest

from tests.boxes import free_port

if TYPE_CHECKING:
    from tests.foreign.conftest import RunningBox

PATIENCE_S = 30.0
GENUINE_NAME = b"Dummy rotator\n"

EQUAL = """
P 12 5 | P20 10 | P 12,5 3,25 | P 1 2 P 3 4 | P abc def | P 10 200 | P 1000 1000 | +P 14 7 | +\\set_pos 14 7
;P 1000 1000 | p | pp | p;p | p +p | ;p S | +p | +\\get_pos | ;p | ,p | :p | .p | -p | /p | @p | "p | 'p | !p | *p
(p | =p | ~p | [p | ^p | $p | &p | %p | <p | {p | S | +S | R 1 | R 0 | R x | +R 1 | \\reset 1
M 8 50 | M LEFT 20 | M CW -1 | M CCW 10 | M 2 50 | M UP 1 | M DOWN 100 | M 16 -1 | M RIGHT 7 | M up 10 | M UP x
M 6 10 | M 99 1 | +M 8 50 | S | K | +K
V SPEED 3 | V SPEED x | V FOO 1 | +V SPEED 2 | v FOO | +v FOO | U ? | u ? | +U ? | +u ? | U FOO 1 | u FOO | X ? | x ?
x FOO | C ? | C min_az 0 | C max_az 450 | C timeout 300 | C retry 2 | C post_write_delay 10 | C foo 1 | C south_zero 0
+C min_az 0
L -70.5 42.3 6 | L 170.5 -42.3 6 | +L -70.5 42.3 6 | ;L -70.5 42.3 6 | L -70.5 42.3 2 | L -70.5 42.3 5
L -70.5 42.3 12 | L -70.5 42.3 13 | L -70.5 42.3 0 | L -180 -90 6 | L 180 90 6 | L 200 42 6 | L x 42 6
L 12.3456789 -45.6789012 12 | L -179.99 89.99 12 | L 0.0001 0.00015 12 | L -0.041667 0.041667 8
l FN42rh | l FN | l F | l FN42 | l FN42r | l fn42RH | l ZZ99zz | l RR99xx | l FN42rh12ax | l FN42rh12ay
l FN42rh12ab34 | l FN42rh12ab34cd | +l FN42rh | ;l FN42rh
D 70 30 36 1 | D 70 30 36 0 | D 400 70 80 0 | D -70 30 36 0 | D 10 -5 -6 0 | D 10 5 6 2 | D x 1 1 1 | +D 70 30 36 1
d -70.51 | d 70.51 | d 0 | d 190.5 | d 400.123 | d 180 | d -180 | d 359.999 | d -0.5 | d x | +d -70.51 | ;d -70.51
E 70 30.6 0 | E -10 30 0 | E 10 -30 0 | e -70.51 | e 70.999999 | e -12.1 | e 180 | +e -70.51
B -70.5 42.3 10.2 50.1 | +B -70.5 42.3 10.2 50.1 | B 0 0 180 0 | B 0 0 0 0 | B 0 0 90 0 | B 10 0 0 0 | B 0 95 0 0
B 181 0 0 0 | B 0 0 10 0.2 | B 5 5 -10 60 | B 0 90 0 0 | B 10 50 9.9999 60 | B 151.2 -33.9 -0.1 51.5
A 30 | A 200 | A 360 | A 0 | A 180 | A 359.5 | A 400 | A -10 | +A 30 | a 1000 | a 0 | a 50000 | a -5 | +a 1000
\\pause 0 | +\\pause 0 | # comment
"""
LINES = [line.strip() for row in EQUAL.strip().splitlines() for line in row.split(" | ")]

DIFFERENT = {
    # A word that is no command: the genuine server says nothing, and Gpredict would wait for ever.
    "foo": (b"", b"RPRT -4\n"),
    "z": (b"", b"RPRT -4\n"),
    "\\chk_vfo": (b"", b"RPRT -4\n"),
    "+foo": (b"", b"RPRT -4\n"),
    # Arguments do not go on in the next line.
    "V SPEED": (None, b"RPRT -1\n"),
    # Later servers do these as the box does.
    "M UP_RIGHT 10": (b"RPRT -1\n", b"RPRT 0\n"),
    "M 128 10": (b"RPRT -1\n", b"RPRT 0\n"),
    "E 70 30.6 1": (b"70.510278\n", b"-70.510000\n"),
    "V SPEED ?": (b"RPRT -1\n", b"(1..4/1)\nRPRT 0\n"),
    "\\get_conf south_zero": (None, b"south_zero=0\n"),
    # The dummy has levels and parameters of its own, believes any number, and a device that it fails to reach.
    "V ?": (b"SPEED MGL MGF MGC \nRPRT 0\n", b"SPEED \nRPRT 0\n"),
    "v ?": (b"SPEED MGL MGF MGC \n", b"SPEED \n"),
    "X FOO 1": (b"RPRT -1\n", b"RPRT -11\n"),
    "V SPEED 500": (b"RPRT 0\n", b"RPRT -1\n"),
    "M UP 500": (b"RPRT 0\n", b"RPRT -1\n"),
    "M UP 0": (b"RPRT 0\n", b"RPRT -1\n"),
    "w S": (b"RPRT -6\n", b"RPRT -11\n"),
    # Numbers are taken whole or not at all.
    "M 2.5 10": (b"RPRT 0\n", b"RPRT -1\n"),
    "P 10abc 5": (b"RPRT 0\n", b"RPRT -1\n"),
    "P nan nan": (b"RPRT 0\n", b"RPRT -1\n"),
    "D 10.9 5.9 6.9 1": (b"-10.085250\n", b"RPRT -1\n"),
    "A 30,5": (b"210.000000\n", b"210.500000\n"),
    "d 12.1": (b"12\n5\n60.000000\n0\n", b"12\n6\n0.000000\n0\n"),
    # No client moves a limit of the box.
    "C max_az 540": (b"RPRT 0\n", b"RPRT -11\n"),
    "C min_el -90": (b"RPRT 0\n", b"RPRT -11\n"),
    "C south_zero 1": (b"RPRT 0\n", b"RPRT -11\n"),
}


@pytest.fixture
def genuine_port(need_program: Callable[[str, str], str]) -> Iterator[int]:
    program, port = need_program("rotctld", "libhamlib-utils"), free_port()
    server = subprocess.Popen(
        [program, "-m", "1", "-T", "127.0.0.1", "-t", str(port)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    )
    try:
        wait_for(port)
        yield port
    finally:
        server.kill()
        server.wait()


def wait_for(port: int) -> None:
    give_up_s = time.monotonic() + PATIENCE_S
    while True:
        try:
            with socket.create_connection(("127.0.0.1", port)):
                return
        except ConnectionRefusedError:
            assert time.monotonic() < give_up_s, f"nobody listens on {port}"
            time.sleep(0.02)


class Client:
    """Asks one line, and `_` after it: all that comes before the name is the line's answer."""

    def __init__(self, port: int) -> None:
        self._socket = socket.create_connection(("127.0.0.1", port), PATIENCE_S)
        self._name = b""
        self._name = self._hear(b"_\n", b"\n")

    def ask(self, line: str) -> bytes:
        return self._hear(line.encode() + b"\n_\n", self._name).removesuffix(self._name)

    def _hear(self, sent: bytes, end: bytes) -> bytes:
        self._socket.sendall(sent)
        heard = b""
        while not heard.endswith(end):
            piece = self._socket.recv(65536)
            assert piece, f"closed after {heard!r}"
            heard += piece
        return heard

    def close(self) -> None:
        self._socket.close()


def shape(answer: bytes) -> bytes:
    """Where the two rotors stand is no matter of the protocol."""
    return re.sub(rb"-?\d+\.\d\d(?!\d)", b"<angle>", answer)


@pytest.fixture
def both(genuine_port: int, start_box: Callable[..., RunningBox]) -> Iterator[tuple[Client, Client]]:
    with closing(Client(genuine_port)) as genuine, closing(Client(start_box().rotctld_port)) as ours:
        yield genuine, ours


def test_the_same_answers_to_the_byte(both: tuple[Client, Client]) -> None:
    genuine, ours = both
    heard = {line: (genuine.ask(line), ours.ask(line)) for line in LINES}
    unlike = {line: pair for line, pair in heard.items() if shape(pair[0]) != shape(pair[1])}
    assert unlike == {}


def test_the_differences_are_the_ones_that_are_meant(both: tuple[Client, Client]) -> None:
    """None: it takes the next line for an argument, or parts of the name for commands."""
    genuine, ours = both
    heard = {
        line: (None if answers[0] is None else genuine.ask(line), ours.ask(line)) for line, answers in DIFFERENT.items()
    }
    assert heard == DIFFERENT


def test_a_speed_that_was_set_is_the_speed_that_is_read(both: tuple[Client, Client]) -> None:
    for client in both:
        assert client.ask("V SPEED 2") == b"RPRT 0\n"
        give_up_s = time.monotonic() + PATIENCE_S
        while client.ask("v SPEED") != b"2\n":
            assert time.monotonic() < give_up_s
        assert client.ask("+v SPEED") == b"get_level: SPEED\n2\nRPRT 0\n"


def test_words_of_the_status_are_hamlibs(both: tuple[Client, Client]) -> None:
    genuine, ours = both
    known = set(genuine.ask("1").decode().split("Status flags: ")[1].split("\n")[0].split())
    told = ours.ask("s").decode().split() + re.findall(r"[A-Z]+_[A-Z]+", ours.ask("1").decode())
    assert {word for word in told if not word.startswith("OVERLAP_")} <= known


def test_dump_caps_has_the_lines_of_hamlibs(both: tuple[Client, Client]) -> None:
    """Not those of the dummy's toys. Later servers write another P in `Post Write delay`."""
    genuine, ours = ([line.split(":")[0] for line in client.ask("1").decode().splitlines()] for client in both)
    toys = [line for line in genuine if line.startswith(("\t", "Extra "))]
    assert list(dict.fromkeys(ours)) == [line for line in dict.fromkeys(genuine) if line not in toys]
    assert both[1].ask("1").endswith(b"\n\nOverall backend warnings: 0\nRPRT 0\n")


def test_extended_dump_state_has_hamlibs_labels(both: tuple[Client, Client]) -> None:
    genuine, ours = (re.sub(rb": -?[\d.]+", b": <n>", client.ask("+\\dump_state")) for client in both)
    assert ours == genuine
