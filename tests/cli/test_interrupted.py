"""Ctrl-C while a command still loads ends it without a traceback."""

from __future__ import annotations

import subprocess
import sys
from itertools import product
from pathlib import Path

import pytest

from tests.search import some

PRESSES = """
import sys

class CtrlC:
    def find_spec(self, name, path=None, target=None):
        if name == {module!r}:
            raise KeyboardInterrupt

sys.meta_path.insert(0, CtrlC())
sys.argv = ["rotator", {command!r}]
from rotator.__main__ import main
main()
"""
"""A Ctrl-C that comes at the import of one module: the same moment each time."""


@pytest.mark.search
@pytest.mark.parametrize(
    ("module", "command"),
    some(list(product(["click", "pydantic", "rotator.config.load"], ["run", "where", "stop", "doctor", "calibrate"]))),
)
def test_no_traceback(command: str, module: str, tmp_path: Path) -> None:
    script = PRESSES.format(module=module, command=command)
    ended = subprocess.run(
        [sys.executable, "-c", script], cwd=tmp_path, capture_output=True, text=True, timeout=120, check=False
    )
    assert "Traceback" not in ended.stderr
    assert ended.returncode != 0
