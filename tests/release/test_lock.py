"""The lock names every package that the program asks for, in a version that it accepts, and each file by its hash."""

from __future__ import annotations

import re
import tomllib

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from release.environment import LOCK
from release.lock import NOT_NEEDED
from tests.release.conftest import PROJECT

TEXT = "".join(path.read_text(encoding="utf-8") for path in sorted(LOCK.glob("*.txt")))
LINES = re.findall(r"^([\w.-]+)==([\w.]+)(.*(?:\n    .*)*)", TEXT, re.MULTILINE)
LOCKED = {canonicalize_name(name): version for name, version, _ in LINES}
TABLE = tomllib.loads((PROJECT / "pyproject.toml").read_text(encoding="utf-8"))["project"]


@pytest.mark.parametrize("asked", [*TABLE["dependencies"], *TABLE["optional-dependencies"]["moteus"]])
def test_what_the_program_asks_for_is_locked(asked: str) -> None:
    """After a change of the dependencies: `make lock`."""
    requirement = Requirement(asked)
    assert requirement.specifier.contains(LOCKED.get(canonicalize_name(requirement.name), "0"))


def test_each_has_the_hashes_of_its_files_and_no_address() -> None:
    assert len(LINES) > 15
    assert all(rest.count("--hash=sha256:") >= 1 for _, _, rest in LINES)
    assert "://" not in TEXT


def test_what_moteus_declares_for_other_tools_stays_out() -> None:
    assert not LOCKED.keys() & set(NOT_NEEDED)
