"""Parses config.txt, which the firmware of a Raspberry Pi reads before the kernel starts.

Knows sections, settings, device tree parameters and GPIO lines, as on the config.txt pages of Raspberry Pi's
documentation. Does not know which lines the box needs, and reads no file.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from rotator.setup.pi import MODEL_FILTERS, Pi
from rotator.setup.plan import lines

NO, YES = frozenset({"0", "off", "no", "false"}), frozenset({"1", "on", "yes", "true", ""})


@dataclass(frozen=True, slots=True)
class Setting:
    """A line `key=value`."""

    number: int
    """The number of the line, from 1."""
    key: str
    value: str
    filters: tuple[str, ...]
    """The sections that must all apply: at most one model, and other conditions."""

    def __str__(self) -> str:
        section = "".join(f"[{each}]" for each in self.filters)
        return f"line {self.number}, {self.key}={self.value}" + (f" under {section}" if section else "")

    def may_hold_on(self, pi: Pi | None) -> bool:
        """Whether the setting may apply on this Pi. A condition that only the firmware can judge counts as true."""
        models = [each for each in self.filters if each in MODEL_FILTERS]
        return "none" not in self.filters and (pi is None or all(each in pi.filters for each in models))

    @property
    def words(self) -> list[str]:
        """The words between the commas, without the blanks around them."""
        return [word.strip() for word in self.value.split(",")]


def settings(text: str) -> list[Setting]:
    found: list[Setting] = []
    filters: tuple[str, ...] = ()
    for number, line in enumerate(lines(text), 1):
        bare = line.strip()
        if section := re.fullmatch(r"\[(.*)\]", bare):
            filters = _narrowed(filters, section[1].strip().lower())
        elif bare and not bare.startswith("#"):
            key, _, value = bare.partition("=")
            found.append(Setting(number, key.strip().lower(), value.strip(), filters))
    return found


def _narrowed(filters: tuple[str, ...], section: str) -> tuple[str, ...]:
    """The filters after a section line: [all] ends all filters, a model replaces a model, others are added."""
    if section == "all":
        return ()
    if section in MODEL_FILTERS:
        filters = tuple(each for each in filters if each not in MODEL_FILTERS)
    return (*filters, section)


def parameters(found: list[Setting], *names: str) -> Iterator[tuple[Setting, bool]]:
    """Each `dtparam` line with one of these names, and whether it switches on."""
    for setting in found:
        if setting.key == "dtparam":
            for word in setting.words:
                name, _, value = word.partition("=")
                if name in names and value.lower() in NO | YES:
                    yield setting, value.lower() in YES


def overlays(found: list[Setting], name: str) -> Iterator[tuple[Setting, dict[str, str]]]:
    """Each time this overlay is loaded, with its parameters."""
    for setting in found:
        if setting.key == "dtoverlay" and setting.words[0] == name:
            yield setting, {key: value for key, _, value in (word.partition("=") for word in setting.words[1:])}


def pins(found: list[Setting]) -> Iterator[tuple[Setting, frozenset[int], frozenset[str]]]:
    """Each line `gpio=4,5-7=op,dl`: the setting, its pins and its words."""
    for setting in found:
        if setting.key == "gpio":
            numbers, _, words = setting.value.partition("=")
            yield setting, _numbers(numbers), frozenset(word.strip().lower() for word in words.split(","))


def _numbers(text: str) -> frozenset[int]:
    numbers: set[int] = set()
    for word in text.split(","):
        if span := re.fullmatch(r"\s*(\d{1,3})(?:\s*-\s*(\d{1,3}))?\s*", word):
            numbers.update(range(int(span[1]), int(span[2] or span[1]) + 1))
    return frozenset(numbers)
