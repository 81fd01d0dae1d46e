"""The script as it is read: shellcheck has nothing to say, and everything it puts in place is there."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Callable
from pathlib import Path

PROJECT = Path(__file__).parent.parent.parent


def test_shellcheck(need_program: Callable[[str, str], str]) -> None:
    shellcheck = need_program("shellcheck", "shellcheck")
    done = subprocess.run(
        [shellcheck, "-x", "install.sh", "install/version.sh"], cwd=PROJECT, capture_output=True, text=True, check=False
    )
    assert done.stdout == ""


def test_every_option_is_explained() -> None:
    text = (PROJECT / "install.sh").read_text()
    explained = text[: text.index("\nEND\n")]
    options = re.findall(r"^        (--[a-z-]+)\)", text, re.MULTILINE)
    assert len(options) >= 8
    assert all(option in explained for option in options)
