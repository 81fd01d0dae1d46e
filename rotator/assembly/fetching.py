"""What fetches elements, and what serves them to other boxes: from `[sky] fetch` and `serve` to running parts.

Knows the parts and what each is given. Asks no server itself.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from rotator.assembly.sky import fetched_folder
from rotator.config.links import address
from rotator.config.model import Config
from rotator.links.listening import PRIVATE, Allowed
from rotator.orbits.elements import Elements
from rotator.runtime.own_process import OwnProcess
from rotator.store import fetches
from rotator.store.fetches import FetchesFile

if TYPE_CHECKING:
    from rotator.fetching.fetcher import FetchThread
    from rotator.links.elements import ElementsServer

LONGEST_S = 180.0
"""Longer than any download: a server's name may take long to find."""


def build_fetching(config: Config, clock_is_known: Callable[[], bool], tell: Callable[[], None]) -> FetchThread | None:
    """Not started yet; None where the file names no address.

    `clock_is_known`: of a simulated rotor, too, for the servers are real. `tell` is called when a file is new.
    """
    if not config.sky.fetch:
        return None
    from rotator.fetching.download import Answer, Question, ask  # noqa: PLC0415 - slow to load, and seldom needed
    from rotator.fetching.fetcher import Fetcher, FetchThread  # noqa: PLC0415

    process = OwnProcess(LONGEST_S, once=True)

    def ask_apart(question: Question) -> Answer:
        return process.compute(ask, question)

    fetcher = Fetcher(config.sky.fetch, fetched_folder(config), fetches_file(config), ask_apart, clock_is_known)
    return FetchThread(fetcher, process, tell)


def fetches_file(config: Config, at: Callable[[Path], Path] = Path) -> FetchesFile:
    """`at`: where a path of the configuration is; for the doctor's view of another machine."""
    return FetchesFile(at(Path(config.state.path).with_name(fetches.FILE_NAME)))


def build_elements_server(config: Config, known: Callable[[], Sequence[Elements] | None]) -> ElementsServer | None:
    """None where the file names no `[sky] serve`. `known` gives the elements; None: no file has been read yet."""
    if config.sky.serve is None:
        return None
    from rotator.links.elements import ElementsServer  # noqa: PLC0415 - slow to load, and seldom needed

    host, port = address(config.sky.serve)
    allow = PRIVATE if config.sky.allow is None else config.sky.allow
    return ElementsServer(host, port, known, allowed=Allowed(allow))
