"""The description of the API, as OpenAPI 3.1: made from the same tables as the API itself.

Knows JSON schemas. Does not know how a request is served.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rotator import __version__
from rotator.protocols.methods import Method
from rotator.protocols.status_object import AXIS_FIELDS, FAULT_FIELDS, FIELDS, FLOWN_FIELDS, Field
from rotator.web.route import OPEN, PAIRED, REFUSED, Route, json_of, object_of

STATUS = "The status, as `rotator where --json` prints it"
BOX = "What does not change while the box runs: ranges, beam, horizon, sectors"
_ERROR = {"$ref": "#/components/schemas/error"}
_SELF = {"get": {"summary": "This description", **OPEN, "responses": {"200": {"description": "This description"}}}}
_KINDS: dict[str, Any] = {
    "text": {"type": "string"},
    "text or null": {"type": ["string", "null"]},
    "number": {"type": "number"},
    "number or null": {"type": ["number", "null"]},
    "true or false": {"type": "boolean"},
    "list of text": {"type": "array", "items": {"type": "string"}},
    "object": {"type": "object"},
    "object or null": {"type": ["object", "null"]},
}
_OBJECTS = {"azimuth": "axis", "elevation": "axis", "tracks": "tracks", "fault": "fault"}


def description(routes: Sequence[Route]) -> dict[str, Any]:
    paths: dict[str, dict[str, Any]] = {"/api/openapi.json": _SELF}
    for route in routes:
        if route.described:
            paths.setdefault(route.path, {})[route.method.lower()] = route.described
    return {
        "openapi": "3.1.0",
        "info": {
            "title": "rotator",
            "version": __version__,
            "description": (
                "What the page does, for programs. Reading is open. Orders need a token: `rotator pair --token NAME` "
                "at the box prints one; send it as `Authorization: Bearer TOKEN`. `stop` needs none."
            ),
        },
        "paths": paths,
        "components": {
            "securitySchemes": {
                "token": {"type": "http", "scheme": "bearer"},
                "browser": {"type": "apiKey", "in": "cookie", "name": "rotator"},
            },
            "responses": {
                "refused": {
                    "description": "refused, and why",
                    "content": json_of({"$ref": "#/components/schemas/error"}),
                }
            },
            "schemas": {
                "error": object_of({"error": {"type": "string", "description": "why, in a sentence"}}),
                "status": _fields(FIELDS),
                "axis": _fields(AXIS_FIELDS),
                "fault": _fields(FAULT_FIELDS),
                "tracks": _fields(FLOWN_FIELDS),
            },
        },
    }


def order(method: Method) -> dict[str, Any]:
    """The description of an order's route."""
    values = {value.name: value.schema() for value in method.values}
    done: dict[str, Any] = {
        "operationId": method.name,
        "summary": method.meaning,
        **(OPEN if method.free else PAIRED),
        "responses": {
            "200": {"description": "done, or begun", "content": json_of(object_of({"ok": {"const": True}}))},
            "4XX": REFUSED,
        },
    }
    if values:
        body = {**object_of(values), "additionalProperties": False}
        done["requestBody"] = {"required": True, "content": json_of(body)}
    return done


def _fields(fields: Sequence[Field[Any]]) -> dict[str, Any]:
    schemas = {}
    for field in fields:
        schema = _KINDS[field.kind]
        if field.name in _OBJECTS:
            schema = {"$ref": f"#/components/schemas/{_OBJECTS[field.name]}"}
            if field.kind == "object or null":
                schema = {"oneOf": [schema, {"type": "null"}]}
        schemas[field.name] = {"description": field.meaning, **schema}
    return object_of(schemas)
