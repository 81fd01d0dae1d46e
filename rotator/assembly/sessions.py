"""From the protocol of a `[[link]]` table to a session that speaks it. Part of the composition root.

Knows which class speaks which protocol, and which keys of the table it takes. Knows no port and no socket.
"""

from __future__ import annotations

from collections.abc import Callable

from rotator.config.links import Link, ProtocolName
from rotator.orbits.celestial import Sky
from rotator.protocols.dcu1 import Dcu1Session
from rotator.protocols.easycomm import Level
from rotator.protocols.easycomm_session import EasycommSession
from rotator.protocols.f1efw import F1efwSession
from rotator.protocols.gs232 import INVALID, Dialect
from rotator.protocols.gs232_session import Gs232Session
from rotator.protocols.lx200_session import Lx200Session
from rotator.protocols.macdoppler import MacDopplerSession
from rotator.protocols.n1mm import N1mmSession
from rotator.protocols.prosistel import Model as Prosistel
from rotator.protocols.prosistel import ProsistelSession
from rotator.protocols.pstrotator import PstRotatorSession
from rotator.protocols.pstrotatoraz import PstRotatorAzSession
from rotator.protocols.rc2800 import Rc2800Session
from rotator.protocols.rotctld_session import RotctldSession
from rotator.protocols.session import Box, Session
from rotator.protocols.spid import Model
from rotator.protocols.spid_session import SpidSession
from rotator.protocols.stellarium import StellariumSession
from rotator.protocols.wsjtx import WsjtxSession


def session_maker(
    link: Link,
    box: Box,
    remark: Callable[[str], None] = lambda _text: None,
    *,
    sky: Sky | None = None,
    notice: Callable[[str], None] = lambda _text: None,
) -> Session:
    """A new conversation in the link's protocol.

    `remark` takes a text for the log, to be logged once: a request that the box does not support. `notice` takes one
    about an event. `sky`: None where the configuration does not say where the station is.
    """
    match link.protocol:
        case "gs232a" | "gs232b":
            return Gs232Session(
                box,
                Dialect.A if link.protocol == "gs232a" else Dialect.B,
                ack=b"\r" if link.acknowledges else b"",
                empty_line=INVALID if link.rejects_empty_lines else b"",
                strict=link.strict,
                may_calibrate=link.may_calibrate,
            )
        case "gs232-f1efw":
            return F1efwSession(box)
        case "rotctld":
            return RotctldSession(box)
        case "rotctld-follow":
            raise ValueError("there is no conversation on a link that asks")
        case "easycomm1" | "easycomm2" | "easycomm3":
            level = {"easycomm1": Level.I, "easycomm2": Level.II, "easycomm3": Level.III}[link.protocol]
            return EasycommSession(box, level, pstrotator=link.easycomm_answer == "pstrotator")
        case "rot1prog":
            return SpidSession(box, Model.ROT1PROG)
        case "rot2prog":
            return SpidSession(box, Model.ROT2PROG, link.pulses_per_degree)
        case "md01":
            return SpidSession(box, Model.MD01, link.pulses_per_degree)
        case "dcu1":
            return Dcu1Session(box)
        case "pstrotator":
            return PstRotatorSession(box, remark, sky.site if sky else None)
        case "pstrotatoraz":
            return PstRotatorAzSession(box)
        case "lx200" | "stellarium":
            if sky is None:
                raise ValueError(f"{link.protocol} needs the station's place")
            session = Lx200Session if link.protocol == "lx200" else StellariumSession
            return session(box, sky, notice)
        case "prosistel-d":
            return ProsistelSession(box, Prosistel.D)
        case "prosistel-c":
            return ProsistelSession(box, Prosistel.COMBI_TRACK)
        case "rc2800":
            return Rc2800Session(box)
        case "n1mm":
            return N1mmSession(box, link.rotor_name, remark)
        case "macdoppler":
            return MacDopplerSession(box)
        case "wsjtx":
            return WsjtxSession(box, link.body)


BINARY: tuple[ProtocolName, ...] = ("rot1prog", "rot2prog", "md01", "stellarium")
HTTP: tuple[ProtocolName, ...] = ("pstrotatoraz",)
