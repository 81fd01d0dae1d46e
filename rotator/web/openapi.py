"""The description of the API: as OpenAPI 3.1, made from the same tables as the API itself; and as a page to read.

The page is plain HTML without a script, so that it works when nothing else does. Knows the common part of all routes:
rights, errors, status. Does not know any single request, nor how it is served.
"""

from __future__ import annotations

import json
import re
import shlex
from collections.abc import Iterator, Sequence
from html import escape
from typing import Annotated, Any

from typing_extensions import TypedDict

from rotator import __version__
from rotator.protocols.methods import Method
from rotator.protocols.status_object import AXIS_FIELDS, FAULT_FIELDS, FIELDS, FLOWN_FIELDS, Field
from rotator.web.route import FREE, JSON, MOST_BODY, PAIRED, READING, REFUSED, Handler, Route, post, refusals
from rotator.web.scene import Picture
from rotator.web.schema import Body, Schema, component, in_address, schema_of, the

_PAGE = """<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>rotator: the API</title><link rel="icon" href="/icon.svg"><link rel="stylesheet" href="/style.css"></head>
<body><main class="api"><h1>The API of this box</h1><p>{about}</p>
<pre>BOX=http://127.0.0.1:8232
TOKEN=$(rotator pair --token NAME)</pre>
<p>The same for programs: <a href="/api/openapi.json">openapi.json</a>. <a href="/">The page of the box</a></p>
<h2>Requests</h2>{requests}<h2>Answers that others have in them</h2>
{components}<h2>Refusals</h2><p>Each is <code>{{"error": "why, in a sentence"}}</code></p><ul>{refusals}</ul>
</main></body></html>
"""
_WORDS = {"string": "text", "integer": "whole number", "boolean": "true or false", "object": "{…}"}


def api_page(described: dict[str, Any]) -> str:
    parts = described["components"]
    return _PAGE.format(
        about=_text(described["info"]["description"]),
        requests="".join(
            _request(way.upper(), path, one) for path, ways in described["paths"].items() for way, one in ways.items()
        ),
        components="".join(
            f'<section id="{name}"><h3>{name}</h3>{_form(schema)}</section>'
            for name, schema in parts["schemas"].items()
        ),
        refusals="".join(
            f"<li>{number}: {_text(one['description'])}</li>" for number, one in parts["responses"].items()
        ),
    )


def _request(way: str, path: str, operation: dict[str, Any]) -> str:
    """One request, to unfold."""
    needs = "needs a token" if _needs_token(operation) else ""
    html = [f"<summary><b>{way} {path}</b> {_text(operation['summary'])} <small>{needs}</small></summary>"]
    for each in operation.get("parameters", ()):
        name = f"?{each['name']}=" if each["in"] == "query" else f"{each['name']}:"
        html.append(f"<p><code>{name}</code> {_text(each['description'])}</p>")
    if "description" in operation:
        html.append("".join(_paragraph(part) for part in operation["description"].strip().split("\n\n")))
    else:
        html.append(f"<pre>{escape(_curl(way, path, operation))}</pre>")
    body = operation.get("requestBody", {}).get("content", {})
    html += [f"<p>Send:</p>{_content(kind, media)}" for kind, media in body.items()]
    for number, answer in operation["responses"].items():
        for kind, media in answer.get("content", {}).items():
            which = "" if number == "200" else f", {_text(answer['description'])}"
            html.append(f"<p>{number}{which}:</p>{_content(kind, media)}")
    refused = [number for number, answer in operation["responses"].items() if "$ref" in answer]
    html.append(f"<p><small>refuses with {', '.join(refused)}</small></p>")
    return f"<details>{''.join(html)}</details>\n"


def _needs_token(operation: dict[str, Any]) -> bool:
    return bool(operation["security"]) and {} not in operation["security"]


def _curl(way: str, path: str, operation: dict[str, Any]) -> str:
    words = ["curl", *(["-X POST"] if way == "POST" and "requestBody" not in operation else [])]
    if _needs_token(operation):
        words.append('-H "Authorization: Bearer $TOKEN"')
    for kind, media in operation.get("requestBody", {}).get("content", {}).items():
        if kind == JSON:
            example = next(_forms(media["schema"]))["examples"][0]
            words.append(f"-d {shlex.quote(json.dumps(example, ensure_ascii=False))}")
        else:
            words.append("--data-binary @FILE")
    named = [each["name"] for each in operation.get("parameters", ()) if each["in"] == "query"]
    asked = "&".join(f"{name}={name.upper()}" for name in named)
    words.append(f'"$BOX{path}{"?" if asked else ""}{asked}"')
    return " ".join(words)


def _content(kind: str, media: dict[str, Any]) -> str:
    if kind != JSON:
        return f"<pre>a file, {kind}</pre>"
    return "<p>or</p>".join(_form(schema) for schema in _forms(media["schema"]))


def _forms(schema: Schema) -> Iterator[Schema]:
    yield from schema.get("oneOf", [schema])


def _form(schema: Schema) -> str:
    return f"<pre>{_kind(schema)}</pre>"


def _kind(schema: Schema, indent: str = "") -> str:
    """The kind of a value, in words; an object and a list line by line."""
    match schema:
        case {"$ref": str() as where}:
            name = where.rpartition("/")[2]
            return f'<a href="#{name}">{name}</a>'
        case {"const": value}:
            return json.dumps(value)
        case {"enum": [*words]}:
            return " or ".join(escape(json.dumps(word)) for word in words)
        case {"oneOf": [*schemas]} | {"anyOf": [*schemas]}:
            return " or ".join(_kind(each, indent) for each in schemas)
        case {"type": "array", "items": items, "minItems": length}:
            return f"[{', '.join([_kind(items, indent)] * length)}]"
        case {"type": "array", "items": items}:
            return f"[{_kind(items, indent)}, …]"
        case {"type": "object", "properties": properties}:
            inner = f"{indent}  "
            rows = (_row(name, each, inner, schema) for name, each in properties.items())
            return "{\n" + "".join(rows) + indent + "}"
        case {"type": str() as kind}:
            bounds = f" {schema['minimum']:g} to {schema['maximum']:g}" if "maximum" in schema else ""
            return _WORDS.get(kind, kind) + bounds
        case _:
            return "any value"


def _row(name: str, schema: Schema, indent: str, parent: Schema) -> str:
    meaning = schema.get("description", "")
    if name not in parent.get("required", ()):
        meaning = f"may be missing{': ' if meaning else ''}{meaning}"
    return f'{indent}"{name}": {_kind(schema, indent)}{"  <i>" + _text(meaning) + "</i>" if meaning else ""}\n'


def _paragraph(text: str) -> str:
    return f"<pre>{escape(text.strip())}</pre>" if text.startswith("    ") else f"<p>{_text(text)}</p>"


def _text(text: str) -> str:
    return re.sub(r"`([^`]+)`", r"<code>\1</code>", escape(text, quote=False))


ABOUT = (
    "What the page does, for programs. An order needs a token: `rotator pair --token NAME` at the box prints one; send "
    "it as `Authorization: Bearer TOKEN`. `stop` and `demo` need none. Reading needs one only where the file says "
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
ONCE = {"Idempotency-Key": in_address("of this press: a second stop with it is none. May be missing", '"k3f9-1"')}
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
    access = FREE if method.free else READING if method.harmless else PAIRED
    headers = {"resume": SINCE, "go-on": SINCE, "stop": ONCE}.get(method.name, {})
    more = refusals(412) if headers is SINCE else {}
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
