"""One box gives its elements, and another fetches them: both real, on one machine."""

from __future__ import annotations

import asyncio
import json
from collections.abc import AsyncIterator, Sequence
from contextlib import asynccontextmanager
from dataclasses import replace
from pathlib import Path

import pytest

from rotator.fetching.download import Answer, Question, ask
from rotator.links.elements import MOST_CLIENTS, ElementsServer
from rotator.links.listening import Allowed
from rotator.orbits import omm
from rotator.orbits.catalogue import Catalogue
from tests.orbits.skyfield_oracle import TLE


@asynccontextmanager
async def serving(files: Sequence[Path], allowed: Sequence[str] | None = None) -> AsyncIterator[int]:
    """The port of a box that has these files."""
    known = Catalogue([str(path) for path in files]).satellites
    looks = iter([None])
    """The first time its files are still being read."""
    server = ElementsServer("127.0.0.1", 0, lambda: next(looks, known), allowed=Allowed(allowed))
    task = asyncio.create_task(server.run())
    while server.where is None:
        await asyncio.sleep(0)
    yield server.where[1]
    task.cancel()
    await asyncio.gather(task, return_exceptions=True)


TODAY_S = 1_795_000_000.0
KNOWN = Catalogue([str(TLE)]).satellites


def fetched(folder: Path, files: Sequence[Path], path: str = "/elements", **known: object) -> Answer:
    async def both() -> Answer:
        async with serving(files) as port:
            question = Question(f"http://127.0.0.1:{port}{path}", folder / "fetched.txt", TODAY_S, **known)  # type: ignore[arg-type]
            return await asyncio.to_thread(ask, question)

    return asyncio.run(both())


def test_the_other_box_has_the_same_elements_and_then_only_asks_for_news(tmp_path: Path) -> None:
    answer = fetched(tmp_path, [TLE])
    assert (answer.trouble, answer.sets) == ("", 3)
    assert Catalogue([str(tmp_path / "fetched.txt")]).satellites == KNOWN
    again = fetched(tmp_path, [TLE], sets=3, etag=answer.etag)
    assert (again.status, again.sets) == (304, 3)


def test_of_several_files_the_other_box_has_every_satellite_with_its_newest_elements(tmp_path: Path) -> None:
    newer = replace(KNOWN[0], epoch_utc_s=KNOWN[0].epoch_utc_s + 3600.0, drag_per_earth_radius=1e-9)
    (tmp_path / "newer.json").write_text(json.dumps([omm.message(newer)]), encoding="utf-8")
    files = [TLE, tmp_path / "newer.json"]
    assert fetched(tmp_path, files).sets == 3
    there = Catalogue([str(tmp_path / "fetched.txt")])
    assert there.faults == ()
    assert there.satellites == Catalogue([str(path) for path in files]).satellites


@pytest.mark.parametrize("path", ["/elements/passwd", "/elements/..%2F..%2Fetc%2Fpasswd", "/", "/elements/"])
def test_nothing_else_can_be_fetched(tmp_path: Path, path: str) -> None:
    assert fetched(tmp_path, [TLE], path).status == 404


def test_new_elements_are_given_away_at_the_next_question(tmp_path: Path) -> None:
    async def thrice() -> list[Answer]:
        latest = [KNOWN]
        server = ElementsServer("127.0.0.1", 0, lambda: latest[-1], allowed=Allowed())
        task = asyncio.create_task(server.run())
        while server.where is None:
            await asyncio.sleep(0)
        question = Question(f"http://127.0.0.1:{server.where[1]}/elements", tmp_path / "fetched.txt", TODAY_S)
        answers = [await asyncio.to_thread(ask, question)]
        question = replace(question, sets=3, etag=answers[0].etag)
        answers.append(await asyncio.to_thread(ask, question))
        latest.append(KNOWN[:2])
        answers.append(await asyncio.to_thread(ask, question))
        task.cancel()
        await asyncio.gather(task, return_exceptions=True)
        return answers

    assert [(each.status, each.sets) for each in asyncio.run(thrice())] == [(200, 3), (304, 3), (200, 2)]


def test_a_file_that_holds_no_elements_is_not_given_away(tmp_path: Path) -> None:
    (tmp_path / "notes.txt").write_text("the door's code is 1234", encoding="utf-8")
    assert fetched(tmp_path, [tmp_path / "notes.txt"]).status == 503


def test_a_box_without_elements_yet_is_asked_again_soon(tmp_path: Path) -> None:
    assert fetched(tmp_path, []).status == 503


def test_a_machine_that_is_not_allowed_gets_nothing(tmp_path: Path) -> None:
    async def refused() -> Answer:
        async with serving([TLE], ["192.168.1.0/24"]) as port:
            return await asyncio.to_thread(ask, Question(f"http://127.0.0.1:{port}/elements", tmp_path / "x", TODAY_S))

    assert asyncio.run(refused()).status == 403


def test_a_crowd_of_idle_connections_is_turned_away() -> None:
    async def crowd() -> list[bool]:
        async with serving([TLE]) as port:
            connections = [await asyncio.open_connection("127.0.0.1", port) for _ in range(MOST_CLIENTS + 2)]
            ended = []
            for reader, _ in connections[MOST_CLIENTS:]:
                try:
                    ended.append(await reader.read() == b"")
                except ConnectionResetError:
                    ended.append(True)
            for _, writer in connections:
                writer.close()
            return ended

    assert asyncio.run(crowd()) == [True, True]


async def test_a_port_that_is_taken_leaves_the_box_running(caplog: pytest.LogCaptureFixture) -> None:
    async with serving([TLE]) as port:
        await ElementsServer("127.0.0.1", port, lambda: KNOWN, allowed=Allowed()).run()
    assert "[sky] serve: 127.0.0.1:" in caplog.text
