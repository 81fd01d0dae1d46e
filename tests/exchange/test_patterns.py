"""Every regular expression of the program, on texts made to be slow for it: four times the text takes about four times
the time.

The patterns are found in the syntax trees of all modules, with the way in which each is used. The hostile texts come
from the pattern itself: what each of its repeats takes, very often, after the shortest text that leads there. Ratios
of the thread's own processor time are compared, and only what is slow in every one of several tries counts.
"""

from __future__ import annotations

import ast
import importlib
import re
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from re import _constants as op  # type: ignore[attr-defined]
from re import _parser as parser  # type: ignore[attr-defined]
from typing import Any

import pytest

ROOT = Path(__file__).parents[2]
WAYS = ("match", "fullmatch", "search", "split", "sub", "subn", "findall", "finditer")
LENGTHS, TIMES = (150, 1200), 4
LINEAR = 2.25 * TIMES
"""Between the 4 of a linear pattern and the 16 of a quadratic one, nearer to neither in logarithms of time."""
TRIES, PIECES = 4, 12
BOUNDED = {
    # Where the text is bounded first, and the pattern is easier to read as it is.
    "rotator.setup.questions": "an answer has LONGEST characters at most",
}

Pattern = re.Pattern[str] | re.Pattern[bytes]


def found() -> dict[tuple[str, str | bytes, int], set[str]]:
    """By module, pattern and flags: the ways in which it is used."""
    uses: dict[tuple[str, str | bytes, int], set[str]] = {}
    for path in sorted([*(ROOT / "rotator").rglob("*.py"), *(ROOT / "hw").rglob("*.py")]):
        source = path.read_text(encoding="utf-8")
        if "import re\n" not in source and "re." not in source:
            continue
        name = ".".join(path.relative_to(ROOT).with_suffix("").parts)
        if name.endswith("__main__"):
            continue
        module = importlib.import_module(name)
        tree = ast.parse(source)
        named = {key: value for key, value in vars(module).items() if isinstance(value, re.Pattern)}
        used: dict[str, set[str]] = {key: set() for key in named}
        for call in (node for node in ast.walk(tree) if isinstance(node, ast.Call)):
            match call.func:
                case ast.Attribute(ast.Name("re"), way) if way in WAYS:
                    pattern = written(call.args[0], module)
                    flags = {each.arg: each.value for each in call.keywords}.get("flags")
                    given = [*call.args[2:3]] if way in ("match", "fullmatch", "search", "findall", "finditer") else []
                    set_ = flags or (given[0] if given else None)
                    if pattern is not None:
                        bits = eval(compile(ast.Expression(set_), name, "eval"), vars(module)) if set_ else 0
                        uses.setdefault((name, pattern, int(bits)), set()).add(way)
                case ast.Attribute(ast.Name(owner), way) if way in WAYS and owner in named:
                    used[owner].add(way)
        for key, kept in named.items():
            uses.setdefault((name, kept.pattern, kept.flags), set()).update(used[key] or {"search", "fullmatch"})
    return uses


def written(node: ast.expr, module: Any) -> str | bytes | None:
    """The pattern that an argument of `re` spells. None: it is made of what is known only at run time."""
    try:
        value = eval(compile(ast.Expression(node), module.__name__, "eval"), vars(module))
    except NameError:
        return None
    return value if isinstance(value, (str, bytes)) else None


def hostile(pattern: Pattern) -> Iterator[tuple[str, str]]:
    """What leads to each repeat, and what it takes again and again."""
    for lead, body in repeats(parser.parse(pattern.pattern, pattern.flags), ""):
        for piece in pieces(body):
            yield lead, piece


def repeats(tree: Any, lead: str) -> Iterator[tuple[str, Any]]:
    for code, value in tree:
        if code in (op.MAX_REPEAT, op.MIN_REPEAT, op.POSSESSIVE_REPEAT):
            least, most, body = value
            if most > 50:
                yield lead, body
                # Beside its own text: that of the repeats inside, each as one of many.
            yield from repeats(body, lead)
            lead += shortest(body) * least
            continue
        match code:
            case op.SUBPATTERN:
                yield from repeats(value[3], lead)
            case op.ATOMIC_GROUP:
                yield from repeats(value, lead)
            case op.BRANCH:
                for branch in value[1]:
                    yield from repeats(branch, lead)
            case op.ASSERT | op.ASSERT_NOT:
                yield from repeats(value[1], lead)
        lead += shortest([(code, value)])


def shortest(tree: Any) -> str:
    return next(iter(pieces(tree)), "")


def pieces(tree: Any) -> list[str]:
    """Some texts that this part of a pattern takes."""
    texts = [""]
    for code, value in tree:
        match code:
            case op.LITERAL:
                here = [chr(value)]
            case op.NOT_LITERAL:
                here = [next(each for each in "a 1" if ord(each) != value)]
            case op.ANY:
                here = ["a", " "]
            case op.IN:
                here = taken(value)
            case op.BRANCH:
                here = [text for branch in value[1] for text in pieces(branch)]
            case op.SUBPATTERN:
                here = pieces(value[3])
            case op.ATOMIC_GROUP:
                here = pieces(value)
            case op.MAX_REPEAT | op.MIN_REPEAT | op.POSSESSIVE_REPEAT:
                least, _, body = value
                here = [text * max(least, 1) for text in pieces(body)] + ([""] if least == 0 else [])
            case _:
                here = [""]
        texts = [text + more for text in texts for more in here][:PIECES]
    return list(dict.fromkeys(text for text in texts if text)) or [""]


def taken(items: Any) -> list[str]:
    """Characters of a class, of different kinds."""
    return [each for each in " a1-.,_\"'[(<=&\n" if belongs(ord(each), items)] or [
        chr(next(value if code is op.LITERAL else value[0] for code, value in items if code is not op.NEGATE))
    ]


def belongs(character: int, items: Any) -> bool:
    inside, negated = False, False
    for code, value in items:
        match code:
            case op.NEGATE:
                negated = True
            case op.LITERAL:
                inside |= character == value
            case op.RANGE:
                inside |= value[0] <= character <= value[1]
            case op.CATEGORY:
                kind = {op.CATEGORY_SPACE: r"\s", op.CATEGORY_DIGIT: r"\d", op.CATEGORY_WORD: r"\w"}
                nots = {op.CATEGORY_NOT_SPACE: r"\S", op.CATEGORY_NOT_DIGIT: r"\D", op.CATEGORY_NOT_WORD: r"\W"}
                inside |= re.fullmatch((kind | nots)[value], chr(character)) is not None
    return inside is not negated


ENDS = ("", "\x01")


def growth(run: Callable[[str], object], lead: str, piece: str, end: str) -> float:
    """How many times the time of a text the one of `TIMES` its length takes: the least of several tries."""
    for length in LENGTHS:
        tries = (_ratio(run, lead, piece, end, length) for _ in range(TRIES))
        times = next((each for each in tries if each < LINEAR), None)
        if times is None:
            return _ratio(run, lead, piece, end, length)
    return 0.0


def _ratio(run: Callable[[str], object], lead: str, piece: str, end: str, length: int) -> float:
    short, long = (_least_ns(run, lead + piece * (each // len(piece)) + end) for each in (length, length * TIMES))
    return long / short


def _least_ns(run: Callable[[str], object], text: str) -> int:
    spans = []
    for _ in range(2):
        begun = time.thread_time_ns()
        run(text)
        spans.append(time.thread_time_ns() - begun)
    return max(min(spans), 5000)  # what is shorter is no time: a bounded pattern may fail later than it matches


def runner(pattern: Pattern, way: str) -> Callable[[str], object]:
    def run(text: str) -> object:
        subject: Any = text.encode("latin-1", "replace") if isinstance(pattern.pattern, bytes) else text
        doing = getattr(pattern, way)
        if way in ("sub", "subn"):
            return doing(subject[:0], subject)
        return list(doing(subject)) if way == "finditer" else doing(subject)

    return run


@pytest.mark.search
def test_no_text_is_slow_for_any_pattern() -> None:
    for (module, text, flags), ways in found().items():
        if module in BOUNDED:
            continue
        pattern = re.compile(text, flags)
        for way in ways:
            for lead, piece in hostile(pattern):
                for end in ENDS if piece else ():
                    times = growth(runner(pattern, way), lead, piece, end)
                    slow = f"{way}({lead!r} + {piece!r} * n + {end!r}): {times:.0f} times for {TIMES}"
                    assert times < LINEAR, f"{module}, {text!r}: {slow}"
