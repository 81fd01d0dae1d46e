"""Backup and restore over HTTP: only for paired browsers, and a look before anything is written."""

from __future__ import annotations

import io
import zipfile
from pathlib import Path

from rotator.backup.content import CONFIGURATION, MOST_BYTES
from rotator.backup.restore import WAITING
from tests.web.conftest import Box, Start


async def test_a_backup_is_saved_looked_at_and_waits_for_the_next_start(page_box: Start, tmp_path: Path) -> None:
    async with page_box(file=tmp_path / "station.toml") as box:
        path = tmp_path / "station.toml"
        text = path.read_text()
        for way, ask in (("GET", "backup"), ("POST", "restore"), ("POST", "restore/check")):
            async with box.http.request(way, f"{box.url}/api/{ask}") as answer:
                assert answer.status == 401
        await box.pair()
        async with box.http.get(f"{box.url}/api/backup") as answer:
            assert answer.headers["Content-Disposition"] == 'attachment; filename="rotator-backup.zip"'
            saved = await answer.read()
        with zipfile.ZipFile(io.BytesIO(saved)) as file:
            assert file.read(CONFIGURATION).decode() == text
        path.write_text(f"{text}\n# changed since\n", encoding="utf-8")
        async with box.http.post(f"{box.url}/api/restore/check", data=saved) as answer:
            shown = await answer.json()
        assert shown["rotor"] == "relay-pot, sim"
        assert "-# changed since" in shown["diff"]
        assert not path.with_name(f"station.toml{WAITING}").exists()
        async with box.http.post(f"{box.url}/api/restore", data=saved) as answer:
            assert (await answer.json())["ok"] is True
        await box.until(lambda: box.anew.asked)
        assert path.with_name(f"station.toml{WAITING}").read_bytes() == saved
        assert "# changed since" in path.read_text(), "until the box starts again"


async def test_what_is_no_backup_gets_a_sentence(page_box: Start, tmp_path: Path) -> None:
    async with page_box(file=tmp_path / "station.toml") as box:
        await box.pair()
        for ask in ("restore", "restore/check"):
            async with box.http.post(f"{box.url}/api/{ask}", data=b"a photo") as answer:
                assert answer.status == 422
                assert "no backup of a rotator" in (await answer.json())["error"]
            async with box.http.post(f"{box.url}/api/{ask}", data=bytes(MOST_BYTES + 1)) as answer:
                assert answer.status == 413
        assert list(tmp_path.glob(f"*{WAITING}")) == []


async def test_a_box_without_a_file_says_so(box: Box) -> None:
    await box.pair()
    status, told = await box.get("backup")
    assert status == 409
    assert "runs without a file" in told["error"]
