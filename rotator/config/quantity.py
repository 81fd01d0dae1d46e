"""Which number a text means that a person wrote where a number belongs: `48°12'30" S`, `1,5`, `10 kHz`, `GPIO23`.

Knows decimal commas, thousands, degrees with minutes and seconds, the letters of the sky's quarters, and units by the
end of a key. A text that may mean two numbers gives both; one that is not understood to its last character gives none,
so no advice that is made of it can lose a part of what was meant.
"""

from __future__ import annotations

import re
from decimal import Decimal

from rotator.config.i2c import ADDRESSES

_QUARTERS = {
    "n": ("latitude", 1), "north": ("latitude", 1), "nord": ("latitude", 1),
    "s": ("latitude", -1), "south": ("latitude", -1), "süd": ("latitude", -1), "sud": ("latitude", -1),
    "e": ("longitude", 1), "east": ("longitude", 1), "ost": ("longitude", 1), "est": ("longitude", 1),
    "w": ("longitude", -1), "west": ("longitude", -1), "ouest": ("longitude", -1),
}  # fmt: skip
"""Not the letter O: it is east in German and west in French."""
_LETTERS = "|".join(sorted(_QUARTERS, key=len, reverse=True))
_ANGLE = re.compile(
    rf"(?:(?P<before>{_LETTERS})\.?\s*)?(?P<sign>[-+]?)\s*(?P<deg>\d+(?:[.,]\d+)?)(?P<mark>\s*(?:°|deg|:)\s*|\s*)"
    rf"(?:(?<=[°: g])(?P<min>\d+(?:[.,]\d+)?)(?:\s*[':]\s*|\s+|(?=[\"']|$|[a-z])))?"
    rf"(?:(?<=[': ])(?P<sec>\d+(?:[.,]\d+)?)\s*(?:''|\")?)?\s*(?P<after>{_LETTERS})?",
    re.IGNORECASE,
)
"""No `s` as a mark of seconds: it is south."""
_OWN = {
    "deg": ("°", "deg", "degs", "degree", "degrees", "grad"), "dps": ("°/s", "deg/s", "dps", "degrees/s"),
    "m": ("m", "metre", "metres", "meter", "meters", "masl", "m asl"), "v": ("v", "volt", "volts"), "hz": ("hz",),
    "s": ("s", "sec", "secs", "second", "seconds", "sek"), "baud": ("baud", "bd", "bps"), "nm": ("nm",),
}  # fmt: skip
"""By the end of a key: its own unit, as people write it."""
_OTHER = {
    ("s", "ms"): "0.001", ("s", "µs"): "0.000001", ("s", "us"): "0.000001", ("s", "min"): "60", ("s", "h"): "3600",
    ("hz", "khz"): "1000", ("hz", "mhz"): "1000000", ("v", "mv"): "0.001", ("dps", "rpm"): "6",
    ("m", "km"): "1000", ("m", "cm"): "0.01", ("m", "ft"): "0.3048",
}  # fmt: skip
"""The end of a key, a unit that is not its own, and the factor to its own."""
LONGEST = 80
"""Characters of a text that is looked at: no person writes a number with its unit in more."""
_NUMBER = r"[-+]?(?:\d[\d.,' _]*\d|\d)(?:e[-+]?\d+)?"
_PARTS = re.compile(rf"({_NUMBER})\s*(.*)", re.IGNORECASE)
_GROUPS = re.compile(r"\d{1,3}(?:([.,' _])\d{3})(?:\1\d{3})*")
_BASE = re.compile(r"0x([0-9a-f]+)|\$([0-9a-f]+)|([0-9a-f]{2})h", re.IGNORECASE)
_LINE = re.compile(r"(?:gpio|bcm)\s*[-_.]?\s*(\d{1,2})", re.IGNORECASE)
_INPUT = re.compile(r"(?:a|ch|ain|in)\s*(\d)", re.IGNORECASE)
_PLAIN = str.maketrans(
    dict.fromkeys("−–", "-") | dict.fromkeys("º˚", "°") | dict.fromkeys("′’‘", "'") | dict.fromkeys("″“”", '"')
    | dict.fromkeys("\u00a0\u2007\u202f\u2009", " ")
)  # fmt: skip


def numbers(text: str, key: str, *, whole: bool = False) -> list[str]:
    """What the text can mean for this key, as TOML writes it; empty: not understood. `whole`: only whole numbers."""
    bare = text[:LONGEST].translate(_PLAIN).strip().rstrip(";,").strip()
    if len(bare) > 1 and bare[0] == bare[-1] and bare[0] in "\"'":
        bare = bare[1:-1].strip()
    bare = re.sub(r"^([-+]?)([.,]\d)", r"\g<1>0\2", bare)  # .5
    bare = re.sub(r"^([-+]?\d+)[.,](?=\s|$)", r"\1", bare)  # 5.
    found = _whole(bare, key) if whole else _angle(bare, key)
    if found is None:
        found = _with_unit(bare, key, whole=whole)
    return list(dict.fromkeys(found))


def _whole(text: str, key: str) -> list[str] | None:
    """An address, a line or an input; None for other texts."""
    if base := _BASE.fullmatch(text):
        return [f"0x{(base[1] or base[2] or base[3]).lower()}"]
    if key.endswith("address") and re.fullmatch(r"\d[a-f]", text, re.IGNORECASE):
        return [f"0x{text.lower()}"]
    if key.endswith("address") and re.fullmatch(r"\d{2}", text):
        usual = {address for addresses in ADDRESSES.values() for address in addresses}
        both = {f"0x{text}": int(text, 16), text: int(text)}
        return [written for written, address in both.items() if address in usual] or list(both)
    if line := _LINE.fullmatch(text):
        return [str(int(line[1]))]
    if key.endswith(("channel", "input")) and (channel := _INPUT.fullmatch(text)):
        return [channel[1]]
    return None


def _angle(text: str, key: str) -> list[str] | None:
    """Degrees with minutes, seconds or a quarter of the sky; None for other texts."""
    if not key.endswith("_deg"):
        return None
    found = _ANGLE.fullmatch(text)
    if not found:
        return None
    letters = [_QUARTERS[letter.lower()] for letter in (found["before"], found["after"]) if letter]
    place = key.removesuffix("_deg")
    if not letters and found["min"] is None:
        return None
    on_earth = place in ("latitude", "longitude")
    if len(letters) > 1 or any(way != place for way, _ in letters) or (letters and found["sign"]):
        return []
    if found["min"] is not None and not on_earth and "°" not in found["mark"]:
        return []  # `4 50` is rather 450
    parts = [part.replace(",", ".") for part in (found["deg"], found["min"], found["sec"]) if part is not None]
    if any("." in part for part in parts[:-1]) or any(Decimal(part) >= 60 for part in parts[1:]):
        return []
    value = sum((Decimal(part) / 60**at for at, part in enumerate(parts)), Decimal(0))
    sign = letters[0][1] if letters else -1 if found["sign"] == "-" else 1
    return [_written(sign * value)]


def _with_unit(text: str, key: str, *, whole: bool) -> list[str]:
    found = _PARTS.fullmatch(text)
    if not found:
        return []
    factor = _factor(key.rpartition("_")[2], found[2].strip())
    if factor is None:
        return []
    values = [value * factor for value in _values(found[1].strip(), small=key.endswith(("_deg", "_dps", "_v")))]
    return [_written(value) for value in values if not whole or value == value.to_integral_value()]


def _factor(end: str, unit: str) -> Decimal | None:
    """From a unit to that of the key; None for one that cannot be the key's."""
    if not unit or unit.lower() in _OWN.get(end, ()):
        return Decimal(1)
    factor = _OTHER.get((end, unit.lower())) if unit != "mHz" else None
    return Decimal(factor) if factor else None


def _values(text: str, *, small: bool) -> list[Decimal]:
    """`small`: the number cannot be in the thousands."""
    sign = text[0] if text[0] in "+-" else ""
    bare, mark, power = text.lstrip("+-").lower().partition("e")
    tens = Decimal(f"1e{power}") if mark and len(power) < 4 else Decimal(1)
    if mark and len(power) >= 4:
        return []
    found = []
    last = max(bare.rfind("."), bare.rfind(","))
    whole, fraction = (bare[:last], bare[last + 1 :]) if last >= 0 else (bare, "")
    grouped = _GROUPS.fullmatch(whole)
    if fraction.isdigit() or last < 0:
        if whole.isdigit():
            found.append(f"{whole}.{fraction or 0}")
        elif grouped and bare[last] != grouped[1]:
            found.append(f"{re.sub(r'[^0-9]', '', whole)}.{fraction or 0}")
    thousands = _GROUPS.fullmatch(bare) if last >= 0 and not bare.startswith("0") else None
    if thousands and not (small and bare.count(thousands[1]) == 1):
        found.append(re.sub(r"[^0-9]", "", bare))
    return [Decimal(f"{sign}{each}") * tens for each in found]


def _written(value: Decimal) -> str:
    """With six decimals at most where it was computed: for a place on the earth that is a tenth of a metre."""
    exact = value.normalize()
    shown = exact if len(exact.as_tuple().digits) <= 15 else round(value, 6).normalize()
    text = f"{shown:f}"
    return "0" if text in ("-0", "") else text
