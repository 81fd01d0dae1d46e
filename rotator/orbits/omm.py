"""Orbit mean-elements messages: JSON and CSV ⇄ `Elements`, as CelesTrak and Space-Track write them.

Knows the names of the fields and what must be in them. Does not know files.
"""

from __future__ import annotations

import csv
import json
import math
from collections.abc import Iterator, Mapping
from datetime import UTC, datetime
from typing import Any

from rotator.orbits.elements import Elements

FIELDS = {
    "MEAN_MOTION": "mean_motion_rev_per_day",
    "ECCENTRICITY": "eccentricity",
    "INCLINATION": "inclination_deg",
    "RA_OF_ASC_NODE": "ascending_node_deg",
    "ARG_OF_PERICENTER": "perigee_argument_deg",
    "MEAN_ANOMALY": "mean_anomaly_deg",
}
OPTIONAL = {
    "BSTAR": "drag_per_earth_radius",
    "MEAN_MOTION_DOT": "mean_motion_dot",
    "MEAN_MOTION_DDOT": "mean_motion_ddot",
}
"""Optional fields. Without them the orbit loses no height, which is good enough for a few days."""


def read_json(text: str) -> Iterator[Elements | str]:
    """Each message of a list, or a single one; a sentence with its number in place of each wrong message.

    Raises ValueError where the text is no such list.
    """
    try:
        messages = json.loads(text)
    except json.JSONDecodeError as fault:
        raise ValueError(f"line {fault.lineno}: no JSON ({fault.msg})") from fault
    except RecursionError as fault:
        raise ValueError("no list of messages: too deep") from fault
    if isinstance(messages, dict):
        messages = [messages]
    if not isinstance(messages, list):
        raise ValueError("no list of messages")
    for number, message in enumerate(messages, 1):
        if not isinstance(message, dict):
            yield f"message {number}: no object with fields"
            continue
        try:
            yield _elements(message)
        except ValueError as fault:
            yield f"message {number}{_of(message)}: {fault}"


def read_csv(text: str) -> Iterator[Elements | str]:
    """Each line below the heading; a sentence with its number in place of each wrong line.

    Raises ValueError without a heading of OMM's fields.
    """
    lines = csv.DictReader(text.splitlines())
    heading = [name.strip() for name in lines.fieldnames or ()]
    missing = [name for name in ("NORAD_CAT_ID", "EPOCH", *FIELDS) if name not in heading]
    if missing:
        raise ValueError(f"line 1: the heading lacks {', '.join(missing)}")
    lines.fieldnames = heading
    while True:
        try:
            line = next(lines)
        except StopIteration:
            return
        except csv.Error as fault:
            raise ValueError(f"line {lines.line_num}: {fault}") from fault
        try:
            yield _elements(line)
        except ValueError as fault:
            yield f"line {lines.line_num}{_of(line)}: {fault}"


def message(elements: Elements) -> dict[str, object]:
    """The elements in the form that `read_json` reads."""
    epoch = datetime.fromtimestamp(elements.epoch_utc_s, UTC).isoformat(timespec="microseconds")
    return {
        "OBJECT_NAME": elements.name,
        "EPOCH": epoch.removesuffix("+00:00"),
        **{key: getattr(elements, field) for key, field in (FIELDS | OPTIONAL).items()},
        "NORAD_CAT_ID": elements.catalogue_number,
    }


def _elements(message: Mapping[str, Any]) -> Elements:
    for key, usual in (("CENTER_NAME", "EARTH"), ("REF_FRAME", "TEME"), ("MEAN_ELEMENT_THEORY", "SGP4")):
        value = str(message.get(key) or usual)
        if not value.upper().startswith(usual):
            raise ValueError(f"{key} is {value[:24]}, not {usual}")
    number = _number(message, "NORAD_CAT_ID")
    if number != int(number):
        raise ValueError(f"NORAD_CAT_ID {number:g} is no whole number")
    quantities = {field: _number(message, key) for key, field in FIELDS.items()}
    quantities |= {
        field: _number(message, key) for key, field in OPTIONAL.items() if message.get(key) not in (None, "")
    }
    name = str(message.get("OBJECT_NAME") or "").strip()
    return Elements(
        name=name or str(int(number)),
        catalogue_number=int(number),
        epoch_utc_s=_utc_s(str(message.get("EPOCH") or "")),
        **quantities,
    )


def _number(message: Mapping[str, Any], key: str) -> float:
    value = message.get(key)
    if value is None or value == "":
        raise ValueError(f"{key} is missing")
    try:
        found = float(value if not isinstance(value, bool) else "")
    except (TypeError, ValueError, OverflowError):
        found = math.nan
    if not math.isfinite(found):
        raise ValueError(f"{key} is {str(value)[:24]!r}, no number")
    return found


def _utc_s(text: str) -> float:
    """`2025-02-28T12:59:48.172128`: UTC, with or without a Z."""
    try:
        moment = datetime.fromisoformat(text.strip())
    except ValueError:
        raise ValueError(f"EPOCH is {text[:32]!r}, no date and time") from None
    return (moment if moment.tzinfo else moment.replace(tzinfo=UTC)).timestamp()


def _of(message: Mapping[str, Any]) -> str:
    name = str(message.get("OBJECT_NAME") or message.get("NORAD_CAT_ID") or "").strip()
    return f" ({name[:24]})" if name else ""
