"""The functions with which each group of routes describes its values: JSON Schema, as in OpenAPI 3.1.

Knows schemas. Does not know any single value, nor how a request is served.
"""

from __future__ import annotations

from typing import Any

Schema = dict[str, Any]

TEXT: Schema = {"type": "string"}
NUMBER: Schema = {"type": "number"}
WHOLE: Schema = {"type": "integer"}
YES: Schema = {"type": "boolean"}
ANY: Schema = {}
ZIP: Schema = {"contentMediaType": "application/zip"}
SVG: Schema = {"contentMediaType": "image/svg+xml"}
ELEMENTS: Schema = {"contentMediaType": "text/plain"}
TABLE: Schema = {"contentMediaType": "text/csv"}
"""Files, not JSON."""


def the(meaning: str, schema: Schema) -> Schema:
    """The same schema, with its meaning here."""
    return {**schema, "description": meaning}


def component(name: str) -> Schema:
    return {"$ref": f"#/components/schemas/{name}"}


def choice(*words: str) -> Schema:
    return {"type": "string", "enum": list(words)}


def or_null(schema: Schema) -> Schema:
    if isinstance(schema.get("type"), str) and "enum" not in schema:
        return {**schema, "type": [schema["type"], "null"]}
    return {"oneOf": [schema, {"type": "null"}]}


def list_of(schema: Schema, length: int | None = None) -> Schema:
    bounds = {} if length is None else {"minItems": length, "maxItems": length}
    return {"type": "array", "items": schema, **bounds}


def object_of(needed: Schema, optional: Schema | None = None) -> Schema:
    return {"type": "object", "properties": needed | (optional or {}), "required": list(needed)}


def in_address(meaning: str, example: str) -> Schema:
    """A value behind the `?` of an address, or in a header."""
    return {**TEXT, "description": meaning, "examples": [example]}


def table_of(schema: Schema) -> Schema:
    """An object whose names are not known beforehand."""
    return {"type": "object", "additionalProperties": schema}


def body_of(needed: Schema, optional: Schema | None = None, *, example: Schema) -> Schema:
    """The body that a program sends. Other values are not allowed."""
    return {**object_of(needed, optional), "additionalProperties": False, "examples": [example]}
