"""Two-line elements: from text to `Elements`, with names or without. Catalogue numbers may be in Alpha-5.

Knows the columns, the checksum, the year 1957, and what stands around the sets in files of today: a header, remarks,
sizes and magnitudes behind the names. Does not know files.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from datetime import UTC, datetime, timedelta

from rotator.orbits.elements import Elements, Notice

LENGTH = 69
FIRST_YEAR = 57
"""Two-digit years from this on belong to the last century: Sputnik flew in 1957."""
ALPHA5 = "ABCDEFGHJKLMNPQRSTUVWXYZ"
"""A stands for 10, Z for 33. I and O are left out, for they look like digits."""
NAME_COLUMNS = 24
"""Longer lines above a name are prose."""
END = "/EX"
"""Ends a message of packet radio, as AMSAT's lists are."""
SIZES = 3
"""Some lists have length, width and depth behind the name, and perhaps a magnitude with the letter of its origin."""
_LINE = re.compile(r"([12]) [ 0-9A-Z][ 0-9]{4}", re.IGNORECASE)
_SIZE = re.compile(r"-?[0-9]{1,3}\.[0-9]{1,2}")
_REMARK = re.compile(r"#|//|(?:<[^<>]*+>)++$")
_POINTS = ((23, 34), (11, 20, 37, 46, 54))
"""The columns of the decimal points, in the first and in the second line."""


def looks_like_tle(text: str) -> bool:
    """Whether a line of the text begins as a TLE's does."""
    return any(_LINE.match(line.lstrip()) for line in text.splitlines())


def read(text: str) -> Iterator[Elements | str]:
    """Each set of a text, in its order; a sentence with its line in place of each wrong set."""
    texts: list[tuple[int, str]] = []
    """The lines of text before a set: the last is its name. An empty line ends a header."""
    alone = False
    first: tuple[int, str] | None = None
    unchecked = []
    for number, line in enumerate((line.strip() for line in text.split("\n")), 1):
        found = _LINE.match(line)
        if line == END:
            break
        if not line:
            alone = True
        elif _REMARK.match(line):
            continue
        elif found and found[1] == "1":
            if first is not None:
                yield f"line {first[0]}: its second line is missing"
            first = (number, line)
            yield from _without_set(texts[:-1])
        elif found and first is not None:
            try:
                yield _elements(_name(texts[-1][1]) if texts else "", first[1], line)
                unchecked += [first[0]] if len(line) < LENGTH else []
            except ValueError as fault:
                yield f"line {first[0]}: {fault}"
            first, texts = None, []
        elif found:
            yield f"line {number}: its first line is missing"
            texts = []
        else:
            if first is not None:
                yield f"line {first[0]}: its second line is missing"
                first, texts = None, []
            if alone:
                texts, alone = [], False
            texts.append((number, line))
    if first is not None:
        yield f"line {first[0]}: its second line is missing"
    else:
        yield from _without_set(texts)
    if unchecked:
        sets = "a set without checksum is" if len(unchecked) == 1 else f"{len(unchecked)} sets without checksum are"
        yield Notice(f"line {unchecked[0]}: {sets} taken, but nothing would show a wrong digit in it")


def _without_set(texts: Sequence[tuple[int, str]]) -> Iterator[str]:
    if all(len(line) <= NAME_COLUMNS for _, line in texts):
        for number, line in texts:
            yield f'line {number}: "{line}" has no element set'


def _name(line: str) -> str:
    """The name alone, without the zero before it and the sizes behind it."""
    words = line.removeprefix("0 ").split()
    sizes = len(words) - (words[-1:] in (["d"], ["v"]))
    last = sizes
    while last > 1 and _SIZE.fullmatch(words[last - 1]):
        last -= 1
    return " ".join(words[:last] if sizes - last >= SIZES else words)


def alpha5(number: int) -> str:
    """As TLE have it in five characters: 100001 is `A0001`. Empty: the number does not fit."""
    head, tail = divmod(number, 10_000)
    if head < 10:
        return f"{number:05d}"
    return f"{ALPHA5[head - 10]}{tail:04d}" if head - 10 < len(ALPHA5) else ""


def catalogue_number(text: str) -> int:
    """Five characters, the first perhaps a letter. Raises ValueError."""
    text = text.strip().upper()
    head = ALPHA5.find(text[:1]) if text else -1
    digits = text if head < 0 else f"{head + 10}{text[1:]}"
    if not digits.isdecimal():
        raise ValueError(f'"{text}" is no catalogue number')
    return int(digits)


def _elements(name: str, one: str, two: str) -> Elements:
    for place, line in (("first", one), ("second", two)):
        if len(one) == len(two) == LENGTH - 1:
            break  # without a checksum; one line alone has lost a character
        if len(line) != LENGTH:
            raise ValueError(f"its {place} line has {len(line)} characters in place of {LENGTH}")
        if line[68] != str(_checksum(line)):
            raise ValueError(f"the checksum of its {place} line is {_checksum(line)}, not {line[68]}")
    if any(line[column] != "." for line, columns in zip((one, two), _POINTS, strict=True) for column in columns):
        raise ValueError("its columns are shifted")
    number = catalogue_number(one[2:7])
    if catalogue_number(two[2:7]) != number:
        raise ValueError(f"its lines are of {one[2:7].strip()} and {two[2:7].strip()}")
    return Elements(
        name=name or str(number),
        catalogue_number=number,
        epoch_utc_s=_epoch_utc_s(one[18:32]),
        mean_motion_dot=_number(one[33:43]),
        mean_motion_ddot=_with_exponent(one[44:52]),
        drag_per_earth_radius=_with_exponent(one[53:61]),
        inclination_deg=_number(two[8:16]),
        ascending_node_deg=_number(two[17:25]),
        eccentricity=_number("0." + two[26:33].strip().replace(" ", "0")),
        perigee_argument_deg=_number(two[34:42]),
        mean_anomaly_deg=_number(two[43:51]),
        mean_motion_rev_per_day=_number(two[52:63]),
    )


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise ValueError(f'"{text.strip()}" is no number') from None


def _checksum(line: str) -> int:
    """The digits of the first 68 columns added up, a minus as 1, modulo 10."""
    return sum(int(each) if each.isdecimal() else each == "-" for each in line[:68]) % 10


def _epoch_utc_s(text: str) -> float:
    """Year in two digits, then the day of the year with its fraction: `25059.54152977`."""
    year, day = int(_number(text[:2])), _number(text[2:])
    if not 1 <= day < 367:
        raise ValueError(f"its epoch has the day {day:g} of a year")
    begin = datetime(year + (1900 if year >= FIRST_YEAR else 2000), 1, 1, tzinfo=UTC)
    return (begin + timedelta(days=day - 1)).timestamp()


def _with_exponent(text: str) -> float:
    """`-12345-3` is -0.12345e-3: the point is assumed."""
    mantissa, exponent = text[:-2].strip() or "0", text[-2:]
    sign = "-" if mantissa.startswith("-") else ""
    return _number(f"{sign}.{mantissa.lstrip('+-').strip()}e{exponent.replace(' ', '+')}")
