"""The doctor on the page: what `rotator doctor --json` prints, computed elsewhere, and without secrets."""

from __future__ import annotations

import asyncio
import sys
from pathlib import Path
from typing import Any

from rotator.web.help_api import doctor
from rotator.web.redaction import Redaction
from tests.web.conftest import PATIENCE_S, Box


async def examined(box: Box) -> dict[str, Any]:
    async with asyncio.timeout(PATIENCE_S):
        while (answer := await box.get("doctor"))[0] == 202:
            await asyncio.sleep(0.05)
    assert answer[0] == 200, answer
    return answer[1]


async def test_everyone_who_may_look_reads_the_checks(box: Box) -> None:
    told = await examined(box)
    checks = {check["name"]: check for check in told["checks"]}
    assert checks["configuration"]["ok"] is True
    assert {"python", "running box", "state folder"} <= checks.keys()
    assert told["at_s"] > 0


def test_a_file_with_a_mistake_is_a_report_too(tmp_path: Path) -> None:
    """The box runs on with what it has read; the next start would fail."""
    file = tmp_path / "r.toml"
    file.write_text('[sky]\nfetch = ["ftp://anna:tops3cret@sky.example/x"]\n', encoding="utf-8")
    now_s = [0.0]

    async def main() -> dict[str, Any]:
        checks = doctor(file, Redaction(), lambda: now_s[0], lambda: 1.0, kept_s=10.0)
        checks._words = checks._words[3:]  # a busy machine would let the test wait
        assert checks._words[0] == sys.executable
        async with asyncio.timeout(PATIENCE_S):
            return await checks.newest()

    told = asyncio.run(main())
    first = told["checks"][0]
    assert first["ok"] is False
    assert "sky.example" in first["found"]
    assert "tops3cret" not in str(told)
