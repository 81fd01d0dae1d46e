"""The satellites that are known, by the names that people say, read from files of elements.

Knows files, folders and patterns, when a file has changed, and which of several sets is the newest. The only file of
this room that reads a disk. A file that is wrong is named; what was read from it before stays.
"""

from __future__ import annotations

import difflib
import glob
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from rotator.orbits import omm, tle
from rotator.orbits.elements import Elements

SUFFIXES = (".tle", ".txt", ".json", ".csv")
"""What is read from a folder; a file named in full may have any name."""
MOST_BYTES = 64_000_000
"""The whole public catalogue as JSON has 20 MB."""
_PARENTHESES = re.compile(r"\(([^)]*)\)")
_Stamp = tuple[int, int]


class Unknown(ValueError):  # noqa: N818 - a sentence about a name
    """No satellite, or more than one, has that name. The text tells which are near."""


@dataclass(frozen=True, slots=True)
class _Kept:
    """What was read from a file, and the file's size and time then."""

    stamp: _Stamp
    sets: tuple[Elements, ...]
    faults: tuple[str, ...]


class Catalogue:
    """`places`: files, folders, or patterns such as `/var/lib/elements/*.json`."""

    def __init__(self, places: Sequence[str]) -> None:
        self._places = tuple(places)
        self._kept: dict[Path, _Kept] = {}
        self._missing: tuple[str, ...] = ()
        self._sets: dict[int, Elements] = {}
        self._names: dict[str, set[int]] = {}
        self.refresh()

    @property
    def faults(self) -> tuple[str, ...]:
        """A sentence for each file that is missing, and for each set that could not be used."""
        return (*self._missing, *(fault for kept in self._kept.values() for fault in kept.faults))

    @property
    def satellites(self) -> tuple[Elements, ...]:
        """The newest set of each satellite, by name."""
        return tuple(sorted(self._sets.values(), key=lambda each: (each.name.casefold(), each.catalogue_number)))

    def refresh(self) -> bool:
        """Read what is new or has changed. Returns whether anything has."""
        paths, missing = _files(self._places)
        before = dict(self._kept), self._missing
        self._missing = tuple(missing)
        self._kept = {path: self._read(path) for path in paths}
        if (self._kept, self._missing) == before:
            return False
        self._sets = {}
        for kept in self._kept.values():
            for each in kept.sets:
                known = self._sets.get(each.catalogue_number)
                if known is None or known.epoch_utc_s < each.epoch_utc_s:
                    self._sets[each.catalogue_number] = each
        self._names = {}
        for number, each in self._sets.items():
            for name in _spoken(each):
                self._names.setdefault(name, set()).add(number)
        return True

    def find(self, name: str, others: Sequence[str] = ()) -> Elements:
        """By name, by the name in brackets, or by catalogue number; capitals, hyphens and blanks do not count.

        Raises Unknown, which tells the names that are near; `others`: names of targets that are no satellites.
        """
        numbers = self._names.get(plain(name), set())
        if len(numbers) == 1:
            return self._sets[next(iter(numbers))]
        if numbers:
            several = ", ".join(f"{self._sets[number].name} ({number})" for number in sorted(numbers)[:8])
            raise Unknown(f'"{name}" may be {several}: name one by its number')
        shown = {each: self._sets[min(found)].name for each, found in self._names.items()}
        shown |= {plain(each): each for each in others}
        near = difflib.get_close_matches(plain(name), shown, n=3, cutoff=0.6)
        meant = _perhaps(list(dict.fromkeys(shown[each] for each in near)))
        if not self._sets:
            raise Unknown(
                f'"{name}" is not known{meant or ";"} there are no satellites: [sky] elements names files of them'
            )
        raise Unknown(f'"{name}" is not among the {len(self._sets)} satellites known{meant}')

    def _read(self, path: Path) -> _Kept:
        before = self._kept.get(path)
        earlier = before.sets if before else ()
        try:
            about = path.stat()
            stamp = (about.st_mtime_ns, about.st_size)
            if before is not None and before.stamp == stamp:
                return before
            if about.st_size > MOST_BYTES:
                raise ValueError(f"{about.st_size} bytes are too many")
            found = list(parse(path.read_text(encoding="utf-8-sig")))
        except OSError as fault:
            return _Kept((0, 0), earlier, (f"{path}: cannot be read ({fault.strerror})",))
        except ValueError as fault:
            text = "no text" if isinstance(fault, UnicodeDecodeError) else str(fault)
            return _Kept(stamp, earlier, (f"{path}: {text}" + _stays(earlier),))
        sets = tuple(each for each in found if isinstance(each, Elements))
        wrong = tuple(f"{path}: {each}" for each in found if isinstance(each, str))
        if not found:
            wrong = (f"{path}: holds no elements" + _stays(earlier),)
        if (wrong or not sets) and earlier:  # perhaps it is only half written
            return _Kept(stamp, earlier, wrong)
        return _Kept(stamp, sets, wrong)


def parse(text: str) -> Iterable[Elements | str]:
    """Elements in any form; in place of a set that is wrong a sentence. Raises ValueError."""
    begin = text.lstrip()[:1]
    if begin in ("[", "{"):
        return omm.read_json(text)
    if tle.looks_like_tle(text):
        return tle.read(text)
    if not begin:
        return ()
    if "," in text.lstrip().splitlines()[0]:
        return omm.read_csv(text.lstrip())
    raise ValueError("neither TLE nor OMM (JSON or CSV)")


def _files(places: Sequence[str]) -> tuple[list[Path], list[str]]:
    """The files of these places, and a sentence for each place without one."""
    found: dict[Path, None] = {}
    missing = []
    for place in places:
        path = Path(place).expanduser()
        if path.is_dir():
            here = sorted(each for each in path.iterdir() if each.suffix.lower() in SUFFIXES and each.is_file())
        elif path.exists():
            here = [path]
        else:
            here = sorted(Path(each) for each in glob.glob(str(path)))
        found |= dict.fromkeys(here)
        if not here:
            missing.append(f"{place}: no such file" if not path.is_dir() else f"{place}: no file of elements in it")
    return list(found), missing


def _spoken(elements: Elements) -> set[str]:
    """`OSCAR 7 (AO-7)` is said whole, or as one of the two; `ISS (ZARYA)` too. And the number."""
    names = {elements.name, *_PARENTHESES.findall(elements.name), _PARENTHESES.sub("", elements.name)}
    return {plain(name) for name in names} - {""} | {str(elements.catalogue_number)}


def plain(name: str) -> str:
    """The name without capitals, hyphens and blanks: as names are compared."""
    return "".join(each for each in name.casefold() if each.isalnum())


def _perhaps(names: Sequence[str]) -> str:
    return f"; perhaps {' or '.join(names)}?" if names else ""


def _stays(earlier: tuple[Elements, ...]) -> str:
    return f"; the {len(earlier)} sets read from it before stay" if earlier else ""
