"""The description of the API, as OpenAPI 3.1: made from the same tables as the API itself.

Knows the common part of all routes: rights, errors, status. Does not know how a request is served.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, Any

from typing_extensions import TypedDict

from rotator import __version__
from rotator.protocols.methods import Method
from rotator.protocols.status_object import AXIS_FIELDS, FAULT_FIELDS, FIELDS, FLOWN_FIELDS, Field
from rotator.web.route import FREE, MOST_BODY, PAIRED, REFUSED, Handler, Route, post, refusals
from rotator.web.scene import Picture
from rotator.web.schema import Body, Schema, component, in_address, schema_of, the

ABOUT = (
    "What the page does, for programs. An order needs a token: `rotator pair --token NAME` at the box prints one; send "
    "it as `Authorization: Bearer TOKEN`. `stop` needs none. Reading needs one only where the file says "
    '`[page] reading = "paired"`. A value that is not described is refused with a sentence. The console and MQTT have '
    "the same orders, with the same names and values."
)
_KINDS: dict[str, Any] = {
    "text": str,
    "text or null": str | None,
    "number": float,
    "number or null": float | None,
    "boolean": bool,
    "list of text": list[str],
}
ITSELF: Schema = {"type": "object"}
SINCE = {
    "If-Match": in_address(
        "in quotes, `stops` of the picture that you saw: a stop that has come since then counts. May be missing", '"3"'
    )
}
_OBJECTS = {"azimuth": "axis", "elevation": "axis", "tracks": "tracks", "fault": "fault"}


_Error = TypedDict("_Error", {"error": Annotated[str, the("why, in a sentence")]})


def description(routes: Sequence[Route]) -> dict[str, Any]:
    """Slow: it makes the schemas of all types."""
    paths: dict[str, dict[str, Any]] = {}
    for route in routes:
        paths.setdefault(route.path, {})[route.method.lower()] = route.described
    whole = {
        "openapi": "3.1.0",
        "info": {"title": "rotator", "version": __version__, "description": ABOUT},
        "externalDocs": {"description": "The same for a person to read", "url": "/api/"},
        "paths": paths,
        "components": {
            "securitySchemes": {
                "token": {"type": "http", "scheme": "bearer", "description": "of a program: `rotator pair --token`"},
                "browser": {"type": "apiKey", "in": "cookie", "name": "rotator", "description": "of a paired browser"},
            },
            "responses": REFUSED,
            "schemas": {
                "error": _Error,
                "status": _fields(FIELDS),
                "axis": _fields(AXIS_FIELDS),
                "fault": _fields(FAULT_FIELDS),
                "tracks": _fields(FLOWN_FIELDS),
                "picture": Picture,
            },
        },
    }
    made: dict[str, Any] = _made(whole)
    return made


def _made(part: Any) -> Any:
    """With the schema of each type in its place."""
    match part:
        case dict():
            return {key: _made(each) for key, each in part.items()}
        case list():
            return [_made(each) for each in part]
        case str() | int() | float() | None:
            return part
        case Body():
            return part.schema()
    return schema_of(part)


def order(method: Method, serve: Handler) -> Route:
    """The route of an order."""
    example = {value.name: value.example for value in method.values}
    values = {value.name: value.schema() for value in method.values}
    body = {**_object(values), "additionalProperties": False, "examples": [example]} if values else None
    access, since = FREE if method.free else PAIRED, method.name == "resume"
    headers, more = (SINCE, refusals(412)) if since else ({}, {})
    takes: dict[str, Any] = {"most_body": 0 if method.free else MOST_BODY, "headers": headers, "more": more}
    route = post(f"/api/{method.name}", serve, method.meaning, body, access=access, **takes)
    route.described["operationId"] = method.name
    return route


def _fields(fields: Sequence[Field[Any]]) -> Schema:
    return _object({field.name: _field(field) for field in fields})


def _object(needed: Schema) -> Schema:
    return {"type": "object", "properties": needed, "required": list(needed)}


def _field(field: Field[Any]) -> Any:
    if field.name not in _OBJECTS:
        return Annotated[_KINDS[field.kind], the(field.meaning)]
    named = component(_OBJECTS[field.name])
    if field.kind.endswith("or null"):
        named = {"anyOf": [named, {"type": "null"}]}
    return {**named, "description": field.meaning}
