"""From the protocol of a `[[link]]` table to sessions that speak it. Part of the composition root.

Knows which class speaks which protocol, and which keys of the table it takes. Knows no port and no socket.
"""

# ruff: noqa: PLC0415 - a box loads the protocols that it speaks

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from rotator.config.links import Link, ProtocolName
from rotator.protocols.session import Box, Session

if TYPE_CHECKING:
    from rotator.orbits.celestial import Sky


Make = Callable[[Box], Session]


def session_maker(
    link: Link,
    remark: Callable[[str], None] = lambda _text: None,
    *,
    sky: Sky | None = None,
    notice: Callable[[str], None] = lambda _text: None,
) -> Make:
    """What makes a new conversation in the link's protocol. That is loaded here: a program that connects does not wait
    for it, nor for a file to be free.

    `remark` takes a text for the log, to be logged once: a request that the box does not support. `notice` takes one
    about an event. `sky`: None where the configuration does not say where the station is.
    """
    match link.protocol:
        case "gs232a" | "gs232b":
            from rotator.protocols.gs232 import INVALID, Dialect
            from rotator.protocols.gs232_session import Gs232Session

            return lambda box: Gs232Session(
                box,
                Dialect.A if link.protocol == "gs232a" else Dialect.B,
                ack=b"\r" if link.acknowledges else b"",
                empty_line=INVALID if link.rejects_empty_lines else b"",
                strict=link.strict,
                may_calibrate=link.may_calibrate,
            )
        case "gs232-f1efw":
            from rotator.protocols.f1efw import F1efwSession

            return F1efwSession
        case "rotctld":
            from rotator.protocols.rotctld_session import RotctldSession

            return RotctldSession
        case "rotctld-follow":
            raise ValueError("there is no conversation on a link that asks")
        case "easycomm1" | "easycomm2" | "easycomm3":
            from rotator.protocols.easycomm import Level
            from rotator.protocols.easycomm_session import EasycommSession

            level = {"easycomm1": Level.I, "easycomm2": Level.II, "easycomm3": Level.III}[link.protocol]
            return lambda box: EasycommSession(box, level, pstrotator=link.easycomm_answer == "pstrotator")
        case "rot1prog" | "rot2prog" | "md01":
            from rotator.protocols.spid import Model, SpidSession

            if link.protocol == "rot1prog":
                return lambda box: SpidSession(box, Model.ROT1PROG)
            model = Model.ROT2PROG if link.protocol == "rot2prog" else Model.MD01
            return lambda box: SpidSession(box, model, link.pulses_per_degree)
        case "dcu1":
            from rotator.protocols.dcu1 import Dcu1Session

            return Dcu1Session
        case "pstrotator":
            from rotator.protocols.pstrotator import PstRotatorSession

            return lambda box: PstRotatorSession(box, remark, sky.site if sky else None)
        case "pstrotatoraz":
            from rotator.protocols.pstrotatoraz import PstRotatorAzSession

            return PstRotatorAzSession
        case "lx200" | "stellarium":
            from rotator.protocols.lx200_session import Lx200Session
            from rotator.protocols.stellarium import StellariumSession

            if sky is None:
                raise ValueError(f"{link.protocol} needs the station's place")
            session = Lx200Session if link.protocol == "lx200" else StellariumSession
            return lambda box: session(box, sky, notice)
        case "prosistel-d" | "prosistel-c":
            from rotator.protocols.prosistel import Model as Prosistel
            from rotator.protocols.prosistel import ProsistelSession

            model_of = Prosistel.D if link.protocol == "prosistel-d" else Prosistel.COMBI_TRACK
            return lambda box: ProsistelSession(box, model_of)
        case "rc2800":
            from rotator.protocols.rc2800 import Rc2800Session

            return Rc2800Session
        case "n1mm":
            from rotator.protocols.n1mm import N1mmSession

            return lambda box: N1mmSession(box, link.rotor_name, remark)
        case "macdoppler":
            from rotator.protocols.macdoppler import MacDopplerSession

            return MacDopplerSession
        case "wsjtx":
            from rotator.protocols.wsjtx import WsjtxSession

            return lambda box: WsjtxSession(box, link.body)


BINARY: tuple[ProtocolName, ...] = ("rot1prog", "rot2prog", "md01", "stellarium")
HTTP: tuple[ProtocolName, ...] = ("pstrotatoraz",)
