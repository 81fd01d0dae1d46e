"""The diagnostics file, without a secret wherever one can stand; and the doctor on the page, computed elsewhere."""

from __future__ import annotations

import asyncio
import io
import json
import sys
import tomllib
import zipfile
from collections.abc import Callable
from dataclasses import dataclass, field
from datetime import datetime
from pathlib import Path
from typing import Any
from urllib.parse import quote

import hypothesis.strategies as st
import pytest
from hypothesis import given

from rotator.config.load import parse
from rotator.exchange.sources import Source
from rotator.exchange.status import AxisStatus, Status
from rotator.monitor.transcript import Way, encode_piece
from rotator.web.diagnostics import Known, diagnostics
from rotator.web.help_api import doctor
from rotator.web.redaction import REMOVED, Redaction, secrets_of, spellings_of_place
from tests.tables import every_row
from tests.web.conftest import PATIENCE_S, Box

STATUS = Status(0.0, AxisStatus(0, 450, 0.0), AxisStatus(0, 180, 0.0))
SECRET = (
    st.text("abcdefghijkmnpqrstuvwxyzABCDEFGHJKLMN23456789-_.~!$*+=", max_size=40)
    .filter(lambda text: text.strip("-_.~!$*+=") == text)
    .map(lambda text: f"Zq7x{text}")  # so that no word of the file is one by chance
)


@dataclass
class Planting:
    """Where secrets can stand, before the file is made."""

    toml: str = '[rotor]\nhardware = "sim"\n'
    log: list[str] = field(default_factory=list)
    found: list[str] = field(default_factory=list)
    wires: list[str] = field(default_factory=list)
    state: str = '{"format": "rotator state 1"}'

    def packed(self) -> bytes:
        config = parse(self.toml, "a test's file")
        known = Known(
            config,
            STATUS,
            {"checks": [{"name": "x", "ok": False, "found": each, "advice": each} for each in self.found]},
            [(0.0, "warning", each) for each in self.log],
            self.wires,
            paired=2,
            utc_s=0.0,
        )
        read = {Path(config.state.path): self.state}.get
        return diagnostics(known, Redaction(secrets_of(config), {"Anna's phone": "page#1"}), read)


def comment(put: Planting, secret: str) -> None:
    put.toml += f"# my router's password: {secret}\n"


def key_of_a_server(put: Planting, secret: str) -> None:
    """Elements are fetched with a key; the log and the doctor tell of it in their own words."""
    number = len(put.log)
    put.toml = put.toml.replace(
        "[sky]\nfetch = [", f'[sky]\nfetch = ["https://s{number}.example/x?key={quote(secret)}", '
    )
    if "[sky]" not in put.toml:
        put.toml += f'[sky]\nfetch = ["https://s{number}.example/x?key={quote(secret)}"]\n'
    put.log += [f"s{number}.example: GET /x?key={quote(secret)}: 403", f"the key {secret} is refused"]
    put.found += [f"https://s{number}.example/x?key={quote(secret)}: 403"]


def step_of_an_address(put: Planting, secret: str) -> None:
    number = len(put.log)
    address = f"https://n{number}.example/{quote(secret * 2)}/tle"
    put.toml += f'[[link]]\nprotocol = "gs232b"\nserial = "socket://user:{quote(secret)}@n{number}.example:7000"\n'
    put.log += [f"{address}: 404", f"no answer from {address}", f"/{quote(secret * 2)}/tle: 404"][:2]


def password_of_a_port(put: Planting, secret: str) -> None:
    number = len(put.log)
    put.toml += f'[[link]]\nprotocol = "gs232b"\nserial = "rfc2217://anna:{quote(secret)}@h{number}.example:4000"\n'
    put.log += [f"link: cannot log in as anna with {secret}"]


def password_of_the_broker(put: Planting, secret: str) -> None:
    if "[mqtt]" in put.toml:
        return
    put.toml += f'[mqtt]\nbroker = "192.168.1.3:1883"\nuser = "box"\npassword = "{secret}"\n'
    put.log += [f"mqtt: box cannot log in with {secret}"]


def address_of_notices(put: Planting, secret: str) -> None:
    """A topic of ntfy is its own password, and may be short."""
    if "[notify]" in put.toml:
        return
    put.toml += f'[notify]\nurl = "https://ntfy.example/{secret}"\n'
    put.log += [f"notify: {secret} is refused", f"https://ntfy.example/{secret}"]


def header(put: Planting, secret: str) -> None:
    put.log += [f"Authorization: Bearer {secret}", f"sent Bearer {secret} twice", f"Cookie: a=1; rotator={secret}"]


def named(put: Planting, secret: str) -> None:
    put.log += [f"mqtt password={secret} refused", f'{{"token": "{secret}"}}', f"api_key: '{secret}'"]
    put.state = json.dumps({"format": "rotator state 1", "password": secret})


def wire(put: Planting, secret: str) -> None:
    data = f"GET http://anna:{quote(secret)}@host/ HTTP/1.1\r\nCookie: rotator={secret}\r\n".encode()
    put.wires += [encode_piece(datetime(2026, 11, 23), Source("gs232b", 1), Way.IN, data)]


PLACES = (
    *(comment, key_of_a_server, step_of_an_address, password_of_a_port, password_of_the_broker),
    *(address_of_notices, header, named, wire),
)


def members(packed: bytes) -> dict[str, str]:
    with zipfile.ZipFile(io.BytesIO(packed)) as file:
        return {name: file.read(name).decode() for name in file.namelist()}


@given(st.lists(st.tuples(st.sampled_from(PLACES), SECRET), min_size=1, max_size=6, unique_by=lambda each: each[1]))
def test_no_secret_is_in_it_wherever_it_stood(planted: list[tuple[Callable[[Planting, str], None], str]]) -> None:
    put = Planting()
    for place, secret in planted:
        place(put, secret)
    for name, text in members(put.packed()).items():
        for place, secret in planted:
            for spelt in (secret, quote(secret), quote(secret, safe="")):
                assert spelt not in text, f"{place.__name__}: {secret!r} is in {name}: {text}"


def test_the_place_is_coarse_and_browsers_have_no_names() -> None:
    put = Planting(
        '[rotor]\nhardware = "sim"\n[station]\nlatitude_deg = 52.51632\nlongitude_deg = -13.37777\n',
        log=["page: Anna's phone is paired"],
        wires=["12:00:00.000 pstrotator#1 < LLH:52.51632;-13.37777\\r"],
    )
    config = parse(put.toml, "a test's file")
    known = Known(config, STATUS, {}, [(0.0, "note", put.log[0])], put.wires, 1, 0.0)
    redaction = Redaction(spellings_of_place(52.51632, -13.37777), {"Anna's phone": "page#1"})
    texts = members(diagnostics(known, redaction, lambda _path: None))
    assert tomllib.loads(texts["rotator/configuration.toml"])["station"] == {"latitude_deg": 53, "longitude_deg": -13}
    assert "52.516" not in str(texts)
    assert "13.377" not in str(texts)
    assert texts["rotator/log.txt"].endswith("page: page#1 is paired\n")


@pytest.mark.long
async def test_a_paired_browser_downloads_it_whole(box: Box, tmp_path: Path) -> None:
    assert (await box.get("diagnostics"))[0] == 401
    await box.pair("Anna's phone")
    async with box.http.get(f"{box.url}/api/diagnostics") as answer:
        assert answer.status == 200
        assert answer.headers["Content-Disposition"] == 'attachment; filename="rotator-diagnostics.zip"'
        texts = members(await answer.read())
    assert {"README.txt", "about.json", "configuration.toml", "status.json", "doctor.json", "log.txt"} <= {
        name.removeprefix("rotator/") for name in texts
    }
    assert json.loads(texts["rotator/about.json"])["kernel"].startswith("Linux")
    assert json.loads(texts["rotator/status.json"])["simulated"] is True
    assert any(check["name"] == "python" for check in json.loads(texts["rotator/doctor.json"])["checks"])
    digest = json.loads((tmp_path / "paired.json").read_text())["paired"][0]["digest"]
    cookies = [each.value for each in box.http.cookie_jar]
    assert cookies
    for secret in (digest, *cookies, "Anna"):
        assert secret not in str(texts)


@every_row(
    ("text", "left"),
    [
        ("https://sky.example/gp.php?GROUP=amateur: 95 satellites", "https://sky.example/…: 95 satellites"),
        ("rfc2217://anna:s3cret@192.168.1.9:4000/x?log", "rfc2217://192.168.1.9:4000/…"),
        ("http://192.168.1.9:8232", "http://192.168.1.9:8232"),
        ("Authorization: Bearer abc.def-ghi", f"Authorization: {REMOVED}"),
        ("Cookie: rotator=abcdefgh; other=1", f"Cookie: {REMOVED}"),
        ("password = 'correct horse'", f"password = {REMOVED}"),
        ('{"api_key": "abc", "n": 1}', f'{{"api_key": {REMOVED}, "n": 1}}'),
        ("f" * 64, REMOVED),
        ("see " + "aB-_" * 10 + "xyz" + " there", f"see {REMOVED} there"),
        ("gs232b#1 > W235 025\\r", "gs232b#1 > W235 025\\r"),
        ("axis azimuth: 12 % of 450°, at 8f3a9c2", "axis azimuth: 12 % of 450°, at 8f3a9c2"),
    ],
)  # fmt: skip
def test_what_looks_like_a_secret_goes_and_the_rest_stays(text: str, left: str) -> None:
    assert Redaction().text(text) == left


async def examined(box: Box) -> dict[str, Any]:
    async with asyncio.timeout(PATIENCE_S):
        while (answer := await box.get("doctor"))[0] == 202:
            await asyncio.sleep(0.05)
    assert answer[0] == 200, answer
    return answer[1]


@pytest.mark.long
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
