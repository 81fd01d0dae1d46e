"""The command tables of EasyComm, SPID and DCU-1 in docs/protocols.md.

Knows one example of each command, and how binary bytes are shown. The protocols' own sessions give the answers.
"""

from __future__ import annotations

from rotator.protocols import dcu1, easycomm, spid
from rotator.protocols.dcu1 import Dcu1Session
from rotator.protocols.easycomm import Level
from rotator.protocols.easycomm_session import EasycommSession
from rotator.protocols.reference.gs232 import AZIMUTH_DEG, ELEVATION_DEG, Example, shown, table
from rotator.protocols.spid import Command, Frame, Model, Turn
from rotator.protocols.spid_session import PULSES, SpidSession

_EASYCOMM_EXAMPLES = {"VL": "VL4900", "VR": "VR4900", "VU": "VU4900", "VD": "VD4900"}
"""Commands with numbers; all others have none."""
_DCU1_EXAMPLES = {"AP1": "AP1235;"}


def easycomm_table() -> str:
    """Every EasyComm command for a rotor, the first standard that has it, an example and its answer."""
    rows: list[tuple[str, ...]] = [("command", "from", "what it does", "example", "answer")]
    for verb in easycomm.VERBS:
        example = _EASYCOMM_EXAMPLES.get(verb.text, verb.text)
        answer = b"".join(EasycommSession(Example(), Level.III).receive(example.encode() + b"\n"))
        rows.append((f"`{verb.text}`", verb.level.name, verb.help, f"`{example}`", shown(answer)))
    return table(rows)


def spid_table() -> str:
    """Every SPID command with its frame for 235/25, or left, and each controller's answer, in hex."""
    rows: list[tuple[str, ...]] = [("K", "what it does", "for", "sent", "answer")]
    for row in spid.ROWS:
        for model in row.models:
            sent = spid.encode(_example(row.command, model), model, PULSES[model])
            answer = b"".join(SpidSession(Example(), model).receive(sent))
            rows.append((f"`{row.command:02X}`", row.help, model.value, _hex(sent), _hex(answer)))
    return table(rows)


def dcu1_table() -> str:
    """Every DCU-1 command with an example and its answer."""
    rows: list[tuple[str, ...]] = [("command", "what it does", "example", "answer")]
    for verb in dcu1.VERBS:
        example = _DCU1_EXAMPLES.get(verb.text, verb.text + ";")
        answer = b"".join(Dcu1Session(Example()).receive(example.encode()))
        rows.append((f"`{verb.text}`" if verb.text else "", verb.help, f"`{example}`", shown(answer)))
    return table(rows)


def _example(command: Command, model: Model) -> Frame:
    match command:
        case Command.SET:
            return Frame(command, AZIMUTH_DEG, None if model is Model.ROT1PROG else ELEVATION_DEG)
        case Command.MOVE:
            return Frame(command, turn=Turn.LEFT)
        case _:
            return Frame(command)


def _hex(octets: bytes) -> str:
    return f"`{octets.hex(' ').upper()}`" if octets else "nothing"
