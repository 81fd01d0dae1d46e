"""Carries out a message on a topic: the methods of the page, for programs behind a broker.

Knows rights, and that a retained message of the broker is no order. Does not know how a message comes.
"""

from __future__ import annotations

from typing import Any

from rotator.exchange.foreign import json_of
from rotator.protocols.methods import BY_NAME, METHODS, Method, WrongValuesError
from rotator.protocols.operating import Operating

LONGEST = 4096
_MAY_STOP = '[mqtt] may = "{}": messages {}'
_WORDS = {"look": "do nothing", "stop": "only stop"}


class Desk:
    """`may`: as in [mqtt]."""

    def __init__(self, operating: Operating, may: str) -> None:
        self._operating = operating
        self._may = may

    @property
    def methods(self) -> list[str]:
        """The methods that messages may ask for."""
        return [method.name for method in METHODS if self._refused_by_right(method) == ""]

    def do(self, name: str, payload: bytes, *, kept: bool) -> dict[str, Any]:
        """Do it, and answer. `kept`: the broker has kept the message from before: an old wish is no order."""
        refused = self._refused(name, payload, kept=kept)
        answer: dict[str, Any] = {"method": name[:40], "ok": not refused}
        return answer | {"error": refused} if refused else answer

    def _refused(self, name: str, payload: bytes, *, kept: bool) -> str:
        method = BY_NAME.get(name)
        if method is None:
            return f"there is no method {name[:40]!a}: {', '.join(BY_NAME)}"
        if kept:
            return "the broker has kept this message: send it without retain"
        if refused := self._refused_by_right(method):
            return refused
        try:
            # A stop counts with any content.
            return self._operating.do(method.command({} if method.free else _values(payload)))
        except WrongValuesError as reason:
            return self._operating.refuse(str(reason))

    def _refused_by_right(self, method: Method) -> str:
        allowed = self._may == "move" or (method.free and self._may == "stop")
        return "" if allowed else _MAY_STOP.format(self._may, _WORDS[self._may])


def _values(payload: bytes) -> dict[str, object]:
    """The message's JSON object. Home Assistant's buttons send the word PRESS. Raises WrongValuesError."""
    if len(payload) > LONGEST:
        raise WrongValuesError(f"no message has more than {LONGEST} bytes")
    if payload.strip() in (b"", b"PRESS"):
        return {}
    try:
        values = json_of(payload)
    except ValueError:
        raise WrongValuesError("the message must be a JSON object") from None
    if not isinstance(values, dict):
        raise WrongValuesError("the message must be a JSON object")
    return values
