"""The folder in which the installed program lives: itself and every package that it needs, for one kind of machine.

Knows pip and the lock, the file with the exact version and the hash of each package. Knows nothing of Debian.

It is a virtual environment, but one for three Pythons at once: compiled parts carry their Python in their name
(`_ext.cpython-311-….so`), so those for 3.11, 3.12 and 3.13 lie side by side. A system that gets another Python goes on
with the same folder.
"""

from __future__ import annotations

import filecmp
import shutil
import sys
from pathlib import Path

from release.source import ReleaseError, Source, run

LOCK = Path(__file__).parent.parent / "install/lock"
"""A folder with a file for each set of packages."""
IN_THE_PACKAGE = ("base", "moteus", "paho")
MINORS = (11, 12, 13)
MACHINES = {"amd64": "x86_64", "arm64": "aarch64"}
"""Debian's name of an architecture, and the one in the names of wheels. 32-bit ARM has no ready-made gpiod."""
LIBC = range(17, 37)
"""The C libraries, 2.17 to 2.36, that a wheel may ask for: Debian 12 has 2.36."""
PACKAGES = Path("lib/python3/site-packages")
START = """\
#!/usr/bin/env -S --block-signal=INT {home}/bin/python
import signal

if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
    signal.signal(signal.SIGINT, signal.SIG_DFL)
signal.pthread_sigmask(signal.SIG_UNBLOCK, (signal.SIGINT,))

from rotator.__main__ import main

main()
"""
"""Ctrl-C while Python itself starts waits until it may end the program without a traceback."""


def make(folder: Path, *, home: str, wheel: Path, arch: str, source: Source, scratch: Path) -> None:
    """`home`: where `folder` will stand on the machine; it may be made anywhere."""
    packages = folder / PACKAGES
    packages.mkdir(parents=True)
    for minor in MINORS:
        fetched = scratch / f"3.{minor}"
        _fetch(fetched, arch, minor, source)
        _join(fetched, packages)
        (folder / f"lib/python3.{minor}").symlink_to("python3")
    run(*_pip(packages), "--no-deps", "--no-index", "--upgrade", wheel, epoch_s=source.epoch_s)
    # pip notes there in which folder the wheel lay on the builder's machine.
    for note in packages.glob("gs232_rotator-*.dist-info/direct_url.json"):
        note.unlink()
        record = note.with_name("RECORD")
        lines = record.read_text("utf-8").splitlines(keepends=True)
        record.write_text("".join(line for line in lines if note.name not in line), "utf-8")
    shutil.rmtree(packages / "bin")
    (folder / "bin").mkdir()
    (folder / "bin/python").symlink_to("/usr/bin/python3")
    (folder / "bin/rotator").write_text(START.format(home=home))
    (folder / "bin/rotator").chmod(0o755)
    (folder / "pyvenv.cfg").write_text("home = /usr/bin\ninclude-system-site-packages = false\n")


def _fetch(target: Path, arch: str, minor: int, source: Source) -> None:
    """What the lock names, for one Python. Only ready-made wheels, and only with the hash that the lock has."""
    machine = MACHINES[arch]
    platforms = [f"manylinux_2_{libc}_{machine}" for libc in reversed(LIBC)] + [f"manylinux2014_{machine}"]
    run(
        *_pip(target),
        *(word for platform in platforms for word in ("--platform", platform)),
        *("--implementation", "cp", "--python-version", f"3.{minor}"),
        *("--only-binary", ":all:", "--no-deps", "--require-hashes"),
        *(word for name in IN_THE_PACKAGE for word in ("--requirement", LOCK / f"{name}.txt")),
        epoch_s=source.epoch_s,
    )
    shutil.rmtree(target / "bin", ignore_errors=True)


def _pip(target: Path) -> tuple[str | Path, ...]:
    return (sys.executable, "-m", "pip", "install", "--quiet", "--no-compile", "--target", target)


def _join(one: Path, all_of_them: Path) -> None:
    """Put one Python's packages to the others'. A package's own account of itself may differ, nothing else."""
    for path in sorted(one.rglob("*")):
        name = path.relative_to(one)
        if path.is_dir():
            (all_of_them / name).mkdir(exist_ok=True)
        elif not (all_of_them / name).exists():
            shutil.copy2(path, all_of_them / name)
        elif not name.parts[0].endswith(".dist-info") and not filecmp.cmp(path, all_of_them / name, shallow=False):
            raise ReleaseError(f"{name} is not the same for every Python: it cannot serve all of them")
