"""One route of the API: its path, its handler, the limit of its body, and its description as OpenAPI 3.1.

Each group of routes has a file of its own, and describes itself with the functions here and the types of `schema`. A
type stands in a description where its schema will be: `openapi` makes them. Does not know any single route.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Literal

from typing_extensions import TypedDict

from rotator.web.schema import Body, Ok, Schema, component

MOST_BODY = 4096
JSON = "application/json"
Handler = Callable[..., Any]
"""Gets the request, and the values of its `Body` where it has one. Gives, or lets one wait for, a value for JSON, None
when all is done, or a whole response."""

PAIRED: Schema = {"security": [{"token": []}, {"browser": []}]}
READING: Schema = {"security": [{}, {"token": []}, {"browser": []}]}
"""All may read, unless the configuration has `[page] reading = "paired"`."""
FREE: Schema = {"security": []}

REFUSALS: Mapping[int, str] = {
    400: "the request has not this form; the sentence says what to send",
    401: "not paired, or paired no more",
    403: "asked under a name that is not the box's, or by another site's page; or the pairing does not succeed",
    404: "there is no such thing",
    409: "understood, and the box as it stands does not do it",
    412: "it has changed since the picture that the request names",
    413: "the body is too long",
    422: "the file that was sent has a mistake",
    503: "it is not computed yet: ask again",
}
"""An answer with one of these status codes has an `error`."""


@dataclass(frozen=True, slots=True)
class Route:
    method: str
    """`GET` or `POST`."""
    path: str
    serve: Handler
    described: Schema
    """Its `security` is what the entrance asks for."""
    most_body: int = MOST_BODY
    """Bytes; 0: the body is not read, and may have any length."""
    body: Body[Any] | None = None
    """Read before it is served; None: the handler reads what it needs."""


def get(
    path: str,
    serve: Handler,
    answer: tuple[str, Any],
    *,
    access: Schema = READING,
    query: Schema | None = None,
    more: Schema | None = None,
) -> Route:
    """A query. `answer`: its meaning and its type. `query`: values in the address. `more`: further answers."""
    answers = {"200": answered(*answer), **(more or {})}
    summary, _ = answer
    return Route("GET", path, serve, _described(summary, access, answers, query))


def live(path: str, serve: Handler, answer: tuple[str, str], *, access: Schema, query: Schema, more: Schema) -> Route:
    """A WebSocket. OpenAPI cannot describe its messages: after its summary `answer` describes them in words."""
    summary, messages = answer
    answers = {"101": {"description": "the WebSocket is open"}, **refusals(400), **more}
    return Route("GET", path, serve, {**_described(summary, access, answers, query), "description": messages})


def post(
    path: str,
    serve: Handler,
    summary: str,
    body: Body[Any] | Schema | None = None,
    *,
    answer: Any = Ok,
    access: Schema = PAIRED,
    most_body: int = MOST_BODY,
    query: Schema | None = None,
    headers: Schema | None = None,
    more: Schema | None = None,
) -> Route:
    """A request that changes something. `answer`: its type. `query` and `more`: as in `get`."""
    answers = {"200": answered("done", answer), **refusals(400, 409, 413), **(more or {})}
    described = _described(summary, access, answers, query, headers)
    if body is not None:
        described["requestBody"] = {
            "required": not isinstance(body, Body) or body.needed,
            "content": _content(body),
        }
    return Route("POST", path, serve, described, most_body, body if isinstance(body, Body) else None)


def _described(
    summary: str, access: Schema, answers: Schema, query: Schema | None, headers: Schema | None = None
) -> Schema:
    refused = refusals(403) if access is FREE else refusals(401, 403)
    described: Schema = {"summary": summary, **access, "responses": dict(sorted({**answers, **refused}.items()))}
    places = {"query": query or {}, "header": headers or {}}
    if any(places.values()):
        described["parameters"] = [
            {"name": name, "in": place, "description": schema["description"], "schema": schema}
            for place, schemas in places.items()
            for name, schema in schemas.items()
        ]
    return described


def answered(summary: str, kind: Any) -> Schema:
    return {"description": summary, "content": _content(kind)}


def _content(kind: Any) -> Schema:
    """`kind`: a type, a `Body`, or the schema of a file or a component."""
    return {kind.get("contentMediaType", JSON) if isinstance(kind, dict) else JSON: {"schema": kind}}


def refusals(*numbers: int) -> Schema:
    return {str(number): {"$ref": f"#/components/responses/{number}"} for number in numbers}


_Computing = TypedDict("_Computing", {"computing": Literal[True]})


COMPUTING: Schema = {
    "202": answered("it is computed: ask again", _Computing),
    **refusals(409),
}
"""Further answers of a slow request."""
REFUSED: Schema = {str(number): answered(why, component("error")) for number, why in REFUSALS.items()}
"""Common answers, written once for all routes."""
