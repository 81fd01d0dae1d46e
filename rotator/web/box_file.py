"""The configuration file of the running box, as the page changes it: a proposal, then the new start with it.

Knows the file, what a request must name, and that a new start stops the antenna. Does not know what is changed, nor
HTTP.
"""

from __future__ import annotations

import asyncio
import secrets
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from hw.ports import Axis
from rotator.config.edit import NoChangeError
from rotator.config.load import ConfigError
from rotator.config.proposal import OverwritesError, Proposal, Settings, propose, settings, write
from rotator.protocols.methods import WrongValuesError
from rotator.runtime.anew import Anew
from rotator.setup.plan import SetupError
from rotator.status import Status
from rotator.web.entrance import RefusedError
from rotator.web.schema import TEXT, YES, object_of, the

ANSWERED_S = 0.3
"""The answer is out after this time: then the box ends, and the page with it."""
NO_FILE = (
    "the box runs without a file, so there is nothing to change: `rotator config --to rotator.toml` writes one, "
    "`rotator run --config rotator.toml` runs it"
)
MOVES = "the antenna moves, and the new start stops it: send stop = true"
STOP = {"stop": the("true: though the antenna moves, which stops", YES)}
"""A value of each request that has the box start anew."""
ANEW = object_of({"ok": {"const": True}, "run": the("of the box that ends: after the start it is another one", TEXT)})


@dataclass(frozen=True, slots=True)
class BoxFile:
    """`file`: None where the box runs without one. Raises RefusedError where the box does not do what is asked."""

    file: Path | None
    anew: Anew
    status: Callable[[], Status]
    run: str = field(default_factory=lambda: secrets.token_hex(4))
    """Another one after each start: so a browser knows that the box has started anew."""

    @property
    def path(self) -> Path:
        if self.file is None:
            raise RefusedError(NO_FILE)
        return self.file

    async def settings(self) -> Settings:
        with _refusing():
            return await asyncio.to_thread(settings, self.path)

    async def propose(self, begun: str, make: Callable[[str], str]) -> Proposal:
        """`begun`: the digest of the text that the change starts from. `make`: of that text the new one."""
        with _refusing():
            return await asyncio.to_thread(propose, self.path, begun, make)

    async def write(self, proposal: Proposal) -> None:
        with _refusing():
            await asyncio.to_thread(write, self.path, proposal)

    def may_stop(self, *, stops: bool) -> None:
        """`stops`: the person has been told that the antenna stops."""
        if self.status().moving and not stops:
            raise RefusedError(MOVES)

    def begin_anew(self, sets_up: Axis | None = None) -> dict[str, Any]:
        """The box starts anew as soon as this answer is out. `sets_up`: an axis that is calibrated then."""
        asyncio.get_running_loop().call_later(ANSWERED_S, lambda: self.anew.ask(self.status(), sets_up))
        return {"ok": True, "run": self.run}


def stop_of(others: Mapping[str, object]) -> bool:
    """The value `stop`, the only one beside those of the request itself. Raises WrongValuesError."""
    stop = others.get("stop", False)
    if set(others) - {"stop"} or not isinstance(stop, bool):
        raise WrongValuesError("stop must be true or false, and there is no other value here")
    return stop


@contextmanager
def _refusing() -> Iterator[None]:
    """What is wrong with the file, or with the change, as a refusal."""
    try:
        yield
    except NoChangeError as reason:
        raise WrongValuesError(str(reason)) from None
    except (OverwritesError, ConfigError, SetupError) as reason:
        raise RefusedError(str(reason)) from None
    except OSError as fault:
        raise RefusedError(f"{fault.filename}: {fault.strerror}") from None
