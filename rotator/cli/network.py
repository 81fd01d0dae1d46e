"""`rotator setup network`: opens rotctld and the page to the local network, says what to type on the PC, and waits for
the PC to ask.

Knows the questions and the test. `rotator.setup.network` plans the changes; the monitor of the running box
says who has asked.
"""

from __future__ import annotations

import re
import select
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

import click

from rotator.cli.failed import CommandFailed
from rotator.cli.lines import say
from rotator.cli.reach import monitors, reach
from rotator.cli.setup import SETTINGS, propose
from rotator.exchange.sources import Source
from rotator.monitor.transcript import LinkNote, Peer, Piece, Way, parse
from rotator.setup import network, tree
from rotator.setup.machine import Machine, this_machine
from rotator.setup.plan import SetupError
from rotator.setup.questions import network as network_of

PATIENCE_S = 300.0
START_S = 20.0
"""A Pi Zero needs some seconds until its box answers."""
_UNITS = ("etc/systemd/system", "lib/systemd/system", "usr/lib/systemd/system")
_LATER = "ADDRESS"
"""In place of an address that is not known yet."""
_POSITION = re.compile(rb"\s*+[+;|,]?\s*+(?:p|\\get_pos)\s*")


def open_network(root: Path, settings: Path | None, allow: str | None, *, undo: bool, yes: bool) -> None:
    """`allow`: a network, "all", or None to ask."""
    path = settings or root / SETTINGS
    files = tree.read(path, root / network.ANNOUNCEMENT)
    restart = _restart(root, path)
    then = "the Pi starts from this card." if tree.is_card(root) else f"the box starts again: {restart}"
    done = f"Done. It takes effect when {then}"
    if undo:
        propose(network.undone(files, root, path), yes=yes, done=done)
        return
    # What hinders is said before the question.
    if reason := tree.hindrance(network.plan(files, root, path, None)[0]):
        raise SetupError(f"{reason}. Nothing was asked, nothing was changed")
    machine, card = this_machine(root), tree.is_card(root)
    name = _host_name(root) or ("" if card else machine.name)
    if card:
        click.echo(f"The card of {name or 'a Pi without a name'}. Its address is known only after it has started.")
    else:
        here = ", ".join(str(address.ip) for address in machine.addresses) or "none in a local network"
        click.echo(f"This machine: {name}, address {here}.")
    chosen = _chosen(allow, machine, yes=yes, card=card)
    plan, opened = network.plan(files, root, path, chosen)
    changed = propose(plan, yes=yes, done=done)
    announced = f"{name}.local" if name and (root / network.ANNOUNCEMENT).parent.is_dir() else ""
    address = _LATER if card else next((str(each.ip) for each in machine.addresses), name)
    _say_what_to_type(announced or address, address, opened)
    if not yes and not card and sys.stdin.isatty():
        _try_it(path, opened, restart if changed else "")


def _chosen(allow: str | None, machine: Machine, *, yes: bool, card: bool) -> str | None:
    """The network that may; None: every machine. A card may start in another network than this machine's."""
    if allow is None and yes:
        if card or not machine.networks:
            where = "on this card" if card else "here"
            raise SetupError(f"no local network is known {where}: say which may with --allow 192.168.1.0/24")
        allow = machine.networks[0]
    while allow is None:
        say("Who may reach the box over the network? Through rotctld they turn the antenna without a password.")
        for number, each in enumerate(machine.networks, 1):
            click.echo(f"{number:>4}  computers in {each}{', where this machine is' if card else ''}")
        click.echo(f"{len(machine.networks) + 1:>4}  every computer that reaches {'the Pi' if card else 'this one'}")
        click.echo("      or type a network or an address, such as 192.168.1.20")
        try:
            typed = str(click.prompt("Number", default="1" if machine.networks else None)).strip()
        except click.Abort:
            raise SetupError("nothing was changed (--allow NETWORK --yes does it without asking)") from None
        offered = [*machine.networks, "all"]
        if typed.isdigit() and 1 <= int(typed) <= len(offered):
            allow = offered[int(typed) - 1]
            break
        try:
            allow = network_of(typed)
        except ValueError as fault:
            say(str(fault))
    if allow.lower() == "all":
        return None
    try:
        return network_of(allow)
    except ValueError as fault:
        raise SetupError(f"--allow: {fault}") from None


def _restart(root: Path, path: Path) -> str:
    """The command that starts the box again with this file: the service's, where one is installed."""
    installed = any((root / folder / "rotator.service").exists() for folder in _UNITS)
    return "sudo systemctl restart rotator" if installed and path == root / SETTINGS else f"rotator run --config {path}"


def _say_what_to_type(host: str, address: str, opened: network.Opened) -> None:
    instead, port = "", opened.port
    if address == _LATER:
        instead = ", where ADDRESS is what `hostname -I` prints on the Pi" if host == _LATER else ""
    elif host != address:
        instead = f" (or {address} where the name is not found)"
    click.echo(f"""
On the PC{instead}:
  Gpredict   Edit, Preferences, Interfaces, Rotators, Add New:
             Host {host}, Port {port}
  Hamlib     rotctl -m 2 -r {host}:{port} p
  Look4Sat   Settings, rotator: {host}, port {port}""")
    if opened.page is not None:
        click.echo(f"  Browser    http://{host}:{opened.page}")


def _try_it(path: Path, opened: network.Opened, restart: str) -> None:
    """Have the box started again where `restart` names the command, and wait for the PC."""
    if restart and restart.startswith("sudo") and _service_runs():
        if not click.confirm("\nStart the box again now? A moving antenna stops.", default=False):
            say(f"Then later: {restart}. Until then it runs with the old settings, and a test would tell nothing.")
            return
        subprocess.run(["systemctl", "restart", "rotator"], check=False)
        _wait_until_it_answers(path)
    elif restart:
        say(f"\nA box that runs has the old settings: end it, and start it again: {restart}")
    if not click.confirm("Wait here for the PC's first question?", default=True):
        return
    wait_for_the_pc(path, opened)


def _wait_until_it_answers(path: Path) -> None:
    end_s = time.monotonic() + START_S
    while time.monotonic() < end_s:
        with suppress(CommandFailed):
            reach(path, monitors).close()
            return
        time.sleep(0.1)


def wait_for_the_pc(path: Path, opened: network.Opened, patience_s: float = PATIENCE_S) -> bool:
    """Say who has asked for the position through the port; False: no other computer has, in that time.

    Raises SetupError where no box runs, or one that has not read the new settings.
    """
    try:
        box = reach(path, monitors)
    except CommandFailed as fault:
        raise SetupError(f"{fault}; then type the line for Hamlib on the PC") from fault
    click.echo("Waiting for the PC (Ctrl-C ends) ...")
    with box, suppress(KeyboardInterrupt):
        for host in _asking(box, opened, time.monotonic() + patience_s):
            if host.startswith(("127.", "::1")):
                continue
            if not opened.lets_in(host):
                say(f"{host} has just asked, and is not in {opened.allow}: give --allow a network that it is in.")
                return False
            click.echo(f"{host} has just asked for the position: it works.")
            return True
    say(
        "No computer has asked. Is the PC in the same network (no guest Wi-Fi), and in the one that may? "
        "`journalctl -u rotator` says who was turned away."
    )
    return False


def _asking(box: socket.socket, opened: network.Opened, deadline_s: float) -> Iterator[str]:
    """The address of each machine that asks for the position on the link that was opened. Raises SetupError."""
    names: set[str] = set()
    hosts: dict[Source, str] = {}
    rest = b""
    while (left_s := deadline_s - time.monotonic()) > 0:
        ready, _, _ = select.select([box], [], [], left_s)
        if not ready:
            return
        if not (data := box.recv(65536)):
            raise SetupError("the box has ended: start it, then type the line for Hamlib on the PC")
        *lines, rest = (rest + data).split(b"\n")
        for line in lines:
            match parse(line.decode("ascii", "replace")):
                case LinkNote(name, keys) if str(keys.get("tcp", "")).endswith(f":{opened.port}"):
                    if not opened.is_open(keys):
                        raise SetupError("the running box has the old settings: start it again first, then try the PC")
                    names.add(name)
                case Peer(source, host):
                    hosts[source] = host
                case Piece(source=source, way=Way.IN, data=typed) if source.link in names and source in hosts:
                    if any(_POSITION.fullmatch(each) for each in typed.split(b"\n")):
                        yield hosts[source]


def _service_runs() -> bool:
    if not Path("/run/systemd/system").is_dir():
        return False
    asked = subprocess.run(["systemctl", "--quiet", "is-active", "rotator"], check=False)
    return asked.returncode == 0


def _host_name(root: Path) -> str | None:
    with suppress(OSError):
        return (root / "etc/hostname").read_text().strip() or None
    return None
