"""PstRotatorAz's page: what programs request, what they look for, and whose requests turn nothing."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from hypothesis import given
from hypothesis import strategies as st

from rotator.exchange.orders import Aim, Order, Stop
from rotator.protocols.pstrotatoraz import MAX_REQUEST, PstRotatorAzSession, encode
from tests.tables import every_row

if TYPE_CHECKING:
    from tests.protocols.conftest import BenchBox

PAGE = "/PstRotatorAz.htm"
NODE_FETCH = (
    b"GET /PstRotatorAz.htm?az=90 HTTP/1.1\r\nAccept: */*\r\nUser-Agent: node-fetch/1.0 "
    b"(+https://github.com/bitinn/node-fetch)\r\nAccept-Encoding: gzip,deflate\r\nConnection: close\r\n"
    b"Host: 192.168.1.20:8080\r\n\r\n"
)
"""The plug-in asks with this library."""


def get(box: BenchBox, *lines: str) -> bytes:
    (answer,) = PstRotatorAzSession(box).receive("\r\n".join((*lines, "", "")).encode())
    return answer


def status(answer: bytes) -> int:
    return int(answer.split(b" ")[1])


def test_what_programs_read(box: BenchBox) -> None:
    answer = get(box, f"GET {PAGE} HTTP/1.1", "Host: 192.168.1.20").decode()
    assert answer.startswith("HTTP/1.1 200 OK\r\n")
    assert "Connection: close\r\n" in answer
    head, body = answer.split("\r\n\r\n")
    assert f"Content-Length: {len(body)}" in head.splitlines()
    # FM-DX Webserver's plug-in reads the text of the whole page, without its tags; two others search for this.
    text = re.sub(r"<[^>]*>", "", body)
    found = re.search(r"Bearing\s*[:=]\s*([^\s<]+)", text)
    assert found
    assert found[1] == "235"
    assert int(body.split("Bearing = ")[1].split("deg")[0]) == 235
    assert re.search(r"Bearing\s*=\s*(\d+)\s*deg", body)


def test_the_plug_in_turns_the_antenna(box: BenchBox) -> None:
    session = PstRotatorAzSession(box)
    replies = [reply for octet in NODE_FETCH for reply in session.receive(bytes((octet,)))]
    assert status(replies[0]) == 200
    assert len(replies) == 1
    assert session.closed
    assert box.orders == [Aim(90, None)]
    assert session.receive(NODE_FETCH) == []


@every_row(
    ("target", "code", "orders"),
    [
        ("/", 200, []),
        (f"{PAGE}?az=90.5", 200, [Aim(90.5, None)]),
        (f"{PAGE}?cmd=stop", 200, [Stop()]),
        (f"{PAGE}?az=600", 409, []),
        (f"{PAGE}?az=", 400, []),
        (f"{PAGE}?az=9x", 400, []),
        (f"{PAGE}?az=90&az=180", 400, []),
        (f"{PAGE}?el=90", 400, []),
        (f"{PAGE}?cmd=go", 400, []),
        ("/other.htm?az=90", 404, []),
    ],
)
def test_requests(new_box: type[BenchBox], target: str, code: int, orders: list[Order]) -> None:
    box = new_box(at=(235, 25))
    (answer,) = PstRotatorAzSession(box).receive(encode(target))
    assert status(answer) == code
    assert box.orders == orders


@every_row(
    "headers",
    [
        ("Host: 192.168.1.20", "Sec-Fetch-Site: cross-site"),
        ("Host: 192.168.1.20", "Sec-Fetch-Site: same-site"),
        ("Host: 192.168.1.20", "Origin: https://evil.example"),
        ("Host: 192.168.1.20", "Origin: null"),
        ("Host: 192.168.1.20", "Referer: https://evil.example/page"),
        ("Host: 192.168.1.20", "Origin: http://["),
        ("Host: [",),
        ("Host: evil.example", "Sec-Fetch-Site: same-origin"),
        ("Host: 192.168.1.20.evil.example",),
        ("Host:",),
        ("Accept: */*",),
    ],
)
def test_another_web_site_turns_nothing(new_box: type[BenchBox], headers: tuple[str, ...]) -> None:
    box = new_box(at=(235, 25))
    assert status(get(box, f"GET {PAGE}?az=90 HTTP/1.1", *headers)) == 403
    assert box.orders == []
    assert status(get(box, f"GET {PAGE}?cmd=stop HTTP/1.1", *headers)) == 200
    assert box.orders == [Stop()]


@every_row("host", ["192.168.1.20:8080", "[fd00::5]:8080", "rotator", "rotator.local", "pi.lan:80"])
def test_the_box_s_own_names(new_box: type[BenchBox], host: str) -> None:
    box = new_box(at=(235, 25))
    own = (f"Host: {host}", "Sec-Fetch-Site: same-origin", f"Referer: http://{host}{PAGE}")
    assert status(get(box, f"GET {PAGE}?az=90 HTTP/1.1", *own)) == 200
    assert box.orders == [Aim(90, None)]


@every_row(
    "said",
    [
        b"POST /PstRotatorAz.htm?az=90 HTTP/1.1\r\nHost: pi\r\n\r\n",
        b"GET /PstRotatorAz.htm?az=90\r\n\r\n",
        b"GET /PstRotatorAz.htm?az=90 HTTP/2\r\nHost: pi\r\n\r\n",
        b"GET /PstRotatorAz.htm?az=90 HTTP/1.1\r\nHost pi\r\n\r\n",
        b"GET /PstRotatorAz.htm?az=90 HTTP/1.1\r\nHost: pi\r\nHost: evil.example\r\n\r\n",
        b"GET /PstRotatorAz.htm?az=90 HTTP/1.1\r\nHost: pi\r\n folded: x\r\n\r\n",
        b"GET /PstRotator\x00Az.htm?az=90 HTTP/1.1\r\nHost: pi\r\n\r\n",
        b"GET /PstRotatorAz.htm?az=90 HTTP/1.1\r\nX: " + b"x" * MAX_REQUEST + b"\r\n\r\n",
        b"x" * (MAX_REQUEST + 1),
    ],
)
def test_damaged_requests_turn_nothing(new_box: type[BenchBox], said: bytes) -> None:
    box = new_box(at=(235, 25))
    session = PstRotatorAzSession(box)
    (answer,) = session.receive(said)
    assert status(answer) == 400
    assert session.closed
    assert box.orders == []


def test_an_unknown_position_has_no_number(new_box: type[BenchBox]) -> None:
    answer = get(new_box(blind=True), f"GET {PAGE} HTTP/1.1", "Host: pi")
    assert b"Bearing = unknown" in answer
    assert not re.search(rb"Bearing\s*=\s*\d", answer)


@given(
    pieces=st.lists(
        st.one_of(
            st.binary(max_size=6),
            st.sampled_from(
                [b"GET ", b"/PstRotatorAz.htm", b"?az=90", b" HTTP/1.1", b"\r\n", b"\r\n", b"Host: pi", b"&"]
            ),
            st.just(NODE_FETCH),
        ),
        max_size=12,
    )
)
def test_any_bytes(new_box: type[BenchBox], pieces: list[bytes]) -> None:
    """One whole answer at most; no motion but by a whole first request with its own host; pieces make no difference."""
    torn, whole = new_box(), new_box()
    session = PstRotatorAzSession(torn)
    replies = [reply for piece in pieces for reply in session.receive(piece)]
    heard = b"".join(pieces)
    assert replies == PstRotatorAzSession(whole).receive(heard)
    assert torn.orders == whole.orders
    assert len(replies) <= 1
    assert all(re.match(rb"HTTP/1\.1 [2-5]\d\d [A-Z]", reply) for reply in replies)
    if torn.motions:
        first = re.match(rb"GET /(?:PstRotatorAz\.htm)?\?az=90 HTTP/1\.1\r?\n(.*\n)?\r?\n", heard, re.DOTALL)
        assert first
        assert b"Host: " in heard
        assert torn.motions == [Aim(90, None)]
