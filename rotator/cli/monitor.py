"""`rotator monitor`: every byte on every link of the running box, live or to a file.

Filters lines by link, prints or records them, and ends a recording properly. The form of the lines is in
`rotator.monitor.transcript`.
"""

from __future__ import annotations

import signal
import socket
from collections.abc import Iterator, Sequence
from pathlib import Path

import click

from rotator.cli.failed import CommandFailed
from rotator.cli.reach import monitors, reach
from rotator.monitor.transcript import LinkNote, Peer, Piece, Remark, parse

BYTES_PER_MB = 1_000_000


def watch(path: Path | None, to: Path | None, links: Sequence[str], limit_mb: float) -> None:
    """Show or record until Ctrl-C, until the box ends, or until the file is full. Raises ConfigError, CommandFailed."""
    with reach(path, monitors) as box:
        signal.signal(signal.SIGTERM, signal.default_int_handler)
        lines = _only(links, _lines(box))
        if to is None:
            _show(lines)
        else:
            _record(lines, to, limit_mb)


def _lines(box: socket.socket) -> Iterator[str]:
    with box.makefile(encoding="ascii", errors="backslashreplace", newline="\n") as lines:
        for line in lines:
            yield line.rstrip("\n")


def _only(links: Sequence[str], lines: Iterator[str]) -> Iterator[str]:
    """The remarks, and the lines of these links; without names, of all. Raises CommandFailed for an unknown name."""
    known: list[str] = []
    for line in lines:
        entry = parse(line)
        match entry:
            case LinkNote(name):
                known.append(name)
                wanted = name in links
            case Piece(source=source) | Peer(source=source):
                wanted = source.link in links
            case _:
                wanted = True
        if not isinstance(entry, LinkNote | Remark):
            # The box has named all its links by now.
            unknown = [name for name in links if name not in known]
            if unknown:
                raise CommandFailed(f"no link is called {unknown[0]}; there are: {', '.join(known)}")
        if wanted or not links:
            yield line


def _show(lines: Iterator[str]) -> None:
    try:
        for line in lines:
            click.echo(line)
        click.echo("the box has ended", err=True)
    except KeyboardInterrupt:
        pass


def _record(lines: Iterator[str], to: Path, limit_mb: float) -> None:
    try:
        file = to.open("x", encoding="ascii")
    except FileExistsError:
        raise CommandFailed(f"{to} is there already: give another name") from None
    except OSError as fault:
        raise CommandFailed(f"{to} cannot be written to: {fault.strerror}") from fault
    pieces = 0
    end = "the box has ended"

    def write(text: str) -> None:
        # Line by line, so that nothing is lost if this program is killed.
        file.write(text + "\n")
        file.flush()

    with file:
        click.echo(f"writing to {to}; Ctrl-C ends it", err=True)
        try:
            for line in lines:
                if file.tell() + len(line) > limit_mb * BYTES_PER_MB:
                    end = f"the file is full: {limit_mb:g} MB"
                    break
                write(line)
                pieces += not line.startswith("#")
        except KeyboardInterrupt:
            end = "stopped"
        except OSError as fault:
            raise CommandFailed(f"{to} cannot be written to: {fault.strerror}") from fault
        write(f"# {end}")
    click.echo(f"{pieces} pieces in {to}: {end}", err=True)
