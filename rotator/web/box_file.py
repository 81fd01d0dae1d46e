"""Changes the configuration file of the running box from the page: a proposal, then the new start with it.

Knows the file, the values that a request must have, and that a new start stops the antenna. Does not know the changes
themselves, nor HTTP.
"""

from __future__ import annotations

import asyncio
import os
import secrets
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any

from typing_extensions import TypedDict

from hw.ports import Axis
from rotator.config.edit import NoChangeError
from rotator.config.load import SIMULATED_FILE, ConfigError, load, shipped
from rotator.config.proposal import OverwritesError, Proposal, Settings, propose, settings, write
from rotator.exchange.status import Status
from rotator.protocols.methods import WrongValuesError
from rotator.runtime.anew import Anew
from rotator.setup.plan import SetupError
from rotator.setup.tree import write_new
from rotator.web.entrance import RefusedError
from rotator.web.schema import Body, Ok, Sent, the

OWN = Path("rotator.toml")
"""The file that a box without one gets, in the folder where it was started."""
ANSWERED_S = 0.3
"""Seconds until the answer is sent. Then the box ends, and the page with it."""
MOVES = "the antenna moves, and the new start stops it: send stop = true"


class MayStop(Sent, total=False):
    stop: Annotated[bool, the("true: though the antenna moves, which stops")]


class Begun(Ok):
    run: Annotated[str, the("of the box that ends: after the start it is another one")]


class OneKey(TypedDict):
    place: Annotated[Sequence[str | int], the("a table and its key, or a whole table of a list")]
    before: Annotated[Any, the("null: it is not in the file")]
    after: Annotated[Any, the("null: it is not in the file")]


STOP = Body((MayStop, {"stop": True}))
"""Of a request that starts the box again."""


@dataclass(frozen=True, slots=True)
class BoxFile:
    """`file`: None if the box runs without one. Raises RefusedError if the box refuses the request."""

    file: Path | None
    anew: Anew
    status: Callable[[], Status]
    run: str = field(default_factory=lambda: secrets.token_hex(4))
    """New after each start: it shows a browser that the box has started again."""

    @property
    def path(self) -> Path:
        """Of a box without a file: where it gets one."""
        return self.file or OWN.absolute()

    @property
    def is_there(self) -> bool:
        """Also of a box that was started without it."""
        return self.file is not None or os.path.lexists(self.path)

    @property
    def begins(self) -> Path:
        """The file that a change starts from: where there is none, the shipped one with which the box runs."""
        return self.path if self.is_there else SIMULATED_FILE

    async def settings(self) -> Settings:
        with _refusing():
            return await asyncio.to_thread(settings, self.begins)

    async def make(self) -> Path:
        """The box has a file after its new start: its own, else the one that is there, else the shipped one."""
        with _refusing():
            if self.file is None:
                await asyncio.to_thread(lambda: load(self.path) if self.is_there else write_new(self.path, shipped()))
        self.anew.file = self.path
        return self.path

    async def propose(self, begun: str, make: Callable[[str], str]) -> Proposal:
        """`begun`: digest of the text that the change starts from. `make` returns the new text for it."""
        with _refusing():
            return await asyncio.to_thread(propose, self.begins, begun, make)

    async def write(self, proposal: Proposal) -> None:
        """A box without a file runs with this one after its new start."""
        with _refusing():
            if self.is_there:
                await asyncio.to_thread(write, self.path, proposal)
            else:
                await asyncio.to_thread(write_new, self.path, proposal.after)
        self.anew.file = self.path

    def may_stop(self, sent: MayStop) -> None:
        """Whether the person agrees that the antenna stops."""
        if self.status().moving and not sent.get("stop", False):
            raise RefusedError(MOVES)

    def begin_anew(self, sets_up: Axis | None = None) -> Begun:
        """Start the box again as soon as this answer is sent. `sets_up`: an axis to calibrate then."""
        asyncio.get_running_loop().call_later(ANSWERED_S, lambda: self.anew.ask(self.status(), sets_up))
        return {"ok": True, "run": self.run}


def key_changes(proposal: Proposal) -> list[OneKey]:
    return [{"place": each.place, "before": each.before, "after": each.after} for each in proposal.changes]


@contextmanager
def _refusing() -> Iterator[None]:
    """Turns an error of the file or of the change into a refusal."""
    try:
        yield
    except NoChangeError as reason:
        raise WrongValuesError(str(reason)) from None
    except (OverwritesError, ConfigError, SetupError) as reason:
        raise RefusedError(str(reason)) from None
    except OSError as fault:
        raise RefusedError(f"{fault.filename}: {fault.strerror}") from None
