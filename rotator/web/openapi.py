"""The description of the API, as OpenAPI 3.1: made from the same tables as the API itself.

Knows the common part of all routes: rights, errors, status. Does not know how a request is served.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rotator import __version__
from rotator.protocols.methods import Method
from rotator.protocols.status_object import AXIS_FIELDS, FAULT_FIELDS, FIELDS, FLOWN_FIELDS, Field
from rotator.web.route import FREE, MOST_BODY, PAIRED, REFUSED, Handler, Route, post, refusals
from rotator.web.scene_schema import PICTURE
from rotator.web.schema import (
    NUMBER,
    TEXT,
    YES,
    Schema,
    body_of,
    component,
    in_address,
    list_of,
    object_of,
    or_null,
    the,
)

ABOUT = (
    "What the page does, for programs. An order needs a token: `rotator pair --token NAME` at the box prints one; send "
    "it as `Authorization: Bearer TOKEN`. `stop` needs none. Reading needs one only where the file says "
    '`[page] reading = "paired"`. A value that is not described is refused with a sentence. The console and MQTT have '
    "the same orders, with the same names and values."
)
_KINDS: dict[str, Schema] = {
    "text": TEXT,
    "text or null": or_null(TEXT),
    "number": NUMBER,
    "number or null": or_null(NUMBER),
    "boolean": YES,
    "list of text": list_of(TEXT),
}
SINCE = {
    "If-Match": in_address(
        "in quotes, `stops` of the picture that you saw: a stop that has come since then counts. May be missing", '"3"'
    )
}
_OBJECTS = {"azimuth": "axis", "elevation": "axis", "tracks": "tracks", "fault": "fault"}


def description(routes: Sequence[Route]) -> dict[str, Any]:
    paths: dict[str, dict[str, Any]] = {}
    for route in routes:
        paths.setdefault(route.path, {})[route.method.lower()] = route.described
    return {
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
                "error": object_of({"error": the("why, in a sentence", TEXT)}),
                "status": _fields(FIELDS),
                "axis": _fields(AXIS_FIELDS),
                "fault": _fields(FAULT_FIELDS),
                "tracks": _fields(FLOWN_FIELDS),
                "picture": PICTURE,
            },
        },
    }


def order(method: Method, serve: Handler) -> Route:
    """The route of an order."""
    values = {value.name: value.schema() for value in method.values}
    body = body_of(values, example={value.name: value.example for value in method.values}) if values else None
    access, since = FREE if method.free else PAIRED, method.name == "resume"
    headers, more = (SINCE, refusals(412)) if since else ({}, {})
    takes: dict[str, Any] = {"most_body": 0 if method.free else MOST_BODY, "headers": headers, "more": more}
    route = post(f"/api/{method.name}", serve, method.meaning, body, access=access, **takes)
    route.described["operationId"] = method.name
    return route


def _fields(fields: Sequence[Field[Any]]) -> Schema:
    return object_of({field.name: the(field.meaning, _field(field)) for field in fields})


def _field(field: Field[Any]) -> Schema:
    if field.name not in _OBJECTS:
        return _KINDS[field.kind]
    named = component(_OBJECTS[field.name])
    return or_null(named) if field.kind.endswith("or null") else named
