"""Takes secrets out of texts that leave the box: passwords, tokens, hashes, and parts of addresses.

Knows where the configuration can hold a secret, and the forms of secrets in other texts. In doubt it takes out too
much. Does not know where the texts come from.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any
from urllib.parse import parse_qsl, quote, unquote, urlsplit

from pydantic import BaseModel
from pydantic.fields import FieldInfo

REMOVED = "[removed]"
SHORTEST = 4
"""Characters: a shorter secret is part of too many words to be taken out everywhere."""
LONG_STEP = 12
"""Characters: a part of an address's path this long may be a key."""
_ADDRESS = re.compile(r"\b([a-zA-Z][a-zA-Z0-9+.-]*://)([^\s\"'<>\\`]+)")
_NAMED = re.compile(
    r"(?i)\b([\w-]*(?:passw(?:or)?d|passwd|passphrase|secret|token|api[_-]?key|authorization|cookie)[\w-]*)"
    r"([\"']?\s*[:=]\s*)(?:bearer\s+|basic\s+)?(\"[^\"]*\"|'[^']*'|\[removed\]|[^\s,;}\]]+)"
)
_COOKIES = re.compile(r"(?i)\b((?:set-)?cookie\s*:\s*)[^\r\n]+")
_BEARER = re.compile(r"(?i)\b(bearer)\s+[\w.~+/=!$*-]{4,}")
_HASH = re.compile(r"(?<![0-9a-fA-F])[0-9a-fA-F]{64}(?![0-9a-fA-F])")
_TOKEN = re.compile(r"(?<![\w-])[\w-]{43}(?![\w-])", re.ASCII)


class Redaction:
    """`secrets` are taken out everywhere; `names` maps each name to its replacement."""

    def __init__(self, secrets: Iterable[str] = (), names: Mapping[str, str] | None = None) -> None:
        stand_for = {secret: REMOVED for each in secrets for secret in _spellings(each)}
        stand_for |= {name: other for name, other in (names or {}).items() if len(name) >= SHORTEST}
        self._stand_for = stand_for
        # The longest first: a shorter one may be a part of it.
        known = "|".join(re.escape(each) for each in sorted(stand_for, key=len, reverse=True))
        self._known = re.compile(known) if known else None

    def text(self, text: str) -> str:
        if self._known is not None:
            text = self._known.sub(lambda found: self._stand_for[found[0]], text)
        text = _ADDRESS.sub(_host_alone, text)
        text = _COOKIES.sub(rf"\1{REMOVED}", text)
        text = _BEARER.sub(rf"\1 {REMOVED}", text)
        text = _NAMED.sub(rf"\1\2{REMOVED}", text)
        text = _HASH.sub(REMOVED, text)
        return _TOKEN.sub(REMOVED, text)

    def value(self, value: Any) -> Any:
        """A value of JSON, with every text in it redacted."""
        match value:
            case str():
                return self.text(value)
            case Mapping():
                return {key: self.value(each) for key, each in value.items()}
            case list() | tuple():
                return [self.value(each) for each in value]
            case _:
                return value


def secrets_of(model: BaseModel) -> set[str]:
    """The texts of a configuration that are secrets, or may be."""
    found: set[str] = set()
    for text, is_secret in _texts(model):
        if is_secret:
            # The path of an address that is one may be a word, such as a topic.
            found |= {text, *text.partition("://")[2].split("/")[1:]}
        if "://" in text:
            found |= set(_parts(text))
    return {text for text in found if len(text) >= SHORTEST}


def is_secret(field: FieldInfo) -> bool:
    """Whether the model marks this key as secret."""
    extra = field.json_schema_extra
    return isinstance(extra, dict) and extra.get("writeOnly") is True


def spellings_of_place(latitude_deg: float, longitude_deg: float) -> set[str]:
    """The spellings of a place to a few hundred metres, with three decimals; more decimals may follow in a text."""
    return {f"{math.trunc(abs(deg) * 1000) / 1000:.3f}" for deg in (latitude_deg, longitude_deg)}


def _texts(value: Any, *, secret: bool = False) -> Iterator[tuple[str, bool]]:
    match value:
        case str():
            yield value, secret
        case BaseModel():
            for name, field in type(value).model_fields.items():
                yield from _texts(getattr(value, name), secret=is_secret(field))
        case list() | tuple():
            for each in value:
                yield from _texts(each, secret=secret)


def _parts(address: str) -> Iterator[str]:
    """The parts of an address that may be secret: user and password, query, long parts of its path."""
    try:
        parts = urlsplit(address)
        yield from filter(None, (parts.username, parts.password))
    except ValueError:
        yield address
        return
    yield from filter(None, (parts.query, parts.fragment))
    yield from (value for _, value in parse_qsl(parts.query))
    yield from (step for step in re.split(r"[/&]", parts.path) if len(step) >= LONG_STEP)


def _spellings(secret: str) -> Iterator[str]:
    forms: tuple[Callable[[str], str], ...] = (str, quote, unquote, lambda text: quote(text, safe=""))
    yield from (spelt for spelt in {form(secret) for form in forms} if len(spelt) >= SHORTEST)


def _host_alone(found: re.Match[str]) -> str:
    """Scheme and host of an address. The rest may hold a name, a password, a key."""
    scheme, rest = found[1], found[2]
    after = rest[len(rest.rstrip(".,:;)")) :]
    host, slash, _ = rest.removesuffix(after).rpartition("@")[2].partition("/")
    host, asks, _ = host.partition("?")
    return f"{scheme}{host}{'/…' if slash or asks else ''}{after}"
