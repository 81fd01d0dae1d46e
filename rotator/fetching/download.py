"""One request to a server of elements: its answer is read within limits of size and time, checked, and kept as a file.

Knows HTTP and the forms of elements. Runs in a process of its own, for parsing a large answer takes seconds. Does not
know when a request is due. It uses `urllib`: a request every few hours needs no further library.
"""

from __future__ import annotations

import errno
import string
import time
from dataclasses import dataclass
from http import HTTPStatus
from http.client import HTTPException, HTTPResponse
from pathlib import Path
from socket import gaierror
from urllib.error import HTTPError, URLError
from urllib.parse import quote, urljoin, urlsplit
from urllib.request import (
    HTTPDefaultErrorHandler,
    HTTPErrorProcessor,
    HTTPHandler,
    HTTPSHandler,
    OpenerDirector,
    ProxyHandler,
    Request,
)

from rotator import __version__
from rotator.orbits.element_files import EPOCH_AHEAD_S, MOST_BYTES, parse, text_of
from rotator.orbits.elements import Notice
from rotator.store.whole import write_whole

ANSWER_S = 15.0
"""The longest silence of the server."""
WHOLE_S = 120.0
"""The longest download."""
PIECE_BYTES = 65_536
MOST_REDIRECTS = 3
_REDIRECTS = (
    HTTPStatus.MOVED_PERMANENTLY,
    HTTPStatus.FOUND,
    HTTPStatus.SEE_OTHER,
    HTTPStatus.TEMPORARY_REDIRECT,
    HTTPStatus.PERMANENT_REDIRECT,
)
LEAST_SHARE = 0.5
"""An answer with a smaller share of the satellites of the last good one is refused the first time."""
MOST_WRONG = 1000
"""When wrong sets outnumber right ones by so many, the rest is not checked."""


@dataclass(frozen=True, slots=True)
class Question:
    """`etag`, `modified`: of the last good answer, whose `sets` elements are in `path`. `shrunk`: as in `Asked`.

    `utc_s`: now, in seconds since 1970.
    """

    address: str
    path: Path
    utc_s: float
    etag: str = ""
    modified: str = ""
    sets: int = 0
    shrunk: int = 0


@dataclass(frozen=True, slots=True)
class Answer:
    """`status`: that of HTTP; 0: there was no answer. `trouble`: why the answer is refused; empty: it is taken.

    `offline`: this computer has no network, so no server was asked.
    """

    status: int
    trouble: str = ""
    sets: int = 0
    etag: str = ""
    modified: str = ""
    offline: bool = False


def ask(question: Question) -> Answer:
    """Ask, and replace the file by a good answer. Raises nothing."""
    try:
        with _opened(question) as response:
            return _taken(question, response)
    except HTTPError as answer:
        answer.close()
        if answer.code == HTTPStatus.NOT_MODIFIED and question.sets:
            return Answer(answer.code, sets=question.sets, etag=question.etag, modified=question.modified)
        if HTTPStatus.MULTIPLE_CHOICES <= answer.code < HTTPStatus.BAD_REQUEST:
            return Answer(answer.code, "the server redirects too often, or to an address that is not http")
        return Answer(answer.code, f"the server answers {answer.code} {answer.reason}".rstrip())
    except URLError as fault:
        offline = isinstance(fault.reason, gaierror) or getattr(fault.reason, "errno", None) == errno.ENETUNREACH
        return Answer(0, no_answer(fault.reason), offline=offline)
    except (OSError, HTTPException, ValueError) as fault:
        return Answer(0, no_answer(fault))


def _opened(question: Question) -> HTTPResponse:
    """Follows the redirections of the server. The content of a redirection is not read: it may have any length."""
    opener, address = _opener(), question.address
    for _ in range(MOST_REDIRECTS):
        try:
            return _open(opener, question, address)
        except HTTPError as answer:
            place = answer.headers.get("Location")
            if answer.code not in _REDIRECTS or not place:
                raise
            answer.close()
            address = _led(address, urljoin(address, place))
    return _open(opener, question, address)


def _open(opener: OpenerDirector, question: Question, address: str) -> HTTPResponse:
    response: HTTPResponse = opener.open(_request(question, address), timeout=ANSWER_S)
    return response


def _led(before: str, after: str) -> str:
    """The new address: http or https alone, and from https only https. Raises URLError."""
    old, new = urlsplit(before).scheme, urlsplit(after).scheme
    if new not in ("http", "https") or (old == "https" and new == "http"):
        raise URLError(f"it redirects from {old} to {new}")
    return quote(after, safe=string.punctuation, encoding="iso-8859-1")


def _opener() -> OpenerDirector:
    """An opener for http and https alone: `urllib`'s own opener reads files, too."""
    opener = OpenerDirector()
    for handler in (ProxyHandler(), HTTPHandler(), HTTPSHandler(), HTTPDefaultErrorHandler(), HTTPErrorProcessor()):
        opener.add_handler(handler)
    return opener


def _request(question: Question, address: str) -> Request:
    headers = {"User-Agent": f"gs232-rotator/{__version__}", "Accept": "application/json, text/csv, text/plain, */*"}
    if question.sets and question.path.exists():
        headers |= {"If-None-Match": question.etag} if question.etag else {}
        headers |= {"If-Modified-Since": question.modified} if question.modified else {}
    return Request(address, headers=headers)


def _taken(question: Question, response: HTTPResponse) -> Answer:
    content = _read(response)
    if isinstance(content, str):
        return Answer(0, content)
    try:
        sets = checked(content, question.utc_s)
    except ValueError as fault:
        return Answer(response.status, f"the answer holds no elements: {fault}")
    if sets < LEAST_SHARE * (min(question.sets, question.shrunk) if question.shrunk else question.sets):
        return Answer(
            response.status, f"the answer has {sets} satellites, and there were {question.sets} before", sets=sets
        )
    try:
        question.path.parent.mkdir(parents=True, exist_ok=True)
        write_whole(question.path, content)
    except OSError as fault:
        return Answer(0, f"{question.path}: cannot be written: {fault.strerror}")
    etag, modified = (response.headers.get(name, "") for name in ("ETag", "Last-Modified"))
    return Answer(response.status, sets=sets, etag=etag, modified=modified)


def _read(response: HTTPResponse) -> bytes | str:
    """A sentence if it is too large, or too slow. A connection that breaks raises IncompleteRead."""
    pieces, size, late_s = [], 0, time.monotonic() + WHOLE_S
    while piece := response.read(PIECE_BYTES):
        pieces.append(piece)
        size += len(piece)
        if size > MOST_BYTES:
            return f"the answer has more than {MOST_BYTES // 1_000_000} MB: name an address with fewer satellites"
        if time.monotonic() > late_s:
            return f"the answer took longer than {WHOLE_S:g} s"
    # Reading in pieces raises nothing where the connection breaks in the middle.
    if response.length:
        raise HTTPException(f"{response.length} bytes are missing")
    return b"".join(pieces)


def checked(content: bytes, utc_s: float) -> int:
    """The number of satellites in it. Raises ValueError where it has none, or more wrong sets than right ones."""
    good: set[tuple[int, str]] = set()
    wrong, fault = 0, "it is empty"
    try:
        found = parse(text_of(content))
    except UnicodeDecodeError:
        raise ValueError("it is no text") from None
    for each in found:
        if not isinstance(each, str) and each.epoch_utc_s <= utc_s + EPOCH_AHEAD_S:
            good.add((each.catalogue_number, each.name))
            continue
        if isinstance(each, Notice):
            continue
        if not wrong:
            fault = each if isinstance(each, str) else f"{each.name} has elements for a time far ahead"
        wrong += 1
        if wrong > len(good) + MOST_WRONG:
            break
    if wrong > len(good) or not good:
        raise ValueError(fault)
    return len(good)


def no_answer(fault: object) -> str:
    """Why a server gave no answer, in one line for a person."""
    reason = getattr(fault, "strerror", None) or str(fault) or type(fault).__name__
    if isinstance(fault, gaierror):
        reason = "no internet here, or the server's name is wrong"
    if isinstance(fault, TimeoutError):
        reason = f"it took longer than {ANSWER_S:g} s"
    return f"no answer: {' '.join(str(reason).split())}"
