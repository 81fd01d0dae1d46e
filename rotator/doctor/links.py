"""The checks of the links: serial ports, pseudo-terminals, TCP and UDP ports.

Knows what the box needs of each port, and finds the program that holds it. Sends nothing, and accepts no connection.
"""

from __future__ import annotations

import errno
import ipaddress
import os
import re
import socket
from collections.abc import Iterator, Sequence
from pathlib import Path, PurePath
from typing import Any

from rotator.config.links import Link, address
from rotator.config.model import Config
from rotator.doctor.finding import Finding, fine, skipped, warn, wrong
from rotator.doctor.machine import Machine, shown

LISTENING = {socket.SOCK_STREAM: ("tcp", "0A"), socket.SOCK_DGRAM: ("udp", "07")}
"""The table in /proc/net of each kind of socket, and the state of a socket that listens."""
PORTS = ("/dev/ttyS0", "/dev/ttyAMA*", "/dev/ttyGS*", "/dev/ttyACM*", "/dev/ttyUSB*")
"""The serial ports of a Pi, and of adapters plugged into it."""

ANY_ADDRESS = "Use an address of this machine, or 0.0.0.0 for all of them."
Place = tuple[Any, ...]
"""One answer of `socket.getaddrinfo`."""


def serial_ports(machine: Machine, config: Config) -> Iterator[Finding]:
    names = [link.serial for link in config.link if link.serial is not None]
    if not names:
        yield skipped("no link has one")
    for name in names:
        yield serial_port(machine, name)


def serial_port(machine: Machine, name: str) -> Finding:
    if "://" in name:
        return skipped(f"{name}: opened when the box runs")
    found = machine.opens(name, "dialout", _absent(machine, name))
    kernel = machine.text("/proc/cmdline")
    if found.ok and kernel is None:
        return fine(f"{found.found}; sudo rotator doctor sees whether the kernel's console is on it")
    if found.ok and machine.at(name).resolve().name in re.findall(r"\bconsole=(tty[A-Z]+\d+)", str(kernel)):
        return wrong(
            f"{name}: the kernel's console is on it, and its messages would be orders",
            "sudo raspi-config, Interface, Serial Port: no login shell; then reboot.",
        )
    return found


def _absent(machine: Machine, name: str) -> str:
    if "ttyGS" in name:
        return "sudo rotator setup usb-serial makes the Pi a COM port; then reboot."
    there = ", ".join(str(path) for pattern in PORTS for path in machine.glob(pattern))
    return f"Plug it in (the box waits for it), or name one of those that are there: {there or 'none now'}."


def pseudo_terminals(machine: Machine, config: Config) -> Iterator[Finding]:
    names = [link.pty for link in config.link if link.pty is not None]
    if not names:
        yield skipped("no link has one")
    for name in names:
        path = machine.at(name)
        if path.is_symlink():
            live = path.exists()
            yield fine(f"{name} → {os.readlink(path)}{'' if live else ' (left by a box that died, will be replaced)'}")
        elif path.exists():
            yield wrong(f"{name}: a file of that name is in the way", "Remove it, or give the link another pty.")
        elif not machine.may_write_in(Path(name).parent):
            yield wrong(
                f"{name}: you may not write in its folder", "Give the link a pty in a folder that you may write to."
            )
        else:
            yield fine(f"{name} will be made when the box runs")


def tcp_ports(machine: Machine, config: Config) -> Iterator[Finding]:
    return _ports(machine, [(link.tcp, link) for link in config.link if link.tcp is not None], socket.SOCK_STREAM)


def udp_ports(machine: Machine, config: Config) -> Iterator[Finding]:
    return _ports(machine, [(link.udp, link) for link in config.link if link.udp is not None], socket.SOCK_DGRAM)


def _ports(machine: Machine, links: Sequence[tuple[str, Link]], kind: socket.SocketKind) -> Iterator[Finding]:
    if not links:
        yield skipped("no link has one")
    for name, link in links:
        yield _port(machine, name, kind, link)


def page_port(machine: Machine, config: Config) -> Iterator[Finding]:
    if not config.page.enabled:
        yield skipped("[page] has switched the page off")
        return
    found = _place(machine, config.page.listen, socket.SOCK_STREAM)
    if isinstance(found, Finding):
        yield found
        return
    state, is_local = found
    network = "" if is_local else ", and open to the network; who may turn the antenna there is paired"
    yield fine(f"{config.page.listen}: {state}{network}")


def _port(machine: Machine, name: str, kind: socket.SocketKind, link: Link) -> Finding:
    found = _place(machine, name, kind)
    if isinstance(found, Finding):
        return found
    state, is_local = found
    if is_local:
        return fine(f"{name}: {state}")
    if link.read_only:
        return fine(f"{name}: {state}, and open to the network; it is read_only: nothing there turns the antenna")
    if link.allow is not None:
        return fine(f"{name}: {state}, and open to the network for {', '.join(link.allow) or 'no machine'} (allow)")
    port = address(name)[1]
    return warn(
        f"{name}: {state}, and open to the network: every machine on it can turn the antenna",
        f'allow = ["192.168.1.20"] lets only these machines in; 127.0.0.1:{port} only programs on this one.',
    )


def _place(machine: Machine, name: str, kind: socket.SocketKind) -> Finding | tuple[str, bool]:
    """Who has that address, and whether only this machine reaches it; a finding where the box cannot have it."""
    host, port = address(name)
    try:
        places = socket.getaddrinfo(host, port, type=kind, flags=socket.AI_PASSIVE)
    except (socket.gaierror, UnicodeError):
        return wrong(f"{name}: no machine has that name", ANY_ADDRESS)
    refusals = [number for place in places if (number := _refusal(place))]
    match refusals:
        case []:
            state = "free"
        case [errno.EADDRINUSE, *_]:
            owner = _listener(machine, port, kind)
            if owner is None:
                return warn(f"{name} is taken, perhaps by the running box", "sudo rotator doctor names the program.")
            if not _is_ours(owner):
                return wrong(f"{name} is taken by {shown(owner)}", "Stop that program, or take another port.")
            if machine.ask_box() is None:
                return wrong(
                    f"{name} is taken by a box with another configuration", "Stop that box, or take another port."
                )
            state = "the running box"
        case [errno.EACCES, *_]:
            return wrong(f"{name}: only root may listen below 1024", "Take a port above 1023.")
        case [number, *_]:
            return wrong(f"{name}: cannot listen there: {os.strerror(number)}", ANY_ADDRESS)
    return state, all(_is_loopback(place) for place in places)


def _refusal(place: Place) -> int | None:
    """The error number of an attempt to bind; None: the port is free."""
    family, kind, protocol, _, where = place
    try:
        with socket.socket(family, kind, protocol) as probe:
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            probe.bind(where)
    except OSError as fault:
        return fault.errno
    return None


def _is_loopback(place: Place) -> bool:
    return ipaddress.ip_address(str(place[4][0]).partition("%")[0]).is_loopback


def _is_ours(command: list[str]) -> bool:
    return any(PurePath(word).name == "rotator" for word in command)


def _listener(machine: Machine, port: int, kind: socket.SocketKind) -> list[str] | None:
    """The command line of the program that listens on the port; None if this user may not see it."""
    sockets = set()
    table_name, listening = LISTENING[kind]
    for table in (f"/proc/net/{table_name}", f"/proc/net/{table_name}6"):
        for row in (machine.text(table) or "").splitlines()[1:]:
            fields = row.split()
            if fields[3] == listening and int(fields[1].rpartition(":")[2], 16) == port:
                sockets.add(f"socket:[{fields[9]}]")
    return machine.holder(sockets)
