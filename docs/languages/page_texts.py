"""The texts of the page's JavaScript: what `rotator/web/static/words.js` looks up while it runs.

Knows comments, strings and nested templates of JavaScript, and cuts the page's templates exactly as words.js does: a
test in Chromium compares both. Does not know the grammar of JavaScript.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

FIRST = 0xE000
"""A value in a template is one character of Unicode's private area: the first of a template is this one."""
_VALUE = re.compile("[\ue000-\uf8ff]")
_TOKEN = re.compile(r"<!--[\s\S]*?-->|<(?:\"[^\"]*\"|'[^']*'|[^>\"'])*>|[^<]+")
_ATTRIBUTE = re.compile(r"([\w-]+)=(?:\"([^\"]*)\"|'([^']*)')")
_AT_LINES = re.compile(r"^\s*\n\s*|\s*\n\s*$")
_WORD = re.compile(r"[^\W\d_]{2}")
READ = ("aria-label", "title", "placeholder", "label", "alt")
VERBATIM = ("code", "pre", "svg", "style")
"""Elements whose text is nobody's language; a drawing has only titles."""
_UNSPOKEN = re.compile(
    r"[A-Z][a-z]+-[A-Z]\w+|\d+px .*|Android|Windows|Mac|Linux|Firefox|Edge?|Chrome|Safari|Date|Enter|Escape"
)
_SPOKEN = re.compile(r"^[A-Z].*[a-z]|[a-zé…] \S|…")


@dataclass
class Template:
    """A template literal: its texts, and the sources of the values between them."""

    tag: str
    texts: list[str] = field(default_factory=lambda: [""])


def literals(source: str) -> Iterator[Template]:
    """Every string and template of a module: a string is a template without values and has the tag `"`. Those inside
    the values come too."""
    yield from _code(source, 0, [], until="")


def _code(source: str, at: int, found: list[Template], until: str) -> list[Template]:
    """The literals of a piece of code that ends at its closing brace."""
    _run(source, at, found, until)
    return found


def _run(source: str, at: int, found: list[Template], until: str) -> int:
    depth, before = 0, ""
    while at < len(source):
        char = source[at]
        if source.startswith("//", at):
            at = (source.find("\n", at) + len(source) + 1) % (len(source) + 1)
        elif source.startswith("/*", at):
            at = source.index("*/", at) + 2
        elif char == "/" and before in "(,=:[!&|?{};\n>" and (regex := _REGEX.match(source, at)):
            at = regex.end()
            before = "/"
        elif char in "\"'":
            closed = _STRING.match(source, at)
            assert closed is not None, source[at : at + 40]
            found.append(Template('"', [_unescaped(closed[0][1:-1])]))
            at, before = closed.end(), '"'
        elif char == "`":
            at, before = _template(source, at + 1, found, _tag(source, at)), "`"
        else:
            if char == until and depth == 0:
                return at + 1
            depth += (char == "{") - (char == "}")
            before = char if not char.isspace() else before
            at += 1
    return at


_STRING = re.compile(r"\"(?:[^\"\\\n]|\\.)*\"|'(?:[^'\\\n]|\\.)*'")
_REGEX = re.compile(r"/(?:[^/\\\n\[]|\\.|\[(?:[^\]\\\n]|\\.)*\])+/[a-z]*")
_UNREAD = re.compile(
    r"\s(?:class|d|points|transform|viewBox|href|key|id|for|type|style|role|value|[xyr]|c[xy]"
    r"|[a-z]+-anchor|aria-current)=$"
)
_NAME = re.compile(r"[\w$]*$")


def _tag(source: str, at: int) -> str:
    named = _NAME.search(source[max(0, at - 20) : at])
    return named[0] if named else ""


def _template(source: str, at: int, found: list[Template], tag: str) -> int:
    template = Template(tag)
    found.append(template)
    begin = at
    while source[at] != "`":
        if source.startswith("${", at):
            template.texts[-1] += _unescaped(source[begin:at])
            inside: list[Template] = []
            begin = at = _run(source, at + 2, inside, "}")
            # A class, a path, an address: words for machines. What is nested in a template of elements may be read.
            machine = tag == "html" and _UNREAD.search(template.texts[-1])
            found += [each for each in inside if each.tag == "html"] if machine else inside
            template.texts.append("")
        else:
            at += 2 if source[at] == "\\" else 1
    template.texts[-1] += _unescaped(source[begin:at])
    return at + 1


def _unescaped(text: str) -> str:
    return re.sub(r"\\(.)", lambda found: {"n": "\n", "t": "\t"}.get(found[1], found[1]), text)


def cut(texts: list[str]) -> list[str]:
    """The messages of one `html` template, as words.js cuts them."""
    joined = "".join(text + (chr(FIRST + at) if at < len(texts) - 1 else "") for at, text in enumerate(texts))
    messages, inside = [], ""
    for token in _TOKEN.findall(joined):
        if not token.startswith("<"):
            if inside not in VERBATIM:
                messages += [text] if (text := message(token)) else []
        elif not token.startswith("<!--"):
            inside = (re.match(r"</?([\w-]*)", token) or [""])[1] if not token.startswith("</") else ""
            for name, *values in _ATTRIBUTE.findall(token):
                if name in READ and (text := message("".join(values))):
                    messages.append(text)
    return messages


def message(run: str) -> str:
    """A run of text as it stands in a catalogue: values are {0}, {1}; empty: it has no word."""
    pieces = [_AT_LINES.sub("", piece) for piece in _VALUE.split(run)]
    if not any(_WORD.search(piece) for piece in pieces):
        return ""
    whole = "".join(piece + (f"{{{at}}}" if at < len(pieces) - 1 else "") for at, piece in enumerate(pieces))
    return re.sub(r"\s+", " ", whole).strip()


def messages(source: str) -> list[str]:
    """All texts of a module that a person may read, each once."""
    found: list[str] = []
    for each in literals(source):
        if each.tag == "html":
            found += cut(each.texts)
            found += [value for value in _given(each.texts) if _SPOKEN.search(value)]
        elif each.tag in ('"', "") and (text := message("".join(_marked(each.texts)))) and _SPOKEN.search(text):
            found.append(text)
    return [text for text in dict.fromkeys(found) if not _UNSPOKEN.fullmatch(text)]


def _marked(texts: list[str]) -> Iterator[str]:
    for at, text in enumerate(texts):
        yield text + (chr(FIRST + at) if at < len(texts) - 1 else "")


def _given(texts: list[str]) -> Iterator[str]:
    """Texts that a template hands to a component, which shows them: `yes="Park it"`."""
    for token in _TOKEN.findall("".join(_marked(texts))):
        if re.match("<[\ue000-\uf8ff]", token):
            for _, *values in _ATTRIBUTE.findall(token):
                if not _VALUE.search("".join(values)):
                    yield "".join(values)
