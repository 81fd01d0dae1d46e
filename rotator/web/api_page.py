"""The API as a page to read, made from its description: each request with its body, a line for curl, and its answers.

Plain HTML without a script, so that it works when nothing else does. Knows OpenAPI as `route` writes it. Does not know
any single request.
"""

from __future__ import annotations

import json
import re
import shlex
from collections.abc import Iterator
from html import escape
from typing import Any

from rotator.web.route import JSON
from rotator.web.schema import Schema

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
