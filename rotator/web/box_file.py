"""Changes the configuration file of the running box from the page: a proposal, then the new start with it.

Knows the file, the values that a request must have, and that a new start stops the antenna. Does not know the changes
themselves, nor HTTP.
"""

from __future__ import annotations

import asyncio
import os
import secrets
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated

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
NO_FILE = (
    "the box runs without a file, so there is nothing to change: make one on the page, in Setup; or "
    "`rotator config --to rotator.toml` writes one, `rotator run --config rotator.toml` runs it"
)
MOVES = "the antenna moves, and the new start stops it: send stop = true"


class MayStop(Sent, total=False):
    stop: Annotated[bool, the("true: though the antenna moves, which stops")]


class Begun(Ok):
    run: Annotated[str, the("of the box that ends: after the start it is another one")]


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
        if self.file is None:
            raise RefusedError(NO_FILE)
        return self.file

    async def settings(self) -> Settings:
        """Of a box without a file: those of the shipped one, with which it runs."""
        with _refusing():
            return await asyncio.to_thread(settings, self.file or SIMULATED_FILE)

    async def make(self) -> Path:
        """The box is to have a file after its new start: the one that is there already, else the shipped one."""
        if self.file is not None:
            raise RefusedError(f"the box has a file: {self.file}")
        with _refusing():
            await asyncio.to_thread(lambda: load(OWN) if os.path.lexists(OWN) else write_new(OWN, shipped()))
        self.anew.file = OWN.absolute()
        return self.anew.file

    async def propose(self, begun: str, make: Callable[[str], str]) -> Proposal:
        """`begun`: digest of the text that the change starts from. `make` returns the new text for it."""
        with _refusing():
            return await asyncio.to_thread(propose, self.path, begun, make)

    async def write(self, proposal: Proposal) -> None:
        with _refusing():
            await asyncio.to_thread(write, self.path, proposal)

    def may_stop(self, sent: MayStop) -> None:
        """Whether the person agrees that the antenna stops."""
        if self.status().moving and not sent.get("stop", False):
            raise RefusedError(MOVES)

    def begin_anew(self, sets_up: Axis | None = None) -> Begun:
        """Start the box again as soon as this answer is sent. `sets_up`: an axis to calibrate then."""
        asyncio.get_running_loop().call_later(ANSWERED_S, lambda: self.anew.ask(self.status(), sets_up))
        return {"ok": True, "run": self.run}


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
