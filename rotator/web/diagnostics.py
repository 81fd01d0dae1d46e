"""The diagnostics file: the facts that another person needs to find a fault, in one zip, without secrets.

Knows the content of the zip, and which facts of the computer belong in it. Each text passes through `redaction`. It
changes nothing.
"""

from __future__ import annotations

import io
import json
import os
import platform
import shutil
import zipfile
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from pydantic import BaseModel

from rotator import __version__
from rotator.config.model import Config
from rotator.exchange.status import Status
from rotator.protocols.status_object import as_object
from rotator.store.counts import FILE_NAME as COUNTS
from rotator.web.redaction import REMOVED, Redaction, is_secret

PACKAGES = ("aiohttp", "pydantic", "gpiod", "smbus2", "pyserial", "sgp4", "moteus", "spidev", "paho-mqtt")
LARGEST_STATE = 100_000
MACHINE_FILES = {
    "system": "/etc/os-release",
    "board": "/sys/firmware/devicetree/base/model",
    "load": "/proc/loadavg",
    "memory": "/proc/meminfo",
    "up_s": "/proc/uptime",
}
SYSTEM_LINES = ("PRETTY_NAME",)
MEMORY_LINES = ("MemTotal", "MemAvailable", "SwapFree")
README = """\
What a rotator box knows of itself, for a person who looks for a fault.

about.json          the program, the computer and its system
configuration.toml  the keys that the configuration file sets, without its comments
status.json         the antenna, its axes, their faults
doctor.json         the checks of `rotator doctor`
log.txt             the latest lines of the log
wires.txt           the latest bytes of the links, as `rotator monitor` writes them
state/              what the box remembers: counts, relays, learnt motors

Taken out: passwords, tokens and their hashes, what stands in addresses behind the host, comments, the names of paired
browsers. The place of the station is rounded to whole degrees, or to four characters of the locator. Addresses of
machines in your network, and the names of your links, files and satellites are in it: look through it before you put it
where strangers read.
"""


@dataclass(frozen=True, slots=True)
class Known:
    """The present knowledge of the box. `log`: its lines as (seconds since 1970, rank, text), the oldest first."""

    config: Config
    status: Status
    doctor: Mapping[str, Any]
    log: Sequence[tuple[float, str, str]]
    wires: Iterable[str]
    paired: int
    """The number of paired browsers and programs."""
    utc_s: float


def diagnostics(known: Known, redaction: Redaction, read: Callable[[Path], str | None]) -> bytes:
    """The zip. `read`: the text of a file; None where it cannot be read."""
    import tomlkit  # noqa: PLC0415 - a start can do without it

    state = Path(known.config.state.path)
    texts = {
        "README.txt": README,
        "about.json": _json(_about(known, read)),
        "configuration.toml": tomlkit.dumps(redaction.value(_settings(known.config))),
        "status.json": _json(redaction.value(as_object(known.status))),
        "doctor.json": _json(redaction.value(known.doctor)),
        "log.txt": "".join(redaction.text(f"{_moment(at_s)} {rank:7} {text}") + "\n" for at_s, rank, text in known.log),
        "wires.txt": "".join(redaction.text(line) + "\n" for line in known.wires),
    }
    for path in (state, state.with_name(COUNTS)):
        if (text := read(path)) is not None:
            texts[f"state/{path.name}"] = redaction.text(text)
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as file:
        for name, text in texts.items():
            file.writestr(zipfile.ZipInfo(f"rotator/{name}", _stamp(known.utc_s)), text, zipfile.ZIP_DEFLATED)
    return packed.getvalue()


def read_text(path: Path) -> str | None:
    """The text of a file; None: no file, or too large."""
    try:
        if not path.is_file():
            return None
        with path.open("rb") as file:
            return file.read(LARGEST_STATE).decode("utf-8", "replace").strip("\0\n")
    except OSError:
        return None


def _settings(config: Config) -> dict[str, Any]:
    settings = config.model_dump(mode="json", exclude_unset=True, exclude_none=True)
    for table, keys in settings.items():
        inner = getattr(config, table)
        for name in keys if isinstance(inner, BaseModel) else ():
            if is_secret(type(inner).model_fields[name]):
                keys[name] = REMOVED
    station = settings.get("station", {})
    for key in ("latitude_deg", "longitude_deg"):
        if key in station:
            station[key] = round(station[key])
    if "locator" in station:
        station["locator"] = station["locator"][:4]
    return settings


def _about(known: Known, read: Callable[[Path], str | None]) -> dict[str, Any]:
    machine = {name: read(Path(path)) or "" for name, path in MACHINE_FILES.items()}
    return {
        "rotator": __version__,
        "made": _moment(known.utc_s),
        "python": platform.python_version(),
        "kernel": " ".join(os.uname()[index] for index in (0, 2, 3, 4)),
        "system": _lines(machine["system"], SYSTEM_LINES),
        "board": machine["board"] or "no Raspberry Pi",
        "load": machine["load"],
        "memory": _lines(machine["memory"], MEMORY_LINES),
        "up_s": machine["up_s"].partition(" ")[0],
        "free_bytes": _free(Path(known.config.state.path).absolute().parent),
        "packages": {name: found for name in PACKAGES if (found := _version(name))},
        "paired": known.paired,
    }


def _lines(text: str, wanted: Sequence[str]) -> list[str]:
    return [" ".join(line.split()) for line in text.splitlines() if line.startswith(tuple(wanted))]


def _free(folder: Path) -> int | None:
    try:
        return shutil.disk_usage(folder).free
    except OSError:
        return None


def _version(name: str) -> str | None:
    try:
        return version(name)
    except PackageNotFoundError:
        return None


def _json(value: object) -> str:
    return json.dumps(value, indent=1, ensure_ascii=False) + "\n"


def _moment(utc_s: float) -> str:
    return datetime.fromtimestamp(utc_s, UTC).strftime("%Y-%m-%dT%H:%M:%SZ")


def _stamp(utc_s: float) -> tuple[int, int, int, int, int, int]:
    """The time of an entry, 1980 at the earliest: a zip has no year before, and a Pi without a network may be there."""
    moment = datetime.fromtimestamp(utc_s, UTC)
    return (max(1980, moment.year), moment.month, moment.day, moment.hour, moment.minute, moment.second)
