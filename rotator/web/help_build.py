"""Builds the parts that help to find a fault, for the page: doctor, wires, diagnostics, backup.

Knows what each of them needs of the box, and which secrets the box holds. Does not know what the page shows.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import Any

from rotator.config.load import SIMULATED_FILE
from rotator.config.model import Config
from rotator.exchange.sources import PAGE, Source
from rotator.web.api import Group
from rotator.web.backup_api import BackupApi
from rotator.web.box_file import BoxFile
from rotator.web.diagnostics import Known, diagnostics, read_text
from rotator.web.help_api import DOCTOR_KEPT_S, HelpApi, doctor
from rotator.web.logs import LogLines
from rotator.web.pairing import Pairings
from rotator.web.redaction import Redaction, secrets_of, spellings_of_place
from rotator.web.wires import WireLog


def help_groups(
    config: Config,
    file: BoxFile,
    place: tuple[float, float] | None,
    *,
    pairings: Pairings,
    lines: LogLines,
    wires: WireLog,
) -> Sequence[Group]:
    """`place`: latitude and longitude of the station; None: not known."""
    secrets = secrets_of(config)
    hidden = secrets | (spellings_of_place(*place) if place else set())

    def pack(examined: dict[str, Any]) -> bytes:
        paired = pairings.all()
        # The file goes to a stranger: it has numbers in place of the names of people's browsers.
        names = {each.name: str(Source(PAGE, each.number)) for each in paired}
        known = Known(config, file.status(), examined, lines.kept(), wires.recording(), len(paired), time.time())
        return diagnostics(known, Redaction(hidden, names), read_text)

    checks = doctor(file.file or SIMULATED_FILE, Redaction(secrets), time.monotonic, time.time, kept_s=DOCTOR_KEPT_S)
    return (
        lambda entrance: HelpApi(entrance, checks, wires, pack).routes(),
        lambda entrance: BackupApi(entrance, file, config, time.time).routes(),
    )
