"""The API's own description as a judge: whether an answer is one that it names, and what bodies it lets one draw.

Knows OpenAPI 3.1 and JSON Schema. Does not know any single route, nor the box.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from hypothesis import strategies as st
from jsonschema import Draft202012Validator

from rotator.config import keys

JSON = "application/json"
WORDS = sorted({word for table in keys.forms() for word in (*table["path"], *(key["key"] for key in table["keys"]))})
"""A text at random meets no key of the file: some are these."""
ANY_CHARACTERS = st.text(st.characters(codec=None, exclude_categories=()), max_size=30)
ANYTHING: st.SearchStrategy[Any] = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | ANY_CHARACTERS | st.sampled_from(WORDS),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(ANY_CHARACTERS, inner, max_size=4),
    max_leaves=8,
)


@dataclass(frozen=True)
class Described:
    document: Mapping[str, Any]

    def routes(self, way: str) -> Iterator[tuple[str, dict[str, Any]]]:
        for path, ways in self.document["paths"].items():
            if way in ways:
                yield path, ways[way]

    def bodies(self, one: Mapping[str, Any]) -> list[dict[str, Any]]:
        """The forms that a request's JSON may have; none: it has no such body."""
        schema = one.get("requestBody", {}).get("content", {}).get(JSON, {}).get("schema")
        return [] if schema is None else schema.get("oneOf", [schema])

    def judge(self, one: Mapping[str, Any], status: int, kind: str, body: bytes) -> None:
        """Raises AssertionError for an answer that the description does not name."""
        assert str(status) in one["responses"], (status, body[:300])
        answer = one["responses"][str(status)]
        if "$ref" in answer:
            answer = self.document["components"]["responses"][answer["$ref"].rpartition("/")[2]]
        assert kind in answer["content"], kind
        if kind == JSON:
            self.valid(answer["content"][kind]["schema"], json.loads(body))

    def answers(self, path: str, value: object) -> None:
        """Whether this is what a GET of this path may say."""
        one = self.document["paths"][path]["get"]
        self.valid(one["responses"]["200"]["content"][JSON]["schema"], value)

    def valid(self, schema: Mapping[str, Any], value: object) -> None:
        """What is not described is wrong too."""
        whole = closed({**schema, "components": self.document["components"]})
        faults = [f"{each.json_path}: {each.message}" for each in Draft202012Validator(whole).iter_errors(value)]
        assert not faults, faults[:3]

    def drawn(self, schema: Mapping[str, Any]) -> st.SearchStrategy[Any]:
        """Values of this schema."""
        match schema:
            case {"const": value}:
                return st.just(value)
            case {"enum": [*words]}:
                return st.sampled_from(words)
            case {"type": [*kinds]}:
                return st.one_of([self.drawn({**schema, "type": kind}) for kind in kinds])
            case {"pattern": pattern}:
                return st.from_regex(pattern, fullmatch=True)
            case {"type": "string"}:
                most = schema.get("maxLength", 40)
                return (ANY_CHARACTERS | st.sampled_from(WORDS)).map(lambda text: text[:most])
            case {"type": "number"}:
                return st.floats(schema["minimum"], schema["maximum"])
            case {"type": "integer"}:
                return st.integers(schema.get("minimum"))
            case {"type": "boolean"}:
                return st.booleans()
            case {"type": "null"}:
                return st.none()
            case {"type": "array", "items": items}:
                return st.lists(self.drawn(items), max_size=4)
            case {"type": "object", "properties": properties, "required": needed}:
                values = {name: self.drawn(each) for name, each in properties.items()}
                return st.fixed_dictionaries(
                    {name: each for name, each in values.items() if name in needed},
                    optional={name: each for name, each in values.items() if name not in needed},
                )
            case {"additionalProperties": inner}:
                return st.dictionaries(ANY_CHARACTERS | st.sampled_from(WORDS), self.drawn(inner), max_size=4)
        return ANYTHING

    def sent(self, one: Mapping[str, Any]) -> st.SearchStrategy[bytes]:
        """Bodies for a request: such as it describes, such with one value of any kind, and any other."""
        forms = [self.drawn(each) for each in self.bodies(one)]
        nearly = [st.tuples(form, ANY_CHARACTERS | st.sampled_from(WORDS), ANYTHING).map(_with_one) for form in forms]
        return st.one_of([each.map(_bytes) for each in (*forms, *nearly, ANYTHING)]) | st.binary(max_size=200)


def closed(schema: Any) -> Any:
    """The schema without room for what it does not name."""
    if isinstance(schema, list):
        return [closed(each) for each in schema]
    if not isinstance(schema, dict):
        return schema
    inner = {key: closed(each) for key, each in schema.items()}
    return (
        {"additionalProperties": False, **inner} if schema.get("type") == "object" and "properties" in schema else inner
    )


def of_another_kind(value: object) -> object:
    return 7 if isinstance(value, str | list | dict) or value is None else "x"


def _with_one(parts: tuple[dict[str, Any], str, Any]) -> dict[str, Any]:
    """One value is another one, or one more is there."""
    body, name, value = parts
    return {**body, (sorted(body)[len(name) % len(body)] if body and len(name) % 4 else name): value}


def _bytes(value: object) -> bytes:
    return json.dumps(value).encode()
