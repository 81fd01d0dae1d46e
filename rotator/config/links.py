"""A `[[link]]` table of the configuration file: its protocol, its port or file, and the rights of its programs.

Knows the keys of one link, and which of them go together. Knows neither the other links nor how a link is opened.
"""

from __future__ import annotations

import ipaddress
import re
from typing import Final, Literal

from pydantic import Field, field_validator, model_validator

from rotator.config.table import FilePath, Table, a_path
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
NEEDS_STATION: tuple[ProtocolName, ...] = ("lx200", "stellarium")
"""These protocols name places among the stars."""
_TCP_ONLY: tuple[ProtocolName, ...] = ("stellarium", "pstrotatoraz")
_MANY_PROTOCOLS_PLACES = ("pty", "serial", "tcp")
_ONE_AXIS: tuple[ProtocolName, ...] = ("dcu1", "n1mm", "pstrotatoraz", "rot1prog")
_ONLY_ORDERS: tuple[ProtocolName, ...] = (FOLLOW, "macdoppler", "wsjtx")


class Link(Table):
    protocol: ProtocolName
    """The protocol of the program at the other end."""
    name: str | None = Field(None, min_length=1, max_length=24)
    """Its name in the log and on the display; left out, its protocol."""
    pty: FilePath | None = None
    """The path of a symlink to a pseudo-terminal, for programs on the same machine."""
    serial: str | None = Field(None, min_length=1)
    """A serial port, or a URL of pyserial; a missing one is waited for."""
    tcp: str | None = None
    """Where the box listens, "host:port"."""
    connect: str | None = None
    """rotctld-follow: the rotctld whose position the box follows, "host:port"."""
    poll_s: float = Field(0.1, ge=0.02, le=10)
    """rotctld-follow: the time between questions."""
    udp: str | None = None
    """pstrotator, n1mm, macdoppler: where the box listens, "host:port"; 0.0.0.0 for broadcasts too."""
    file: FilePath | None = None
    """wsjtx: the path of its azel.dat; a missing file is waited for."""
    body: Literal["Moon", "Sun", "Source"] = "Moon"
    """wsjtx: the body to follow."""
    rotor_name: str | None = Field(None, min_length=1, max_length=40)
    """n1mm: obey only orders for this rotor, capitals as in N1MM; left out, all."""
    status_to: str | None = None
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
    allow: list[str] | None = None
    """Network links: addresses and networks that may connect; left out, all may."""
    most_clients: int = Field(128, ge=1, le=1000)
    """TCP: the most connections at a time."""
    most_per_s: int = Field(100, ge=1, le=10_000)
    """The most orders a second of a connection; beyond, only the newest acts."""

    @model_validator(mode="after")
    def _one_place(self) -> Link:
        own = next((place for place, protocols in _PLACES.items() if self.protocol in protocols), None)
        places = [place for place in (*_MANY_PROTOCOLS_PLACES, *_PLACES) if getattr(self, place) is not None]
        for place in places:
            if place != own and place in _PLACES:
                right = own or "exactly one of pty, serial, tcp"
                raise ValueError(f"{place} is for {', '.join(_PLACES[place])} only; {self.protocol} must have {right}")
        if own and places != [own]:
            raise ValueError(f"{self.protocol} must have {own}, and none of pty, serial, tcp")
        if self.protocol in _TCP_ONLY and places != ["tcp"]:
            raise ValueError(f"{self.protocol} must have tcp, and no other place")
        if len(places) != 1:
            raise ValueError("must have exactly one of pty, serial, tcp")
        return self

    @model_validator(mode="after")
    def _answers_have_a_port(self) -> Link:
        if self.protocol == "pstrotator" and self.udp and address(self.udp)[1] == LAST_PORT:
            raise ValueError(f"pstrotator answers one port higher: {LAST_PORT} leaves none")
        return self

    @field_validator("name")
    @classmethod
    def _no_link_is_a_person(cls, name: str | None) -> str | None:
        if name in PERSONS:
            raise ValueError(f"{name} is the name of what a person uses at the box: {', '.join(PERSONS)}; take another")
        if name == MQTT:
            raise ValueError(f"{name} is the name of [mqtt]; take another")
        return name

    @model_validator(mode="after")
    def _status_has_a_name_and_a_way(self) -> Link:
        if self.status_to is None:
            return self
        if self.protocol != "n1mm" or self.rotor_name is None:
            raise ValueError("status_to is for n1mm, and needs rotor_name: N1MM shows a rotor by its name")
        if self.udp and is_this_machine(address(self.udp)[0]) and not is_this_machine(address(self.status_to)[0]):
            raise ValueError(f'udp = "{self.udp}" reaches this machine only, and status_to is not on it: use 0.0.0.0')
        return self

    @model_validator(mode="after")
    def _moves_are_reported_on_gs232(self) -> Link:
        if self.report_moves and self.protocol not in ("gs232a", "gs232b"):
            raise ValueError(f"report_moves is for gs232a and gs232b, not for {self.protocol}")
        return self

    @model_validator(mode="after")
    def _one_bearing_is_one_axis(self) -> Link:
        if self.axis and self.protocol not in _ONE_AXIS:
            raise ValueError(f"axis is for {', '.join(_ONE_AXIS)}; {self.protocol} names its axes itself")
        return self

    @model_validator(mode="after")
    def _rights_fit(self) -> Link:
        if self.read_only and self.protocol in _ONLY_ORDERS:
            raise ValueError(f"{self.protocol} does nothing but give orders: leave out read_only")
        if self.allow is not None and (self.pty or self.serial or self.connect or self.file):
            raise ValueError("allow is for links that others connect to over a network: leave it out")
        return self

    @field_validator("name")
    @classmethod
    def _one_readable_word_or_more(cls, text: str | None) -> str | None:
        if text is not None and (not text.isprintable() or set(text) & set("<>#")):
            raise ValueError(f"{text!r} must be printable characters, and none of < > #")
        return text

    @field_validator("serial", "pty", "file")
    @classmethod
    def _a_path_of_this_machine(cls, text: str | None) -> str | None:
        if text is not None:
            a_path(text)
        if text is not None and re.fullmatch(r"(?i)com\d+:?", text):
            raise ValueError(
                f'"{text}" is a port of a Windows PC, and belongs in the program there; on this machine ports are '
                "called /dev/ttyGS0 (the USB cable to the PC), /dev/ttyUSB0 or /dev/ttyACM0 (an adapter): "
                "ls /dev/serial/by-id"
            )
        return text

    @field_validator("allow")
    @classmethod
    def _networks(cls, texts: list[str] | None) -> list[str] | None:
        return networks(texts)

    @field_validator("tcp", "connect", "udp")
    @classmethod
    def _an_address(cls, text: str | None) -> str | None:
        if text is not None:
            address(text)
        return text

    @field_validator("status_to")
    @classmethod
    def _a_numeric_address(cls, text: str | None) -> str | None:
        if text is not None:
            host, _ = address(text)
            try:
                ipaddress.IPv4Address(host)
            except ValueError:
                raise ValueError(f'"{text}" must be an IPv4 address and a port, such as "192.168.1.20:13010"') from None
        return text

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


def networks(texts: list[str] | None) -> list[str] | None:
    """The same. Raises ValueError where one is no address and no network."""
    for text in texts or ():
        try:
            ipaddress.ip_network(text, strict=False)
        except ValueError:
            raise ValueError(f'"{text}" must be an address or a network, such as "192.168.1.0/24"') from None
    return texts


_THIS_MACHINE = frozenset(("localhost", "127.0.0.1", "::1", "0.0.0.0", "::"))


def is_same_place(server: str, client: str) -> bool:
    """Whether a connection to `client` may reach the server at `server` on this machine; both "host:port"."""
    (listens, server_port), (goes_to, client_port) = address(server), address(client)
    if server_port != client_port:
        return False
    here = goes_to in _THIS_MACHINE or goes_to.startswith("127.")
    return listens == goes_to or (here and (listens in _THIS_MACHINE or listens.startswith("127.")))


def is_this_machine(host: str) -> bool:
    """Whether only programs on this machine reach the address."""
    return host in ("localhost", "::1") or host.startswith("127.")
