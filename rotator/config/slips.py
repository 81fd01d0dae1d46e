"""One line that is no TOML: what the person meant, and the line as it should be.

Knows the slips that people make: a decimal comma, a unit behind the number, a text without quotes, a missing bracket.
Does not know any key, and sees no other line.
"""

from __future__ import annotations

import re
import tomllib
from dataclasses import dataclass

from rotator.config.mistake import NO_BREAK
from rotator.config.statements import parts

_NUMBER = r"[-+]?\d+(?:\.\d+)?"
_COMMA = re.compile(r"([-+]?\d+),(\d+)")
_UNIT = re.compile(rf"({_NUMBER}|[-+]?\d+,\d+)\s*([^\d\s.,\"'\[\]][^\"'\[\]]*)")
_POINT = re.compile(r"([-+]?)(\d*)\.(\d*)")
_ZEROS = re.compile(r"([-+]?)0+(\d+(?:\.\d+)?)")
_KEY = re.compile(r"\s*([^=:#\[\]\"']+?)\s*(==|=|:=|:)\s*(.*)")
_KEY_WITHOUT_SIGN = re.compile(r"([A-Za-z_]\w*)\s+([-+\d\"'].*)")
_HEADING = re.compile(r"\[{0,2}\s*([A-Za-z_][\w. -]*?)\s*\]{0,2}\s*[;:,]?\s*(?:#.*)?")
_WORDS = {
    "true": "true", "yes": "true", "on": "true", "ja": "true", "oui": "true", "si": "true",
    "false": "false", "no": "false", "off": "false", "nein": "false", "non": "false",
}  # fmt: skip
_NOTHING = ("none", "null", "nil", "n/a", "-", "--")
_CURLY = str.maketrans(dict.fromkeys("“”„‟«»″", '"') | dict.fromkeys("‘’‚‛′", "'"))
_UNITS = {
    ("s", "ms"): 0.001, ("s", "µs"): 1e-6, ("s", "us"): 1e-6, ("s", "min"): 60, ("s", "h"): 3600, ("hz", "khz"): 1e3,
    ("hz", "mhz"): 1e6, ("v", "mv"): 0.001, ("dps", "rpm"): 6, ("m", "km"): 1000, ("m", "ft"): 0.3048,
}  # fmt: skip
"""The end of a key, a unit that is not its own, and the factor to its own."""
_BASE = re.compile(r"0([XOB])([0-9A-Fa-f]+)|\$([0-9A-Fa-f]+)|([0-9A-Fa-f]{2})h")


@dataclass(frozen=True, slots=True)
class Slip:
    advice: str
    mended: str | None
    """The line as it should be; None: nothing tells what was meant."""


def slip(line: str, reason: str) -> Slip:
    """`reason`: what the reader of TOML says, for a line that shows none of the usual slips."""
    bare = line.strip()
    for found in (_unseen(line), _remark(bare), _quotes(bare), _heading(bare), _value_of(bare), _no_sign(bare)):
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
        tomllib.loads(mended)
    except (tomllib.TOMLDecodeError, RecursionError):
        return None
    right = shown(_before_remark(mended))
    return Slip(f"{shown(bare)}: {why}: write {right.replace(' ', NO_BREAK) if len(right) < 30 else right}", mended)


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


def _value_of(bare: str) -> Slip | None:
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
    why, better = _in_unit(key, value) or _better(value)
    return _write(bare, f"{key} = {better}  {remark}".rstrip(), why) if better else None


def _better(value: str) -> tuple[str, str]:
    """What is wrong with a value, and the right one; empty texts for a value with another slip."""
    if comma := _COMMA.fullmatch(value):
        return "a number has a point, no comma", f"{comma[1]}.{comma[2]}"
    if zeros := _ZEROS.fullmatch(value):
        return "no zeros before a number", f"{zeros[1]}{zeros[2]}"
    if (point := _POINT.fullmatch(value)) and (point[2] or point[3]):
        return "digits belong on both sides of the point", f"{point[1]}{point[2] or 0}.{point[3] or 0}"
    if base := _BASE.fullmatch(value):
        return "the form of such a number is 0x48", f"0{(base[1] or 'x').lower()}{base[2] or base[3] or base[4]}"
    if value.lower() in _WORDS:
        return "only true or false", _WORDS[value.lower()]
    if value.lower() in _NOTHING:
        return "", ""
    if unit := _UNIT.fullmatch(value):
        return f"the number alone, without {unit[2].strip()}", _number(unit[1])
    if value[0] == "[":
        return _better_list(value)
    if value[0] in "\"'":
        return _better_text(value)
    if re.fullmatch(r"[^\"'\[\]{}=]+[\"']?", value):
        return "a text stands in quotes", f'"{value.rstrip(chr(34) + chr(39))}"'.replace("\\", "/")
    return "", ""


def _in_unit(key: str, value: str) -> tuple[str, str] | None:
    """A number with a unit that is not the key's own; None for another value."""
    found = _UNIT.fullmatch(value)
    factor = found and _UNITS.get((key.rpartition("_")[2], found[2].strip().lower()))
    if not found or not factor:
        return None
    return (
        f"the number alone, in the key's own unit ({key.rpartition('_')[2]})",
        f"{float(_number(found[1])) * factor:g}",
    )


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


def _no_sign(bare: str) -> Slip | None:
    if found := _KEY_WITHOUT_SIGN.fullmatch(bare):
        value = _before_remark(found[2])
        right = _write(bare, f"{found[1]} = {found[2]}", "a = is missing")
        return right or _write(bare, f"{found[1]} = {_better(value)[1]}", "a = is missing")
    if len(bare.split()) > 2 and "=" not in bare:
        return Slip(f"{shown(bare)}: if it is a remark, write # before it", f"# {bare}")
    return None


def _number(text: str) -> str:
    return text.replace(",", ".")


def _before_remark(value: str) -> str:
    """A value without the remark behind it; a # within quotes is none."""
    kept = re.match(r"""(?:"(?:\\.|[^"\\])*"|'[^']*'|[^#"']|["'](?=[^"']*$))*""", value)
    return (kept[0] if kept else value).rstrip()
