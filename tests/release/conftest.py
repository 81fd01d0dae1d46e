"""The archives that the tests look at, and the Pythons that they are tried with. `make test-dist` runs them: minutes.

Knows where a machine may have a Python: on the path, or where pyenv keeps its own.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest

from release import archives
from release.source import Source

PROJECT = Path(__file__).parent.parent.parent


@dataclass(frozen=True, slots=True)
class Archives:
    source: Source
    """As it was then: a commit in the meantime has another moment."""
    sdist: Path
    wheel: Path


@pytest.fixture(scope="session")
def built(tmp_path_factory: pytest.TempPathFactory) -> Archives:
    source = Source.at(PROJECT)
    return Archives(source, *archives.build(source, tmp_path_factory.mktemp("dist")))


def python_of(minor: int) -> str:
    """A Python 3.MINOR of this machine. Skips where there is none: Debian 12 and 13 have one each, not all three."""
    pyenv = Path(os.environ.get("PYENV_ROOT") or Path.home() / ".pyenv") / "versions"
    # The system's first: an ordinary user can reach it, even where root runs the tests.
    places = ["/usr/bin/python3", shutil.which(f"python3.{minor}"), sys.executable]
    places += [str(path) for path in pyenv.glob(f"3.{minor}.*/bin/python3.{minor}")]
    for place in places:
        if place is not None and _minor(place) == minor:
            return place
    pytest.skip(f"there is no Python 3.{minor} here: sudo apt install python3.{minor}-venv, or pyenv install 3.{minor}")


def _minor(python: str) -> int | None:
    asked = [python, "-c", "import sys; print(sys.version_info.minor)"]
    try:
        said = subprocess.run(asked, capture_output=True, text=True, check=False)
    except OSError:
        return None
    return int(said.stdout) if said.returncode == 0 else None
