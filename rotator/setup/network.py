"""Plans how rotctld and the page are opened to the local network: the `[[link]]` and `[page]` in rotator.toml, and the
announcement by Avahi.

Knows these lines and the announcement. Works on texts and writes no file. What it replaces stays in the file
as a remark, so that the way back gives the same bytes.
"""

from __future__ import annotations

import ipaddress
import re
from collections.abc import Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from rotator.config.links import address, is_this_machine
from rotator.config.load import parse
from rotator.config.mistake import ConfigError
from rotator.config.statements import Place, statements
from rotator.setup.blocks import Block
from rotator.setup.plan import ChangeSet, Content, Files, SetupError, planned

BLOCK = Block(
    "rotator setup network",
    re.compile(
        r'(?:tcp|listen) = "0\.0\.0\.0:\d+"|allow = \["[^"]*"(?:, "[^"]*")?\]|\[\[link\]\]|\[page\]|'
        r'protocol = "rotctld"|'
    ),
    was="# was: ",
)
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
    """A rotator.toml whose rotctld and page are open to the network."""

    text: str
    port: int
    page: int | None
    """The page's port; None: the file has no page."""
    allow: str | None
    """The network that may; None: every machine."""

    def lets_in(self, host: str) -> bool:
        with suppress(ValueError):
            return self.allow is None or ipaddress.ip_address(host) in ipaddress.ip_network(self.allow)
        return False

    def is_open(self, keys: Mapping[str, object]) -> bool:
        """Whether a running link has these settings."""
        right = None if self.allow is None else ["127.0.0.1", self.allow]
        return keys.get("tcp") == f"0.0.0.0:{self.port}" and keys.get("allow") == right


def plan(files: Files, root: Path, settings: Path, allow: str | None) -> tuple[ChangeSet, Opened]:
    """The changes, and the new file. `allow`: the network that may; None: every machine. Raises SetupError,
    ConfigError."""
    before = _text(files, settings)
    opened = open_to(before, allow)
    parse(opened.text, str(settings))
    wanted: dict[Path, Content] = {settings: opened.text}
    notes = []
    if (root / ANNOUNCEMENT).parent.is_dir():
        wanted[root / ANNOUNCEMENT] = _SERVICE.format(port=opened.port)
    else:
        notes.append(
            "Avahi is not installed: the PC then needs the address, not the name. "
            "For the name: sudo apt install avahi-daemon, and this command again."
        )
    return planned(files, wanted, [settings], notes), opened


def undone(files: Files, root: Path, settings: Path) -> ChangeSet:
    """The changes that take `plan` back. Raises SetupError, ConfigError."""
    text = closed(_text(files, settings))
    parse(text, str(settings))
    return planned(files, {settings: text, root / ANNOUNCEMENT: None}, [settings])


def open_to(text: str, allow: str | None) -> Opened:
    """The text with its first rotctld link, or a new one, and its page open to the network. A page that is open, or
    switched off, stays as it is. Raises SetupError, ConfigError."""
    text = closed(text)
    config = parse(text, "rotator.toml")
    number = next((at for at, link in enumerate(config.link) if link.protocol == "rotctld" and link.tcp), None)
    if number is None:
        port = USUAL_PORT
        text = BLOCK.between(text, ["[[link]]", 'protocol = "rotctld"', *_ours("tcp", port, allow)], "")
    else:
        port = address(config.link[number].tcp or "")[1]
        text = _replaced(text, ("link", number), _ours("tcp", port, allow))
    _, page = address(config.page.listen)
    if config.page.enabled and is_this_machine(config.page.listen):
        text = _replaced(text, ("page",), _ours("listen", page, allow))
        _check_page(text, f"0.0.0.0:{page}")
    return Opened(text, port, page if config.page.enabled else None, allow)


def _check_page(text: str, listen: str) -> None:
    """A page that is written in another form than a table of lines is left to the person. Raises SetupError."""
    with suppress(ConfigError):
        if parse(text, "rotator.toml").page.listen == listen:
            return
    raise SetupError(f'[page] has no heading of its own here: write listen = "{listen}" there, and run this again')


def _replaced(text: str, table: Place, ours: list[str]) -> str:
    """Our lines in place of the table's own of these keys, which stay as remarks; without such, below its heading."""
    rows, found = text.split("\n"), statements(text)
    keys = [(*table, key) for key in (ours[0].partition(" = ")[0], "allow")]
    taken = [row for each in found if each.place in keys for row in range(each.line - 1, each.last)]
    heading = next((each.line for each in found if each.heads and each.place == table), None)
    if not taken and heading is None:
        if len(table) > 1:
            raise SetupError(f"this [[link]] has no heading of its own here: write {ours[0]} there, or give it one")
        return BLOCK.between(text, [f"[{table[0]}]", *ours], "")
    first = min(taken, default=heading or 0)
    end = "\r" if rows[min(first, len(rows) - 1)].endswith("\r") else ""
    result: list[str] = []
    done = 0
    # Lines apart from each other get marks of their own, so that each goes back to its place.
    for run in _runs(taken) or [range(first, first)]:
        was = [BLOCK.was + row for row in rows[run.start : run.stop]]
        result += [*rows[done : run.start], BLOCK.begin + end, *was, *(line + end for line in ours), BLOCK.end + end]
        ours, done = [], run.stop
    return "\n".join([*result, *rows[done:]])


def _runs(numbers: Iterable[int]) -> list[range]:
    """The numbers in rising order, neighbours in one range."""
    runs: list[range] = []
    for number in sorted(numbers):
        if runs and runs[-1].stop == number:
            runs[-1] = range(runs[-1].start, number + 1)
        else:
            runs.append(range(number, number + 1))
    return runs


def closed(text: str) -> str:
    """The text as it was before. Raises SetupError where a person has changed what stands between the marks."""
    rest = BLOCK.without(text)
    if yours := BLOCK.strangers(text):
        raise SetupError(f'"{yours[0]}" between the marks of `rotator setup network` is yours: change it by hand')
    return rest


def allowed(network: str) -> str:
    """The key for one network. Programs on the box's own machine stay let in."""
    return f'allow = ["127.0.0.1", "{network}"]'


def _ours(key: str, port: int, allow: str | None) -> list[str]:
    return [f'{key} = "0.0.0.0:{port}"', *([allowed(allow)] if allow else [])]


def _text(files: Files, path: Path) -> str:
    content = files.get(path)
    if not isinstance(content, str):
        raise SetupError(f"there is no {path}: say with --config which file the box runs with")
    return content
