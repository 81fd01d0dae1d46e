"""What a request takes and what it answers, as types: pydantic makes the JSON Schema of OpenAPI 3.1 of them.

An answer is a TypedDict, which its maker returns; a body is a `Sent`, and is checked by its type. The schemas are made
when somebody asks for the description: a start can do without them. Does not know any single value.
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Annotated, Any, Generic, Literal, TypeVar

from pydantic import ConfigDict, Field, ValidationError
from typing_extensions import TypedDict

from rotator.protocols.methods import WrongValuesError

if TYPE_CHECKING:
    from pydantic import TypeAdapter

Schema = dict[str, Any]
Of = TypeVar("Of")

ZIP: Schema = {"contentMediaType": "application/zip"}
SVG: Schema = {"contentMediaType": "image/svg+xml"}
ELEMENTS: Schema = {"contentMediaType": "text/plain"}
ICS: Schema = {"contentMediaType": "text/calendar"}
TABLE: Schema = {"contentMediaType": "text/csv"}
"""Files, not JSON."""
_COMPONENT = "component"
_SHOWN_NAME = 40


def the(meaning: str) -> Any:
    """The meaning of a value, in its annotation."""
    return Field(description=meaning)


def one_of(component: str) -> Any:
    """In an annotation: the value is described once for all, under this name."""
    return Field(json_schema_extra={_COMPONENT: component})


def component(name: str) -> Schema:
    return {"$ref": f"#/components/schemas/{name}"}


def in_address(meaning: str, example: str) -> Schema:
    """A value behind the `?` of an address, or in a header."""
    return {"type": "string", "description": meaning, "examples": [example]}


Pair = Annotated[Sequence[float], Field(min_length=2, max_length=2)]


Ok = TypedDict("Ok", {"ok": Literal[True]})


class Sent(TypedDict):
    """The base of a body. No other values are allowed in it, and none is converted."""


Sent.__pydantic_config__ = ConfigDict(extra="forbid", strict=True)  # type: ignore[attr-defined]


class Body(Generic[Of]):
    """What a request takes: one of `forms`, each with an example. `hint`: where a person finds its values."""

    def __init__(self, *forms: tuple[type[Of], Mapping[str, Any]], hint: str = "") -> None:
        self._forms: Sequence[tuple[Any, Mapping[str, Any]]] = forms
        self._hint = f": {hint}" if hint else ""

    def read(self, values: Mapping[str, object]) -> Of:
        """Raises WrongValuesError, which says what to send."""
        fits = (each for each in self._forms if each[0].__required_keys__ <= values.keys())
        form, example = next(fits, self._forms[0])
        try:
            found: Of = _adapter(form).validate_python(values)
        except ValidationError as mistake:
            send = f"send {json.dumps(example, ensure_ascii=False)}{self._hint}"
            raise WrongValuesError(f"{_in_words(mistake)}; {send}") from None
        return found

    def schema(self) -> Schema:
        forms = [{**schema_of(form), "examples": [example]} for form, example in self._forms]
        return forms[0] if len(forms) == 1 else {"oneOf": forms}

    @property
    def needed(self) -> bool:
        return all(form.__required_keys__ for form, _ in self._forms)


def schema_of(kind: Any) -> Schema:
    """The schema of a type, complete in itself but for the components."""
    schema = _adapter(kind).json_schema()
    made: Schema = _inlined(schema, schema.pop("$defs", {}))
    return made


def _adapter(kind: Any) -> TypeAdapter[Any]:
    from pydantic import TypeAdapter  # noqa: PLC0415 - a start can do without it

    return TypeAdapter(kind)


def _inlined(part: Any, named: Mapping[str, Any]) -> Any:
    match part:
        case {"$ref": str() as where, **others}:
            return {**_inlined(named[where.rpartition("/")[2]], named), **others}
        case {"component": str() as name}:
            return component(name)
        case dict():
            return {
                key: _inlined(each, named)
                for key, each in part.items()
                if not (key == "title" and isinstance(each, str))
            }
        case list():
            return [_inlined(each, named) for each in part]
    return part


def _in_words(mistake: ValidationError) -> str:
    """The first mistake, in a sentence."""
    fault = mistake.errors(include_url=False, include_input=False)[0]
    where = ascii(".".join(str(part) for part in fault["loc"])[:_SHOWN_NAME])[1:-1]
    match fault["type"]:
        case "missing":
            return f"{where} is missing"
        case "extra_forbidden":
            return f"there is no value {where} here"
    return f"{where} {re.sub(r'^[A-Z][a-z]+ should ', 'must ', fault['msg'])}"
