"""A program from PyPI with just the packages that its driver imports: pinned, hash-checked, in a folder of their own.

Knows pip. Knows none of the programs, and installs nothing on this machine.
"""

from __future__ import annotations

import hashlib
import subprocess
import sys
from pathlib import Path

from tests.kept import keep, kept

DEADLINE_S = 300.0


def packages(requirements: Path, python: str) -> Path:
    """The folder with the packages of that file, for the interpreter `python`; kept for the next run.

    The file names each package's version and its hashes; pip refuses another archive. Raises
    subprocess.CalledProcessError where pip cannot bring them.
    """
    told = [python, "-c", "import sys; print('%d.%d' % sys.version_info[:2])"]
    version = subprocess.run(told, capture_output=True, text=True, check=True, timeout=30).stdout.strip()
    digest = hashlib.sha256(requirements.read_bytes()).hexdigest()[:12]

    def install(half: Path) -> None:
        words = ["--quiet", "--no-deps", "--require-hashes", "--only-binary=:all:", "--python-version", version]
        command = [sys.executable, "-m", "pip", "install", *words, "--target", str(half), "-r", str(requirements)]
        subprocess.run(command, check=True, timeout=DEADLINE_S)

    return keep(kept("clients") / f"{requirements.stem}-{digest}-python{version}", install)
