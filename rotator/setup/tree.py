"""Finds and reads the files of a set-up, and writes its changes, all or none.

Knows where config.txt is, and works below `/` or below the folder of a mounted card. Does not know what the files mean.
"""

from __future__ import annotations

import errno
import os
from collections.abc import Iterable
from contextlib import suppress
from datetime import date
from pathlib import Path

from rotator.setup.pi import Pi, known
from rotator.setup.plan import Change, ChangeSet, Content, Link, SetupError
from rotator.store.whole import NEW, write_whole

OVERLAYS = ("overlayroot=tmpfs", "boot=overlay")


def boot_config(root: Path) -> Path:
    """The path of config.txt: that since Bookworm, or the older one; of a card in another computer also that of the
    boot partition beside it, as desktops mount both. Raises SetupError."""
    places = [root / "boot/firmware/config.txt", root / "boot/config.txt"]
    if is_card(root):
        places.append(root.resolve().parent / "bootfs/config.txt")
    for place in places:
        if place.is_file():
            return place
    if (root / "config.txt").is_file():
        raise SetupError(f"{root} is the card's boot partition: give --root its other partition, often called rootfs")
    if is_card(root) and (root / "etc").is_dir():
        raise SetupError(
            f"there is no {places[0]}: mount the card's first partition there too, "
            f"such as with `sudo mount /dev/sdX1 {root / 'boot/firmware'}`, and run this again"
        )
    raise SetupError(f"there is no {places[0]} and no {places[1]}: is this a Raspberry Pi's SD card?")


def is_card(root: Path) -> bool:
    """Whether `root` is the card of a Pi that is not running from it."""
    return root.resolve() != Path("/")


def pi(root: Path) -> Pi | None:
    with suppress(OSError):
        return known((root / "proc/device-tree/model").read_text(encoding="utf-8", errors="replace"))
    return None


def read(*paths: Path) -> dict[Path, Content]:
    """The content at each path. Raises SetupError."""
    return {path: _content(path) for path in paths}


def matching(root: Path, patterns: Iterable[str]) -> list[Path]:
    """The files below root that match one of the patterns."""
    return [path for pattern in patterns for path in sorted(root.glob(pattern)) if path.is_file()]


def _content(path: Path) -> Content:
    try:
        # The user's file may be a link to it; below system/ a link is how a unit is switched on.
        if path.is_symlink() and path.parent.name.endswith(".wants"):
            return Link(os.readlink(path))
        return path.read_bytes().decode("utf-8", "surrogateescape")
    except (FileNotFoundError, NotADirectoryError):
        return None
    except OSError as fault:
        raise SetupError(_sentence(path, fault)) from fault


def write_new(path: Path, text: str) -> None:
    """Write a file where there is none, nor a link: whole, or not at all. Raises SetupError."""
    begun = False
    try:
        with path.open("x", encoding="utf-8") as file:
            begun = True
            file.write(text)
    except FileExistsError:
        raise SetupError(f"{path} is there already: give another name") from None
    except OSError as fault:
        if begun:
            path.unlink(missing_ok=True)
        raise SetupError(f"{path} cannot be written: {fault.strerror}") from fault


def hindrance(plan: ChangeSet) -> str | None:
    """The reason why the changes cannot be made, before any is tried; None: they can."""
    for change in plan.changes:
        folder = next(each for each in change.path.resolve().parents if each.exists())
        if not folder.is_dir():
            return f"{folder} is a file, not a folder"
        if os.statvfs(folder).f_flag & os.ST_RDONLY:
            return _read_only(folder)
        if not os.access(folder, os.W_OK, effective_ids=True):
            return f"{folder} may only be written by root: put sudo before the command"
    return None


def carry_out(plan: ChangeSet, today: date) -> list[Path]:
    """Make every change. Returns the copies of the old files. Raises SetupError, and then nothing is changed."""
    done: list[Change] = []
    copies: list[Path] = []
    for change in plan.changes:
        try:
            if change.copied and isinstance(change.before, str):
                copies.append(_free_name(change.path, today))
                write_whole(copies[-1], _bytes(change.before), like=change.path)
            done.append(change)
            _put(change.path, change.after)
        except OSError as fault:
            _take_back(done, copies)
            raise SetupError(f"{_sentence(change.path, fault)}; everything is as it was") from fault
    return copies


def _put(path: Path, content: Content) -> None:
    match content:
        case None:
            path.unlink(missing_ok=True)
            if path.parent.name.endswith(".service.d"):
                with suppress(OSError):
                    path.parent.rmdir()
        case Link(target):
            path.parent.mkdir(parents=True, exist_ok=True)
            path.unlink(missing_ok=True)
            path.symlink_to(target)
        case text:
            path.parent.mkdir(parents=True, exist_ok=True)
            # The box's own file may come to hold a password.
            write_whole(path, _bytes(text), mode=0o640 if path.suffix == ".toml" else 0o644)


def _take_back(done: list[Change], copies: list[Path]) -> None:
    for change in reversed(done):
        with suppress(OSError):
            if _content(change.path) != change.before:
                _put(change.path, change.before)
    for path in (*copies, *(change.path for change in done)):
        with suppress(OSError):
            path.with_name(path.name + NEW).unlink(missing_ok=True)
    for copy in copies:
        with suppress(OSError):
            copy.unlink(missing_ok=True)


def _free_name(path: Path, today: date) -> Path:
    """`config.txt.before-rotator-2026-11-21`; the second one of a day ends in -2."""
    first = f"{path.name}.before-rotator-{today.isoformat()}"
    names = (first, *(f"{first}-{number}" for number in range(2, 1000)))
    return next(free for name in names if not (free := path.with_name(name)).exists())


def _bytes(text: str) -> bytes:
    return text.encode("utf-8", "surrogateescape")


def _sentence(path: Path, fault: OSError) -> str:
    match fault:
        case PermissionError():
            return f"{path}: no permission: put sudo before the command"
        case OSError(errno=errno.EROFS):
            return _read_only(path)
        case _:
            return f"{path}: {fault.strerror or fault}"


def _read_only(path: Path) -> str:
    return (
        f"{path} is read-only: switch the overlay file system off in raspi-config, "
        "or mount it with `sudo mount -o remount,rw`, then run this again"
    )
