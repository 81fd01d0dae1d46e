"""What a browser says first, in any pieces, is known as such; what programs say first is not."""

from __future__ import annotations

from rotator.links.stream import Beginning
from tests.assembly.test_links import DIALOGUES, OUT_OF_RANGE
from tests.tables import every_row

METHODS = (b"GET", b"HEAD", b"POST", b"PUT", b"PATCH", b"DELETE", b"OPTIONS", b"CONNECT", b"TRACE")
REQUESTS = [
    *(method + b" /any HTTP/1.1\r\n" for method in METHODS),
    b"GET http://127.0.0.1/ HTTP/1.1\r\n",
    b"\x16\x03\x01\x02",
]


@every_row("request_line", REQUESTS)
def test_a_browser_is_known_before_its_first_line_ends(request_line: bytes) -> None:
    for cut in range(len(request_line)):
        beginning = Beginning()
        known = [beginning.is_a_browsers(piece) for piece in (request_line[:cut], request_line[cut:])]
        assert known[-1]


def test_once_it_has_begun_otherwise_it_is_a_program() -> None:
    beginning = Beginning()
    assert not any(beginning.is_a_browsers(piece) for piece in (b"p\n", b"POST / HTTP/1.1\r\n"))


@every_row(("keys", "said"), [*((keys, asked) for keys, asked, _ in DIALOGUES), *OUT_OF_RANGE])
def test_no_program_begins_so_but_those_that_speak_http(keys: str, said: bytes) -> None:
    assert Beginning().is_a_browsers(said) is ("pstrotatoraz" in keys)
