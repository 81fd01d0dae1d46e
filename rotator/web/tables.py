"""A timed table of directions that a browser or a program sends to be tracked (program track), as the console takes it.

Knows the request and its bounds. The table is taken whole or not at all, and an error names its line. Does not know
what is tracked meanwhile, nor the rotor: the box checks the table against both.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable

from aiohttp import web

from rotator.protocols.methods import WrongValuesError
from rotator.protocols.operating import Operating
from rotator.protocols.table_text import TableError, no_text, read_table
from rotator.store.paired import Paired
from rotator.web.entrance import RefusedError, bytes_of, paired
from rotator.web.route import Route, post
from rotator.web.schema import TABLE, in_address

MOST_BYTES = 1_000_000
LONGEST_NAME = 200
SHOWN_NAME = 40


def route(operating: Callable[[Paired], Operating], in_words: Callable[[str], str]) -> Route:
    """`operating`: a paired browser's commands. `in_words`: a refusal in words for the page."""

    async def track(request: web.Request) -> None:
        file = request.query.get("name", "")
        if not 0 < len(file) <= LONGEST_NAME or not file.isprintable():
            raise WrongValuesError("send the table as the body of /api/track-table?name=FILE")
        content = await bytes_of(request, MOST_BYTES)
        try:
            # In a thread of its own: a long table takes a second on a small computer.
            table = await asyncio.to_thread(read_table, content.decode("utf-8-sig"), _name(file), file, turns=True)
        except UnicodeDecodeError:
            raise WrongValuesError(no_text(file)) from None
        except TableError as mistake:
            raise WrongValuesError(str(mistake)) from None
        if refused := operating(paired(request)).program(table):
            raise RefusedError(in_words(refused))

    summary = "Track a timed table, t,az,el: t in seconds from now, or in UTC"
    name = {"name": in_address("of the file", "pass.csv")}
    return post("/api/track-table", track, summary, TABLE, most_body=MOST_BYTES, query=name)


def _name(file: str) -> str:
    """The table's name for displays: the file's name without its folder and its ending."""
    last = file.replace("\\", "/").rpartition("/")[2]
    stem = last.rpartition(".")[0] or last
    return "-".join(stem.split())[:SHOWN_NAME] or "table"
