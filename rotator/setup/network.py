"""Plans how rotctld is opened to the local network: the `[[link]]` in rotator.toml, and its announcement by Avahi.

Knows the lines of that link and the announcement. Works on texts and writes no file. What it replaces stays in the file
as a remark, so that the way back gives the same bytes.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from rotator.config.links import address
from rotator.config.load import parse
from rotator.config.statements import places, statements
from rotator.setup.plan import Change, ChangeSet, Files, SetupError, changes

BEGIN, END = "# rotator setup network: begin", "# rotator setup network: end"
_WAS = "# was: "
_OURS = re.compile(r'tcp = "0\.0\.0\.0:\d+"|allow = \["[^"]*"(?:, "[^"]*")?\]|\[\[link\]\]|protocol = "rotctld"|')
USUAL_PORT = 4533
ANNOUNCEMENT = Path("etc/avahi/services/rotator.service")
_SERVICE = """\
<?xml version="1.0" standalone="no"?>
<!DOCTYPE service-group SYSTEM "avahi-service.dtd">
<!-- Other machines find the rotator by name. Put in only where rotator.toml opens rotctld to the network. -->
<service-group>
  <name replace-wildcards="yes">Rotator on %h</name>
  <service>
    <type>_rotctld._tcp</type>
    <port>{port}</port>
  </service>
</service-group>
"""


@dataclass(frozen=True, slots=True)
class Opened:
    """A rotator.toml whose rotctld is open to the network."""

    text: str
    port: int


def plan(files: Files, root: Path, settings: Path, allow: str | None) -> tuple[ChangeSet, int]:
    """The changes, and the port. `allow`: the network that may; None: every machine. Raises SetupError, ConfigError."""
    before = _text(files, settings)
    opened = open_to(before, allow)
    parse(opened.text, str(settings))
    wanted = [Change(settings, files[settings], opened.text, copied=True)]
    notes = []
    if _has_avahi(root):
        place = root / ANNOUNCEMENT
        wanted.append(Change(place, files[place], _SERVICE.format(port=opened.port)))
    else:
        notes.append(
            "Avahi is not installed: the PC then needs the address, not the name. "
            "For the name: sudo apt install avahi-daemon, and this command again."
        )
    return ChangeSet(changes(*wanted), tuple(notes)), opened.port


def undone(files: Files, root: Path, settings: Path) -> ChangeSet:
    """The changes that take `plan` back. Raises SetupError, ConfigError."""
    place = root / ANNOUNCEMENT
    text = closed(_text(files, settings))
    parse(text, str(settings))
    return ChangeSet(changes(Change(settings, files[settings], text, copied=True), Change(place, files[place], None)))


def open_to(text: str, allow: str | None) -> Opened:
    """The text with its first rotctld link, or a new one, open to the network. Raises SetupError, ConfigError."""
    text = closed(text)
    links = parse(text, "rotator.toml").link
    number = next((at for at, link in enumerate(links) if link.protocol == "rotctld" and link.tcp), None)
    rows = text.split("\n")
    if number is None:
        rows += [] if rows[-1] == "" else [""]
        rows[-1:-1] = [BEGIN, "[[link]]", 'protocol = "rotctld"', *_ours(USUAL_PORT, allow), END]
        return Opened("\n".join(rows), USUAL_PORT)
    port = address(links[number].tcp or "")[1]
    lines = places(text)
    end = "\r" if rows[lines["link", number, "tcp"][0] - 1].endswith("\r") else ""
    was: list[str] = []
    taken: list[int] = []
    for key in ("tcp", "allow"):
        if given := lines.get(("link", number, key)):
            last = next(each.last for each in statements(text) if each.line == given[0])
            taken += range(given[0] - 1, last)
    for at in sorted(taken):
        was.append(_WAS + rows[at])
    block = [row + end for row in (BEGIN, *(row.removesuffix("\r") for row in was), *_ours(port, allow), END)]
    first = min(taken)
    kept = [row for at, row in enumerate(rows) if at not in taken]
    return Opened("\n".join([*kept[:first], *block, *kept[first:]]), port)


def closed(text: str) -> str:
    """The text as it was before. Raises SetupError where a person has changed what stands between the marks."""
    kept: list[str] = []
    inside = False
    for row in text.split("\n"):
        bare = row.rstrip("\r")
        match bare:
            case _ if bare == (END if inside else BEGIN):
                inside = not inside
            case _ if not inside:
                kept.append(row)
            case _ if bare.startswith(_WAS):
                kept.append(row.removeprefix(_WAS))
            case _ if not _OURS.fullmatch(bare):
                raise SetupError(f'"{bare}" between the marks of `rotator setup network` is yours: change it by hand')
    if inside:
        raise SetupError(f'the mark "{END}" is missing: put it behind the link, or take "{BEGIN}" out')
    return "\n".join(kept)


def allowed(network: str) -> str:
    """The key for one network. Programs on the box's own machine stay let in."""
    return f'allow = ["127.0.0.1", "{network}"]'


def _ours(port: int, allow: str | None) -> list[str]:
    return [f'tcp = "0.0.0.0:{port}"', *([allowed(allow)] if allow else [])]


def _has_avahi(root: Path) -> bool:
    return (root / ANNOUNCEMENT).parent.is_dir()


def _text(files: Files, path: Path) -> str:
    content = files.get(path)
    if not isinstance(content, str):
        raise SetupError(f"there is no {path}: say with --config which file the box runs with")
    return content
