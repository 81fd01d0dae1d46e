"""The routes of the backup: the download, the check of a backup before it is restored, and the restoring.

Knows HTTP. The content of a backup, and how the next start puts it in place, is in `rotator.backup`.
"""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Annotated, Any

from aiohttp import web
from typing_extensions import TypedDict

from rotator.backup.content import CHECKS, CONFIGURATION, MOST_BYTES, Backup, BackupError, check, pack
from rotator.backup.restore import stage
from rotator.config import toml_text
from rotator.config.mistake import ConfigError
from rotator.config.model import Config
from rotator.config.proposal import Proposal
from rotator.protocols.methods import WrongValuesError
from rotator.web.box_file import Begun, BoxFile, OneKey, key_changes
from rotator.web.entrance import RefusedError, bytes_of, download, paired
from rotator.web.route import PAIRED, Route, get, post, refusals
from rotator.web.schema import ZIP, in_address, the

log = logging.getLogger(__name__)

MOST_ROWS = 400
"""Lines of the difference that the page shows."""


class _Look(TypedDict):
    made: Annotated[str, the("the day and time")]
    program: Annotated[str, the("the version that made it")]
    rotor: str
    files: list[str]
    changes: Annotated[list[OneKey], the("the keys of the configuration whose values change")]
    diff: Annotated[list[str], the("the lines of the configuration that change")]


class BackupApi:
    """`config`: the running configuration. `utc` gives seconds since 1970."""

    def __init__(self, file: BoxFile, config: Config, utc: Callable[[], float]) -> None:
        self._file = file
        self._config = config
        self._utc = utc

    def routes(self) -> Sequence[Route]:
        save, look = ("A zip with the configuration and what the box has learnt", ZIP), "What a backup would change"
        restore, stop = (
            "Restore a backup: the box starts anew with it",
            {"stop": in_address("`true`: though the antenna moves, which stops", "true")},
        )
        takes: dict[str, Any] = {"most_body": MOST_BYTES, "more": refusals(422)}
        return (
            get("/api/backup", self._save, save, access=PAIRED, more=refusals(409)),
            post("/api/restore/check", self._look, look, ZIP, answer=_Look, **takes),
            post("/api/restore", self._restore, restore, ZIP, answer=Begun, query=stop, **takes),
        )

    async def _save(self, _request: web.Request) -> web.StreamResponse:
        path = self._file.path
        if self._file.file is None:
            raise RefusedError("the box runs without a file, so there is nothing to keep yet: Setup makes one")
        try:
            packed = await asyncio.to_thread(pack, path, self._config, self._utc())
        except OSError as fault:
            raise RefusedError(f"{path} cannot be read: {fault.strerror or fault}") from None
        return download(packed, "rotator-backup.zip")

    async def _look(self, request: web.Request) -> _Look:
        path, data = self._file.path, await bytes_of(request, MOST_BYTES)
        try:
            return await asyncio.to_thread(_shown, path, data)
        except BackupError as reason:
            raise RefusedError(str(reason), 422) from None

    async def _restore(self, request: web.Request) -> Begun:
        who = paired(request)
        path, data = self._file.path, await bytes_of(request, MOST_BYTES)
        stop = request.query.get("stop", "false")
        if stop not in ("true", "false"):
            raise WrongValuesError("?stop= must be true or false")
        self._file.may_stop({"stop": stop == "true"})
        try:
            await asyncio.to_thread(check, data)
            await self._file.make()
            await asyncio.to_thread(stage, path, data)
        except BackupError as reason:
            raise RefusedError(str(reason), 422) from None
        except OSError as fault:
            raise RefusedError(f"{path.parent} cannot be written to: {fault.strerror or fault}") from None
        log.warning("page: %s restores a backup: the box starts anew with it", who.name)
        return self._file.begin_anew()


def _shown(path: Path, data: bytes) -> _Look:
    """The facts about a backup that a person checks before it is restored. Raises BackupError."""
    backup: Backup = check(data)
    try:
        now = toml_text.read(path)
    except (OSError, ConfigError):
        now = ""
    proposal = Proposal(now, backup.text, ())
    return {
        "made": backup.made,
        "program": backup.program,
        "rotor": f"{backup.config.rotor.type}, {backup.config.rotor.hardware}",
        "files": [CONFIGURATION, *(name for name in CHECKS if name in backup.parts)],
        "changes": key_changes(proposal),
        "diff": proposal.diff[:MOST_ROWS],
    }
