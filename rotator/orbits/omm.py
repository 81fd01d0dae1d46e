"""Orbit mean-elements messages: JSON, CSV, XML and KVN → `Elements`, as CelesTrak, Space-Track, SatNOGS and CCSDS write
them, and back to JSON.

Knows the names of the fields and what must be in them. Does not know files.
"""

from __future__ import annotations

import csv
import json
import math
from collections.abc import Iterable, Iterator, Mapping
from datetime import UTC, datetime, timedelta
from typing import TYPE_CHECKING, Any

from rotator.exchange.foreign import json_of, xml_of
from rotator.orbits import tle
from rotator.orbits.elements import Elements

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element

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

_NAMES = ("tle0", "tle_line0", "line0", "object_name", "name", "satname", "sat_name")
"""The keys, in small letters, under which a message with the lines of a TLE may have the name."""


def read_json(text: str) -> Iterator[Elements | str]:
    """Each message of a list, or a single one, or one a line; a sentence with its number in place of each wrong one.

    A message may have the two lines of a TLE in place of OMM's fields, under any keys. Raises ValueError where the text
    is no such list.
    """
    try:
        messages = json_of(text)
    except json.JSONDecodeError as fault:
        if fault.msg != "Extra data" or not text.lstrip().startswith("{"):
            raise ValueError(f"line {fault.lineno}: no JSON ({fault.msg})") from fault
        messages = [json_of(line) for line in text.split("\n") if line.strip()]
    if isinstance(messages, dict):
        # Some servers put the list into an object, beside the number of its page.
        lists = [value for value in messages.values() if isinstance(value, list) and "MEAN_MOTION" not in messages]
        messages = lists[0] if len(lists) == 1 else [messages]
    if not isinstance(messages, list):
        raise ValueError("no list of messages")
    if messages and all(isinstance(each, str) for each in messages):
        messages = [messages]
    for number, message in enumerate(messages, 1):
        if not isinstance(message, (dict, list)):
            yield f"message {number}: no object with fields"
        elif lines := _tle_lines(message):
            yield from _said(f"message {number}", tle.read(lines))
        elif isinstance(message, list):
            yield f"message {number}: no object with fields"
        else:
            yield from _message(f"message {number}", message)


def _tle_lines(message: dict[str, object] | list[object]) -> str:
    """The text of a TLE in a message that has its lines and not the fields of OMM; else empty."""
    if "MEAN_MOTION" in message:
        return ""
    values = message if isinstance(message, list) else message.values()
    texts = [value.strip() for value in values if isinstance(value, str)]
    lines = sorted(text for text in texts if tle.looks_like_tle(text))
    if isinstance(message, list):
        return "\n".join(texts) if lines else ""
    fields = {key.lower(): value for key, value in message.items() if isinstance(value, str)}
    name = next((fields[key] for key in _NAMES if fields.get(key)), "")
    return "\n".join([" ".join(name.split()), *lines]) if lines else ""


def _message(where: str, message: Mapping[str, Any]) -> Iterator[Elements | str]:
    try:
        yield _elements(message)
    except ValueError as fault:
        yield f"{where}{_of(message)}: {fault}"


def _said(where: str, found: Iterable[Elements | str]) -> Iterator[Elements | str]:
    for each in found:
        yield each if isinstance(each, Elements) else type(each)(f"{where}: {each.partition(': ')[2]}")


def read_xml(text: str) -> Iterator[Elements | str]:
    """Each segment of the messages, whatever its namespace. Raises ValueError for what is no XML."""
    root = xml_of(text)
    segments = [each for each in root.iter() if _local(each) == "SEGMENT"] or [root]
    for number, segment in enumerate(segments, 1):
        fields = {_local(each): (each.text or "").strip() for each in segment.iter() if not len(each)}
        yield from _message(f"message {number}", fields)


def _local(element: Element) -> str:
    return str(element.tag).rpartition("}")[2].upper()


def read_kvn(text: str) -> Iterator[Elements | str]:
    """Each message of a text of `KEY = value [unit]`. A key that comes again begins the next message."""
    fields: dict[str, str] = {}
    begun = 1
    for number, line in enumerate(text.split("\n"), 1):
        key, sign, value = line.partition("=")
        key = key.strip().upper()
        if not sign or key.startswith(("COMMENT", "#")):
            continue
        if key in fields or (key == "CCSDS_OMM_VERS" and fields):
            yield from _message(f"line {begun}", fields)
            fields = {}
        if not fields:
            begun = number
        fields[key] = value.partition("[")[0].strip() if key != "OBJECT_NAME" else value.strip()
    yield from _message(f"line {begun}", fields)


def read_csv(text: str) -> Iterator[Elements | str]:
    """Each line below the heading; a sentence with its number in place of each wrong line.

    Raises ValueError without a heading of OMM's fields.
    """
    rows = text.split("\n")
    above = next((at for at, row in enumerate(rows) if row.strip() and not row.startswith("#")), 0)
    lines = csv.DictReader(rows[above:])
    try:
        heading = [name.strip() for name in lines.fieldnames or ()]
    except csv.Error as fault:
        raise ValueError(f"line {above + 1}: {fault}") from fault
    missing = [name for name in ("NORAD_CAT_ID", "EPOCH", *FIELDS) if name not in heading]
    if missing:
        raise ValueError(f"line {above + 1}: the heading lacks {', '.join(missing)}")
    lines.fieldnames = heading
    while True:
        try:
            line = next(lines)
        except StopIteration:
            return
        except csv.Error as fault:
            raise ValueError(f"line {above + lines.line_num}: {fault}") from fault
        yield from _message(f"line {above + lines.line_num}", line)


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
        if usual not in value.upper():
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
    """`2025-02-28T12:59:48.172128`, or `2025-059T12:59:48.172128`: UTC, with or without a Z."""
    year, day, rest = text.strip()[:4], text.strip()[5:8], text.strip()[8:]
    try:
        if day.isdecimal() and rest[:1] == "T":
            moment = datetime.fromisoformat(f"{year}-01-01{rest}") + timedelta(days=int(day) - 1)
        else:
            moment = datetime.fromisoformat(text.strip())
    except (ValueError, OverflowError):
        raise ValueError(f"EPOCH is {text[:32]!r}, no date and time") from None
    return (moment if moment.tzinfo else moment.replace(tzinfo=UTC)).timestamp()


def _of(message: Mapping[str, Any]) -> str:
    name = str(message.get("OBJECT_NAME") or message.get("NORAD_CAT_ID") or "").strip()
    return f" ({name[:24]})" if name else ""
