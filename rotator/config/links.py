"""A `[[link]]` table of the configuration file: its protocol, its port or file, and the rights of its programs.

Knows the keys of one link, and which of them go together. Knows neither the other links nor how a link is opened.
"""

from __future__ import annotations

import ipaddress
import re
from collections.abc import Iterator, Sequence
from typing import Annotated, Final, Literal

from pydantic import AfterValidator, Field

from rotator.config.table import FilePath, Table, a_path, twice
from rotator.exchange.sources import MQTT, PERSONS

ProtocolName = Literal[
    "gs232a", "gs232b", "gs232-f1efw", "rotctld", "rotctld-follow",
    "easycomm1", "easycomm2", "easycomm3", "rot1prog", "rot2prog", "md01", "dcu1",
    "pstrotator", "n1mm", "macdoppler", "wsjtx",
    "lx200", "stellarium", "pstrotatoraz", "prosistel-d", "prosistel-c", "rc2800",
]  # fmt: skip

FOLLOW: Final = "rotctld-follow"
"""The one protocol in which the box is the client."""
USUAL_BAUD = 9600
LAST_PORT = 65_535
_BAUDS: dict[ProtocolName, int] = {"rot1prog": 1200, "rot2prog": 600, "dcu1": 4800}
"""The fixed speeds of the makers' own boxes, which programs expect."""
_PLACES: dict[str, tuple[ProtocolName, ...]] = {
    "connect": (FOLLOW,),
    "udp": ("pstrotator", "n1mm", "macdoppler"),
    "file": ("wsjtx",),
}
"""Keys of a place that serve these protocols only. These protocols have no other place."""
_NEEDS_STATION: tuple[ProtocolName, ...] = ("lx200", "stellarium")
"""These protocols name places among the stars."""
_TCP_ONLY: tuple[ProtocolName, ...] = ("stellarium", "pstrotatoraz")
_MANY_PROTOCOLS_PLACES = ("pty", "serial", "tcp")
_ONE_AXIS: tuple[ProtocolName, ...] = ("dcu1", "n1mm", "pstrotatoraz", "rot1prog")
_ONLY_ORDERS: tuple[ProtocolName, ...] = (FOLLOW, "macdoppler", "wsjtx")


def address(text: str) -> tuple[str, int]:
    """`host:port` taken apart; an IPv6 host stands in brackets. Raises ValueError."""
    parts = re.fullmatch(r"(?:\[([0-9a-fA-F:.%\w]+)\]|([^:\[\]\s]+)):(\d{1,5})", text)
    if not parts or not 0 < int(parts[3]) <= LAST_PORT:
        port = text if text.isascii() and text.isdecimal() and 0 < int(text) <= LAST_PORT else "4533"
        raise ValueError(f'"{text}" must be "host:port" with a port from 1 to 65535, such as "127.0.0.1:{port}"')
    host = parts[1] or parts[2]
    numbers = host.split(".")
    if len(numbers) == 4 and all(each.isdecimal() for each in numbers) and any(int(each) > 255 for each in numbers):
        raise ValueError(f'"{text}": no number of an address is above 255: write one such as "192.168.1.77:{parts[3]}"')
    return host, int(parts[3])


def _networks(texts: list[str]) -> list[str]:
    for text in texts:
        try:
            ipaddress.ip_network(text, strict=False)
        except ValueError:
            raise ValueError(f'"{text}" must be an address or a network, such as "192.168.1.0/24"') from None
    return texts


def _an_address(text: str) -> str:
    address(text)
    return text


def _a_numeric_address(text: str) -> str:
    host, _ = address(text)
    try:
        ipaddress.IPv4Address(host)
    except ValueError:
        raise ValueError(f'"{text}" must be an IPv4 address and a port, such as "192.168.1.20:13010"') from None
    return text


def _a_port(text: str) -> str:
    if re.fullmatch(r"(?i)com\d+:?", text):
        raise ValueError(
            f'"{text}" is a port of a Windows PC, and belongs in the program there; on this machine ports are '
            "called /dev/ttyGS0 (the USB cable to the PC), /dev/ttyUSB0 or /dev/ttyACM0 (an adapter): "
            "ls /dev/serial/by-id"
        )
    return text


def _a_name(name: str) -> str:
    if name in PERSONS:
        raise ValueError(f"{name} is the name of what a person uses at the box: {', '.join(PERSONS)}; take another")
    if name == MQTT:
        raise ValueError(f"{name} is the name of [mqtt]; take another")
    if not name.isprintable() or set(name) & set("<>#"):
        raise ValueError(f"{name!r} must be printable characters, and none of < > #")
    return name


Address = Annotated[str, AfterValidator(_an_address)]
"""`host:port`."""
Networks = Annotated[list[str], AfterValidator(_networks)]
Port = Annotated[str, Field(min_length=1), AfterValidator(a_path), AfterValidator(_a_port)]
PortFile = Annotated[FilePath, AfterValidator(_a_port)]


class Link(Table):
    protocol: ProtocolName
    """The protocol of the program at the other end."""
    name: Annotated[str, Field(min_length=1, max_length=24), AfterValidator(_a_name)] | None = None
    """Its name in the log and on the display; left out, its protocol."""
    pty: PortFile | None = None
    """The path of a symlink to a pseudo-terminal, for programs on the same machine."""
    serial: Port | None = None
    """A serial port, or a URL of pyserial; a missing one is waited for."""
    tcp: Address | None = None
    """Where the box listens, "host:port"."""
    connect: Address | None = None
    """rotctld-follow: the rotctld whose position the box follows, "host:port"."""
    poll_s: float = Field(0.1, ge=0.02, le=10)
    """rotctld-follow: the time between questions."""
    udp: Address | None = None
    """pstrotator, n1mm, macdoppler: where the box listens, "host:port"; 0.0.0.0 for broadcasts too."""
    file: PortFile | None = None
    """wsjtx: the path of its azel.dat; a missing file is waited for."""
    body: Literal["Moon", "Sun", "Source"] = "Moon"
    """wsjtx: the body to follow."""
    rotor_name: str | None = Field(None, min_length=1, max_length=40)
    """n1mm: obey only orders for this rotor, capitals as in N1MM; left out, all."""
    status_to: Annotated[str, AfterValidator(_a_numeric_address)] | None = None
    """n1mm: the PC that shows the angle, "address:13010"; 255.255.255.255 for all PCs. Needs rotor_name."""
    baud: int | None = Field(None, ge=50, le=4_000_000)
    """Serial ports only; always 8N1. Left out, 9600; rot1prog 1200, rot2prog 600, dcu1 4800."""
    ack: Literal["none", "cr"] | None = None
    """GS-232: the reply to an order; Hamlib 3.x needs the CR. Left out, none; with strict cr."""
    empty_line: Literal["none", "?>"] | None = None
    """GS-232: the reply to an empty line; COSMOS waits for ?>. Left out, none; with strict ?>."""
    strict: bool = False
    """GS-232: answer as Yaesu's manual: as ack and empty_line; B: O and F wait for a Y, Z changes the centre that H3
    shows."""
    axis: Literal["azimuth", "elevation"] | None = None
    """dcu1, n1mm, pstrotatoraz, rot1prog: the axis that the bearing turns, where each has a port of its own; a stop is
    for it alone. Left out, azimuth, and a stop is for all."""
    may_calibrate: bool = False
    """GS-232: O, F, O2 and F2 take the reading as an end of the range."""
    report_moves: bool = False
    """GS-232: a line `AZ = 235, EL = 25` after each move, unasked, as from KO6TH's controller."""
    easycomm_answer: Literal["named", "pstrotator"] = "named"
    """EasyComm: the reply to AZ EL: AZ235.0 EL25.0, or +235.0 25.0 for PstRotator, it is said."""
    pulses_per_degree: Literal[1, 2, 4, 10] | None = None
    """Rot2Prog and MD-01: the resolution of orders. Left out, rot2prog 2, md01 10."""
    read_only: bool = False
    """Answer questions, and refuse all orders, a stop too."""
    allow: Networks | None = None
    """Network links: addresses and networks that may connect; left out, all may."""
    most_clients: int = Field(128, ge=1, le=1000)
    """TCP: the most connections at a time."""
    most_per_s: int = Field(100, ge=1, le=10_000)
    """The most orders a second of a connection; beyond, only the newest acts."""

    def faults(self) -> Iterator[str]:
        yield from self._place_faults()
        if self.protocol == "pstrotator" and self.udp and address(self.udp)[1] == LAST_PORT:
            yield f"pstrotator answers one port higher: {LAST_PORT} leaves none"
        if self.status_to and (self.protocol != "n1mm" or self.rotor_name is None):
            yield "status_to is for n1mm, and needs rotor_name: N1MM shows a rotor by its name"
        elif self.status_to and self.udp and is_this_machine(self.udp) and not is_this_machine(self.status_to):
            yield f'udp = "{self.udp}" reaches this machine only, and status_to is not on it: use 0.0.0.0'
        if self.report_moves and self.protocol not in ("gs232a", "gs232b"):
            yield f"report_moves is for gs232a and gs232b, not for {self.protocol}"
        if self.axis and self.protocol not in _ONE_AXIS:
            yield f"axis is for {', '.join(_ONE_AXIS)}; {self.protocol} names its axes itself"
        if self.read_only and self.protocol in _ONLY_ORDERS:
            yield f"{self.protocol} does nothing but give orders: leave out read_only"
        if self.allow is not None and (self.pty or self.serial or self.connect or self.file):
            yield "allow is for links that others connect to over a network: leave it out"

    def _place_faults(self) -> Iterator[str]:
        """Each link has exactly one place, and some protocols have only one kind of place."""
        own = next((place for place, protocols in _PLACES.items() if self.protocol in protocols), None)
        places = [place for place in (*_MANY_PROTOCOLS_PLACES, *_PLACES) if getattr(self, place) is not None]
        strange = next((place for place in places if place != own and place in _PLACES), None)
        if strange:
            right = own or "exactly one of pty, serial, tcp"
            yield f"{strange} is for {', '.join(_PLACES[strange])} only; {self.protocol} must have {right}"
        elif own and places != [own]:
            yield f"{self.protocol} must have {own}, and none of pty, serial, tcp"
        elif self.protocol in _TCP_ONLY and places != ["tcp"]:
            yield f"{self.protocol} must have tcp, and no other place"
        elif len(places) != 1:
            yield "must have exactly one of pty, serial, tcp"

    @property
    def serial_baud(self) -> int:
        return self.baud or _BAUDS.get(self.protocol, USUAL_BAUD)

    @property
    def acknowledges(self) -> bool:
        """Whether a GS-232 command that asks nothing is answered by a CR."""
        return (self.ack or ("cr" if self.strict else "none")) == "cr"

    @property
    def rejects_empty_lines(self) -> bool:
        """Whether an empty line on a GS-232 link is a mistake."""
        return (self.empty_line or ("?>" if self.strict else "none")) == "?>"

    @property
    def where(self) -> str:
        return self.pty or self.serial or self.tcp or self.connect or self.udp or self.file or ""


def _is_same_place(server: str, client: str) -> bool:
    """Whether a connection to `client` may reach the server at `server` on this machine; both "host:port"."""
    (listens, server_port), (goes_to, client_port) = address(server), address(client)
    here = all(is_this_machine(each) or address(each)[0] in ("0.0.0.0", "::") for each in (server, client))
    return server_port == client_port and (here or listens == goes_to)


def is_this_machine(place: str) -> bool:
    """Whether only programs on this machine reach it; "host:port"."""
    host, _ = address(place)
    return host in ("localhost", "::1") or host.startswith("127.")


def places_twice(links: Sequence[Link]) -> list[str]:
    at = twice(((link.where, link.connect, link.udp), f"link[{number}]") for number, link in enumerate(links))
    return [
        f"{len(keys)} links use {where}: {' and '.join(keys)}: give one of them another place"
        for (where, *_), keys in at.items()
    ]


def follows_itself(links: Sequence[Link]) -> list[str]:
    return [
        f'link[{number}].connect = "{link.connect}" is the box itself (link[{other}].tcp = "{server.tcp}"): '
        "give one of the two another port"
        for number, link in enumerate(links)
        for other, server in enumerate(links)
        if link.connect and server.tcp and _is_same_place(server.tcp, link.connect)
    ]


def needs_station(links: Sequence[Link]) -> list[str]:
    """The links that need the station, where its place is not known."""
    return [
        f"link[{number}]: {link.protocol} needs [station], with latitude_deg and longitude_deg, or locator"
        for number, link in enumerate(links)
        if link.protocol in _NEEDS_STATION
    ]
