"""One line that is no TOML: what the person meant, and the line as it should be.

Knows the slips that people make: a decimal comma, a unit behind the number, a text without quotes, a missing bracket.
Of keys it knows what a caller says: which are numbers, and which are texts. Sees no other line.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from rotator.config.mistake import NO_BREAK
from rotator.config.quantity import numbers
from rotator.config.statements import parts
from rotator.exchange.foreign import toml_of

Sort = Literal["number", "whole", "text"]
"""What belongs behind a key: a number, a whole number, or a text. Other keys have none of these."""

LONGEST = 400
"""Characters of a line that is looked at: a longer one is no slip that a person would see."""
_NUMBER = r"[-+]?\d+(?:\.\d+)?"
_UNIT = re.compile(rf"(?:{_NUMBER}|[-+]?\d+,\d+)\s*([^\d\s.,\"'\[\]][^\"'\[\]]*)")
_POINT = re.compile(r"([-+]?)(\d*)\.(\d*)")
_KEY = re.compile(r"\s*([^=:#\[\]\"']+?)\s*(==|=|:=|:)\s*(.*)")
_KEY_WITHOUT_SIGN = re.compile(r"([A-Za-z_]\w*)\s+([-+\d\"'].*)")
_HEADING = re.compile(r"\[{0,2}\s*([A-Za-z_][\w. -]*?)\s*\]{0,2}\s*[;:,]?\s*(?:#.*)?")
_WORDS = {
    "true": "true", "yes": "true", "on": "true", "ja": "true", "oui": "true", "si": "true",
    "false": "false", "no": "false", "off": "false", "nein": "false", "non": "false",
}  # fmt: skip
_NOTHING = ("none", "null", "nil", "n/a", "-", "--")
_CURLY = str.maketrans(dict.fromkeys("“”„‟«»″", '"') | dict.fromkeys("‘’‚‛′", "'"))
_BASE = re.compile(r"0([XOB])([0-9A-Fa-f]+)|\$([0-9A-Fa-f]+)|([0-9A-Fa-f]{2})h")


@dataclass(frozen=True, slots=True)
class Slip:
    advice: str
    mended: str | None
    """The line as it should be; None: nothing tells what was meant."""
    why: str = ""
    """The advice without what to write, for a line that is wrong even so."""


def slip(line: str, reason: str, sorts: Mapping[str, Sort]) -> Slip:
    """`reason`: what the reader of TOML says, for a line that shows none of the usual slips. `sorts`: by key."""
    bare = line.strip()
    if len(bare) > LONGEST:
        return Slip(f"{shown(bare)}: is not TOML: {reason}", None)
    for found in (
        _unseen(line), _remark(bare), _quotes(bare), _heading(bare), _value_of(bare, sorts), _no_sign(bare, sorts),
    ):  # fmt: skip
        if found:
            return found
    return Slip(f"{shown(bare)}: is not TOML: {reason}", None)


def shown(text: str) -> str:
    """A line, or a part of it, as a message shows it."""
    text = "".join(mark if mark.isprintable() else " " for mark in text.strip())
    return text if len(text) <= 60 else text[:57] + "..."


def _write(bare: str, mended: str, why: str) -> Slip | None:
    """Only a line that is TOML is advised."""
    try:
        toml_of(mended)
    except ValueError:
        return None
    right = shown(_before_remark(mended))
    right = right.replace(" ", NO_BREAK) if len(right) < 30 else right
    return Slip(f"{shown(bare)}: {why}: write {right}", mended, f"{shown(bare)}: {why}")


def _unseen(line: str) -> Slip | None:
    for column, mark in enumerate(line.rstrip("\r"), 1):
        if mark in "\u00a0\u2007\u202f\u3000":
            mended = re.sub("[\u00a0\u2007\u202f\u3000]", " ", line)
            return Slip(
                f"{shown(mended)}: a no-break space in column {column}, as copied from a page: write a plain space",
                mended,
            )
        if not mark.isprintable() and mark != "\t":
            mended = "".join(each for each in line if each.isprintable() or each == "\t")
            return Slip(
                f"{shown(mended)}: an invisible character (U+{ord(mark):04X}) in column {column}: delete it", mended
            )
    return None


def _remark(bare: str) -> Slip | None:
    if bare.startswith((";", "//", "--", "/*", "*", "%", "'")) or bare.lower().startswith("rem "):
        return Slip(f"{shown(bare)}: a remark begins with #: write # {shown(bare.lstrip(';/-*% '))}", f"# {bare}")
    return None


def _quotes(bare: str) -> Slip | None:
    if bare.translate(_CURLY) != bare:
        return _write(bare, bare.translate(_CURLY), "these are a text processor's quotes")
    return None


def _heading(bare: str) -> Slip | None:
    found = _HEADING.fullmatch(bare)
    if not found or "=" in bare or not (bare.startswith("[") or "]" in bare):
        return None
    name = re.sub(r"\s*\.\s*|\s+", ".", found[1])
    double = bare.startswith("[[") or "]]" in bare
    mended = f"[[{name}]]" if double else f"[{name}]"
    return _write(bare, mended, "the heading's brackets do not match" if " " not in found[1] else "no heading")


def _value_of(bare: str, sorts: Mapping[str, Sort]) -> Slip | None:
    """A line with a key and a value."""
    found = _KEY.fullmatch(bare)
    if not found:
        return None
    key, sign, value = found.groups()
    if not parts(key):
        better = re.sub(r"[^\w.-]+", "_", key)
        return _write(bare, f"{better} = {value}", "a key has no spaces and no accents")
    if sign != "=" and (mended := _write(bare, f"{key} = {value}", "a single = belongs between key and value")):
        return mended
    value, remark = _before_remark(value), value[len(_before_remark(value)) :]
    if not value:
        return Slip(f"{key} = without a value: write one, or take the line out", None)
    name = parts(key)[-1]
    sort = sorts.get(name)
    meant = [] if sort == "text" or value[0] == "[" else numbers(value, name, whole=sort == "whole")
    if len(meant) > 1:
        return Slip(f"{shown(bare)}: may be {' or '.join(meant)}: write the one that you mean", None)
    if not meant and sort in ("number", "whole") and value[0] != "[":
        return Slip(f"{shown(bare)}: {alone(name, whole=sort == 'whole')}", None)
    why, better = (_why_not(value), meant[0]) if meant else _better(value, sort)
    return _write(bare, f"{key} = {better}  {remark}".rstrip(), why) if better else None


def alone(key: str, *, whole: bool) -> str:
    """What belongs behind a key for a number, where nothing tells which number was meant."""
    unit = {"deg": ", in degrees", "dps": ", in degrees a second", "m": ", in metres", "s": ", in seconds",
            "v": ", in volts", "hz": ", in hertz"}.get(key.rpartition("_")[2], "")  # fmt: skip
    return f"write {'a whole number' if whole else 'one number'} alone{unit}"


def _why_not(value: str) -> str:
    """Why a value that means a number is none."""
    if value[0] in "\"'":
        return "a number stands without quotes"
    if re.fullmatch(r"[-+]?0\d+(?:\.\d+)?", value):
        return "no zeros before a number"
    if _POINT.fullmatch(value):
        return "digits belong on both sides of the point"
    if _BASE.fullmatch(value):
        return "the form of such a number is 0x48"
    if re.fullmatch(r"[-+]?\d+,\d+", value):
        return "a number has a point, no comma"
    if (unit := _UNIT.fullmatch(value)) and not any(mark.isdigit() for mark in unit[1]):
        return f"the number alone, in the key's own unit, without {unit[1].strip()}"
    return "one number belongs here"


def _better(value: str, sort: Sort | None) -> tuple[str, str]:
    """What is wrong with a value, and the right one; empty texts for a value with another slip."""
    if sort != "text" and value.lower() in _WORDS:
        return "only true or false", _WORDS[value.lower()]
    if value.lower() in _NOTHING:
        return "", ""
    if value[0] == "[":
        return _better_list(value)
    if value[0] in "\"'":
        return _better_text(value)
    if re.fullmatch(r"[^\"'\[\]{}=]+[\"']?", value):
        return "a text stands in quotes", f'"{value.rstrip(chr(34) + chr(39) + ";, ")}"'.replace("\\", "/")
    return "", ""


def _better_list(value: str) -> tuple[str, str]:
    if value.count("[") > value.count("]"):
        return "a bracket is missing", value.rstrip(" ,") + "]" * (value.count("[") - value.count("]"))
    if value.count("]") > value.count("["):
        return "a bracket too many", value[: len(value) - (value.count("]") - value.count("["))]
    # Only with two digits and a leading zero behind it a comma cannot be that of the list.
    pointed = re.sub(r"(?<![\d.])([-+]?\d+),(\d*[1-9]|0\d+)(?=\s*[,\]])", r"\1.\2", value)
    if pointed != value:
        return "a number has a point, no comma", pointed
    spaced = re.sub(rf"({_NUMBER})\s+(?=[-+\d])", r"\1, ", value)
    spaced = re.sub(r"\]\s*\[", "], [", spaced)
    return ("a comma belongs between two values", spaced) if spaced != value else ("", "")


def _better_text(value: str) -> tuple[str, str]:
    mark = value[0]
    if value.count(mark) == 1:
        inside = value[1:].rstrip("\"'").rstrip()
        return "the quote at the end is missing", f"{mark}{inside}{mark}".replace("\\", "/")
    if "\\" in value and mark == '"':
        return "no \\ in quotes", value.replace("\\", "/")
    end = value.find(mark, 1) + 1
    return f"{shown(value[end:])} behind the text is too much", value[:end]


def _no_sign(bare: str, sorts: Mapping[str, Sort]) -> Slip | None:
    if found := _KEY_WITHOUT_SIGN.fullmatch(bare):
        line = f"{found[1]} = {found[2]}"
        if right := _write(bare, line, "a = is missing"):
            return right
        then = _value_of(line, sorts)
        return _write(bare, then.mended, "a = is missing") if then and then.mended else None
    if len(bare.split()) > 2 and "=" not in bare:
        return Slip(f"{shown(bare)}: if it is a remark, write # before it", f"# {bare}")
    return None


def _before_remark(value: str) -> str:
    """A value without the remark behind it. A # within quotes is none; marks of minutes and seconds are no quotes."""
    kept = re.match(r"""(?:"(?:\\.|[^"\\])*"|'[^']*'|[^#"']|["'](?=[^"']*$))*""", value)
    if not kept or value[kept.end() : kept.end() + 1] not in ("", "#"):
        return value.partition("#")[0].rstrip()
    return kept[0].rstrip()
