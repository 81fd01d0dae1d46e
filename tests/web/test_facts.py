"""How a person at the box types this program, as the page tells it."""

from __future__ import annotations

from pathlib import Path

import pytest

from rotator.web.facts import command


@pytest.mark.parametrize(
    ("started", "found", "typed"),
    [
        (".venv/bin/rotator", "", ".venv/bin/rotator"),  # make run
        ("HERE/.venv/bin/rotator", "", ".venv/bin/rotator"),
        ("/opt/rotator/bin/rotator", "", "/opt/rotator/bin/rotator"),
        ("/opt/rotator/bin/rotator", "rotator", "rotator"),  # installed
        ("/usr/lib/python3/rotator/__main__.py", "", "rotator"),
    ],
)
def test_the_command(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, started: str, found: str, typed: str) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PATH", str(tmp_path))
    if found:
        (tmp_path / found).touch(mode=0o755)
    assert command(started.replace("HERE", str(tmp_path))) == typed
