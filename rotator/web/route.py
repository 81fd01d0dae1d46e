"""One route of the API: its path, who serves it, how long its body may be, and its description as OpenAPI 3.1.

Each group of routes stands in a file of its own, and describes itself with the words here. Knows JSON schemas. Does not
know any single route.
"""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from dataclasses import dataclass, field
from typing import Any

from aiohttp import web

MOST_BODY = 4096
Handler = Callable[[web.Request], Awaitable[web.StreamResponse]]
Schema = dict[str, Any]

PAIRED: Schema = {"security": [{"token": []}, {"browser": []}]}
OPEN: Schema = {"security": []}
REFUSED: Schema = {"$ref": "#/components/responses/refused"}


@dataclass(frozen=True, slots=True)
class Route:
    method: str
    """`GET` or `POST`."""
    path: str
    serve: Handler
    described: Schema = field(default_factory=dict)
    """Empty: it is not for programs."""
    most_body: int = MOST_BODY
    """Bytes."""


def get(path: str, serve: Handler, summary: str, schema: Schema | None = None, *, paired: bool = False) -> Route:
    """A question. `paired`: only paired browsers and programs may ask it."""
    answer: Schema = {"description": summary}
    if schema is not None:
        answer["content"] = json_of(schema)
    described = {"summary": summary, **(PAIRED if paired else OPEN), "responses": {"200": answer, "4XX": REFUSED}}
    return Route("GET", path, serve, described)


def post(path: str, serve: Handler, summary: str, values: Schema | None = None, *, paired: bool = True) -> Route:
    """A request that does something. `values`: the schemas of its values."""
    body: Schema = {}
    if values:
        body["requestBody"] = {"required": True, "content": json_of(object_of(values))}
    answers = {"200": {"description": "done"}, "4XX": REFUSED}
    described = {"summary": summary, **(PAIRED if paired else OPEN), "responses": answers, **body}
    return Route("POST", path, serve, described)


def object_of(properties: Schema) -> Schema:
    return {"type": "object", "properties": properties, "required": list(properties)}


def json_of(schema: Schema) -> Schema:
    return {"application/json": {"schema": schema}}
