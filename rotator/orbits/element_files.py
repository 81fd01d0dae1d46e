"""Files of elements: where they are, whether one has changed, and the sets in it.

Knows files, folders, patterns and the forms of elements. No other file in `rotator.orbits` reads a disk. A wrong file
is reported; the elements read from it before stay.
"""

from __future__ import annotations

import glob
import stat
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from rotator.orbits import omm, tle
from rotator.orbits.elements import Elements, printable
from rotator.orbits.moments import DAY_S

SUFFIXES = (".tle", ".txt", ".json", ".csv")
"""The files that are read from a folder. A file named in full may have any name."""
MOST_BYTES = 64_000_000
"""The whole public catalogue as JSON has 20 MB."""
EPOCH_AHEAD_S = 10 * DAY_S
"""Seconds that an epoch may be ahead of its file: elements are written for today, or for some days ahead."""
Stamp = tuple[int, int]
"""Time and size of a file."""
Found = list[Elements | str]
"""The sets of a file; a sentence in place of each wrong set."""
Read = Callable[[Path], Found]
"""Raises OSError, ValueError; RuntimeError where it reads in another process, and that fails."""


def read_file(path: Path) -> Found:
    """Raises OSError, ValueError."""
    return list(parse(path.read_text(encoding="utf-8-sig")))


@dataclass(frozen=True, slots=True)
class FileContent:
    """The content of a file, the file's time and size at the last read, and its time when `sets` were read."""

    stamp: Stamp
    written_s: float
    sets: tuple[Elements, ...]
    faults: tuple[str, ...]


def read_again(path: Path, before: FileContent | None, read: Read = read_file) -> FileContent:
    """The content of a file now. `before`: at the last read; it stays where the file has not changed, or is wrong."""
    earlier, written_s = (before.sets, before.written_s) if before else ((), 0.0)
    try:
        about = path.stat()
        stamp = about.st_mtime_ns, about.st_size
        if before is not None and before.stamp == stamp:
            return before
        if not stat.S_ISREG(about.st_mode):
            raise ValueError("it is no file")  # a pipe would keep its reader waiting
        if about.st_size > MOST_BYTES:
            raise ValueError(f"{about.st_size} bytes are too many")
        found = read(path)
    except OSError as fault:
        return FileContent((0, 0), written_s, earlier, (f"{path}: cannot be read ({fault.strerror})",))
    except (ValueError, RuntimeError) as fault:
        if not isinstance(fault, (ValueError, RecursionError)):
            stamp = 0, 0  # not the file's fault: try again next time
        text = "no text" if isinstance(fault, UnicodeDecodeError) else str(fault)
        return FileContent(stamp, written_s, earlier, (f"{path}: {printable(text)}" + _stays(earlier),))
    sets = tuple(each for each in found if isinstance(each, Elements))
    wrong = tuple(f"{path}: {printable(each)}" for each in found if isinstance(each, str))
    if not found:
        wrong = (f"{path}: holds no elements" + _stays(earlier),)
    if wrong:  # perhaps half written: keep the sets that it no longer has
        has = {each.catalogue_number for each in sets}
        sets += tuple(each for each in earlier if each.catalogue_number not in has)
    return FileContent(stamp, about.st_mtime, sets, wrong)


def stamp_of(path: Path) -> Stamp | None:
    """Time and size of a file. None: not accessible."""
    try:
        about = path.stat()
    except OSError:
        return None
    return about.st_mtime_ns, about.st_size


def parse(text: str) -> Iterable[Elements | str]:
    """Elements in any form; a sentence in place of each wrong set. Raises ValueError."""
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


def files(places: Sequence[str], to_come: Sequence[Path] = ()) -> tuple[list[Path], list[str]]:
    """The existing files, and a sentence for each place without one."""
    found: dict[Path, None] = {}
    missing = []
    for place in places:
        path = Path(place).expanduser()
        try:
            is_folder = path.is_dir()
            if is_folder:
                here = _inside(path)
            elif path.exists():
                here = [path]
            else:
                here = sorted(Path(each) for each in glob.glob(str(path)))
        except OSError as fault:
            missing.append(f"{place}: cannot be read ({fault.strerror})")
            continue
        found |= dict.fromkeys(here)
        if not here:
            # Whole: a name alone does not say in which folder it was looked for.
            missing.append(f"{path.absolute()}: no {'file of elements in it' if is_folder else 'such file'}")
    for path in to_come:
        try:
            found |= dict.fromkeys(_inside(path) if path.is_dir() else [path] if path.exists() else [])
        except OSError as fault:
            missing.append(f"{path}: cannot be read ({fault.strerror})")
    return list(found), missing


def _inside(folder: Path) -> list[Path]:
    return sorted(each for each in folder.iterdir() if each.suffix.lower() in SUFFIXES and each.is_file())


def _stays(earlier: tuple[Elements, ...]) -> str:
    return f"; the {len(earlier)} sets read from it before stay in use" if earlier else ""
