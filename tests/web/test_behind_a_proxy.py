"""HTTPS as docs/https.md sets it up: the page's own nginx file, in Debian's nginx, with a certificate of one's own."""

from __future__ import annotations

import asyncio
import os
import re
import shutil
import ssl
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path

import aiohttp
import pytest

from tests.boxes import free_port
from tests.web.conftest import PATIENCE_S, Box

NGINX = shutil.which("nginx", path="/usr/sbin:/usr/bin")
PAGE = (Path(__file__).parents[2] / "docs" / "https.md").read_text(encoding="utf-8")


@pytest.fixture
def nginx(tmp_path: Path) -> Iterator[Callable[[str], int]]:
    """Starts it before this box, with the certificate of the page's commands. Gives its port."""
    if NGINX is None:
        reason = "nginx is missing: sudo apt install nginx-light"
        if os.environ.get("CI") == "true":
            pytest.fail(reason)
        pytest.skip(reason)
    running: list[subprocess.Popen[bytes]] = []

    def before(url: str) -> int:
        port = free_port()
        for line in re.findall(r"^ +pi\$ ((?:openssl|printf) .*)$", PAGE, re.MULTILINE):
            subprocess.run(line, shell=True, cwd=tmp_path, check=True, capture_output=True)
        found = re.search(r"```nginx\n(.*?)```", PAGE, re.DOTALL)
        assert found is not None
        site = found[1].replace("listen 443", f"listen 127.0.0.1:{port}").replace("http://127.0.0.1:8232", url)
        folders = "".join(f"{each}_temp_path {tmp_path}/{each};" for each in ("proxy", "fastcgi", "uwsgi", "scgi"))
        (tmp_path / "nginx.conf").write_text(
            f"daemon off; pid {tmp_path}/pid; events {{}} http {{ access_log off; {folders} "
            f"client_body_temp_path {tmp_path}/body; {site.replace('/etc/nginx', str(tmp_path))} }}",
            encoding="utf-8",
        )
        words = (NGINX or "", "-e", str(tmp_path / "error"), "-c", str(tmp_path / "nginx.conf"))
        running.append(subprocess.Popen(words))
        return port

    yield before
    for process in running:
        process.terminate()
        process.wait(PATIENCE_S)


async def test_pictures_and_a_stop_go_through_it_and_other_sites_stay_out(
    box: Box, nginx: Callable[[str], int], tmp_path: Path
) -> None:
    port = nginx(box.url)
    trusted = ssl.create_default_context(cafile=str(tmp_path / "antenna-ca.crt"))
    named = aiohttp.TCPConnector(ssl=trusted, resolver=Here())
    own = f"https://rotator.local:{port}"
    async with aiohttp.ClientSession(own, connector=named) as http:
        async with asyncio.timeout(PATIENCE_S):
            while True:
                try:
                    async with http.get("/api/me") as answer:
                        assert answer.status == 200
                    break
                except aiohttp.ClientConnectorError:
                    await asyncio.sleep(0.05)
        async with http.ws_connect("/api/live", origin=own) as socket:
            assert (await socket.receive_json())["hello"]["paired"] is False
            async with http.post("/api/stop", headers={"Origin": own}) as answer:
                assert answer.status == 200
            await box.until(lambda: bool(box.status.latched))
        async with http.post("/api/stop", headers={"Origin": "https://other.example"}) as answer:
            assert answer.status == 403


class Here(aiohttp.abc.AbstractResolver):
    """Every name is this machine's."""

    async def resolve(self, host: str, port: int = 0, family: int = 0) -> list[aiohttp.abc.ResolveResult]:
        found = {"hostname": host, "host": "127.0.0.1", "port": port, "family": 2, "proto": 0, "flags": 0}
        return [aiohttp.abc.ResolveResult(**found)]  # type: ignore[typeddict-item]

    async def close(self) -> None:
        """Nothing is open."""
