"""Bodies at random, near what the API describes: never a fault of the box, and who is not paired changes nothing."""

from __future__ import annotations

import asyncio
import http.client
import json
from pathlib import Path
from urllib.parse import urlsplit

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from tests.search import examples
from tests.web.conftest import OFF, Box, Start
from tests.web.described import Described
from tests.web.test_described import description
from tests.web.test_sky import FOLLOWS

ALL = settings(max_examples=examples(600))


def ask(box: Box, path: str, body: bytes, token: str = "") -> tuple[int, str, bytes]:
    """Not from the box's own event loop: the search has a thread to itself."""
    connection = http.client.HTTPConnection(urlsplit(box.url).netloc)
    try:
        connection.request("POST", path, body, {"Authorization": f"Bearer {token}"} if token else {})
        answer = connection.getresponse()
        return answer.status, answer.headers.get_content_type(), answer.read()
    finally:
        connection.close()


def requests(told: Described, *left_out: str) -> st.SearchStrategy[tuple[str, bytes]]:
    return st.one_of(
        [
            st.tuples(st.just(path), told.sent(one))
            for path, one in told.routes("post")
            if path.removeprefix("/api/") not in left_out
        ]
    )


@pytest.mark.long
async def test_no_body_moves_or_changes_anything_for_one_who_is_not_paired(page_box: Start, file: Path) -> None:
    def search(box: Box, told: Described) -> None:
        routes = dict(told.routes("post"))

        # A stop is everybody's, and after it nothing would move for anyone.
        @ALL
        @given(requests(told, "stop"))
        def judged(sent: tuple[str, bytes]) -> None:
            path, body = sent
            status, kind, answer = ask(box, path, body)
            assert status in ((200, 403) if path == "/api/pair/begin" else (400, 401, 403)), answer
            told.judge(routes[path], status, kind, answer)
            assert not box.status.moving
            assert box.world.drives() == OFF

        judged()

    async with page_box(FOLLOWS, file=file) as box:
        told, before = await description(box), file.read_text()
        await asyncio.to_thread(search, box, told)
        assert box.status.wanted_azimuth_deg is None
        assert (box.status.controlled_by, box.status.held_by, box.status.latched) == ("", "", "")
        assert file.read_text() == before
        assert not box.anew.asked


async def test_any_body_of_one_who_is_paired_has_an_answer_that_is_described(page_box: Start, file: Path) -> None:
    def search(box: Box, told: Described, token: str, mine: int) -> None:
        routes = dict(told.routes("post"))
        headers = {"Authorization": f"Bearer {token}"}

        @ALL
        @given(requests(told), st.booleans())
        def judged(sent: tuple[str, bytes], current: bool) -> None:
            path, body = sent
            assume(not (path == "/api/revoke" and str(mine).encode() in body))
            if current and b'"digest"' in body and body.startswith(b"{"):
                connection = http.client.HTTPConnection(urlsplit(box.url).netloc)
                connection.request("GET", "/api/settings", headers=headers)
                digest = json.loads(connection.getresponse().read())["digest"]
                connection.close()
                body = json.dumps({**json.loads(body), "digest": digest}).encode()
            told.judge(routes[path], *ask(box, path, body, token))

        judged()

    async with page_box(FOLLOWS, file=file) as box:
        me = await box.pair()
        (token,) = [each.value for each in box.http.cookie_jar if each.key == "rotator"]
        await asyncio.to_thread(search, box, await description(box), token, me["number"])
        assert (await box.get("me"))[1]["paired"]
        assert (await box.post("stop"))[0] == 200
        await box.until(lambda: box.world.drives() == OFF)
