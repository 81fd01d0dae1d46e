"""Files of elements: where they are, whether one has changed, and the sets in it.

Knows files, folders, patterns and the forms of elements. No other file in `rotator.orbits` reads a disk. A wrong file
is reported; the elements read from it before stay.
"""

from __future__ import annotations

import codecs
import glob
import re
import stat
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from rotator.orbits import omm, tle
from rotator.orbits.elements import Elements, Notice, printable
from rotator.orbits.moments import DAY_S

SUFFIXES = (".tle", ".2le", ".3le", ".all", ".txt", ".json", ".csv", ".xml", ".kvn", ".omm")
"""The files that are read from a folder. A file named in full may have any name."""
MOST_BYTES = 64_000_000
"""The whole public catalogue as JSON has 20 MB."""
EPOCH_AHEAD_S = 10 * DAY_S
"""Seconds that an epoch may be ahead of its file: elements are written for today, or for some days ahead."""
_XML = re.compile(r"<(?:\w{1,20}:)?(?:omm|ndm|segment)[\s>]", re.IGNORECASE)
_PLAIN = str.maketrans({"\u00a0": " ", "\u2007": " ", "\u202f": " ", "\u2212": "-"})
"""Copied from a page, a blank may be one that does not break, and a minus a long one."""
Stamp = tuple[int, int]
"""Time and size of a file."""
Found = list[Elements | str]
"""The sets of a file; a sentence in place of each wrong set."""
Read = Callable[[Path], Found]
"""Raises OSError, ValueError; RuntimeError where it reads in another process, and that fails."""


def read_file(path: Path) -> Found:
    """Raises OSError, ValueError."""
    return list(parse(text_of(path.read_bytes())))


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
    wrong = tuple(f"{path}: {printable(str(each))}" for each in found if is_fault(each))
    notices = tuple(f"{path}: {printable(each)}" for each in found if isinstance(each, Notice))
    if not found:
        wrong = (f"{path}: holds no elements" + _stays(earlier),)
    if wrong:  # perhaps half written: keep the sets that it no longer has
        has = {(each.catalogue_number, each.name) for each in sets}
        sets += tuple(each for each in earlier if (each.catalogue_number, each.name) not in has)
    return FileContent(stamp, about.st_mtime, sets, wrong + notices)


def is_fault(found: Elements | str) -> bool:
    """Whether it is a sentence about a set that is not used."""
    return isinstance(found, str) and not isinstance(found, Notice)


def stamp_of(path: Path) -> Stamp | None:
    """Time and size of a file. None: not accessible."""
    try:
        about = path.stat()
    except OSError:
        return None
    return about.st_mtime_ns, about.st_size


def text_of(content: bytes) -> str:
    """The text of a file as any editor or shell has saved it: UTF-8, UTF-16 or Windows-1252, with any ends of lines.

    Raises ValueError for what is no text.
    """
    if content.startswith((b"\x1f\x8b", b"PK\3\4")):
        raise ValueError("it is compressed: unpack it first")
    if content.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        text = content.decode("utf-16")
    elif content[:2].count(0) == 1:
        text = content.decode("utf-16-le" if content[1] == 0 else "utf-16-be")
    else:
        try:
            text = content.decode("utf-8-sig")
        except UnicodeDecodeError:
            text = content.decode("cp1252")
    if "\0" in text:
        raise ValueError("no text")
    return text.replace("\r\n", "\n").replace("\r", "\n").translate(_PLAIN)


def parse(text: str) -> Iterable[Elements | str]:
    """Elements in any form; a sentence in place of each wrong set. Raises ValueError."""
    begin = text.lstrip()[:1]
    if begin in ("[", "{"):
        return omm.read_json(text)
    if begin == "<" and _XML.search(text):
        return omm.read_xml(text.lstrip())
    if tle.looks_like_tle(text):
        return tle.read(text)
    if begin == "<":
        raise ValueError("it is a web page (HTML), not the file behind its link")
    rows = [row for row in text.split("\n") if row.strip() and not row.startswith("#")]
    if not rows:
        return ()
    if any(row.partition("=")[0].strip().upper() in ("CCSDS_OMM_VERS", "NORAD_CAT_ID") for row in rows):
        return omm.read_kvn(text)
    if "," in rows[0]:
        return omm.read_csv(text)
    raise ValueError("neither TLE nor OMM (JSON, CSV, XML or KVN)")


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
