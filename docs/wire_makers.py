"""More command tables of docs/reference/wire.md: EasyComm, SPID, DCU-1, Prosistel and M2, made as those in wire.py.

Knows one example of each command, and how binary bytes are shown. Does not know what a command does or answers: the
protocol's session is asked.
"""

from __future__ import annotations

from itertools import islice

from docs.wire import AZIMUTH_DEG, ELEVATION_DEG, Example, shown, table
from rotator.protocols import dcu1, easycomm, prosistel, rc2800, spid
from rotator.protocols.dcu1 import Dcu1Session
from rotator.protocols.easycomm import Level
from rotator.protocols.easycomm_session import EasycommSession
from rotator.protocols.prosistel import ProsistelSession
from rotator.protocols.rc2800 import Rc2800Session
from rotator.protocols.spid import PULSES, Command, Frame, Model, SpidSession, Turn

_EASYCOMM_EXAMPLES = {"VL": "VL4900", "VR": "VR4900", "VU": "VU4900", "VD": "VD4900"}
"""Commands that take numbers; all others have none."""
_FIELDS = {13: (1, 4, 1, 4, 1, 1, 1), 12: (1, 4, 1, 4, 1, 1), 5: (1, 3, 1)}
"""The bytes of each field of a SPID frame, by its length: start, azimuth, pulses, elevation, pulses, K, end."""
_DCU1_EXAMPLES = {"AP1": "AP1235;"}


def easycomm_table() -> str:
    """Every EasyComm command that concerns a rotor: an example, the first standard that has it, and the answer."""
    rows: list[tuple[str, ...]] = [("example", "from", "what it does", "answer")]
    for verb in easycomm.VERBS:
        example = _EASYCOMM_EXAMPLES.get(verb.text, verb.text)
        answer = b"".join(EasycommSession(Example(), Level.III).receive(example.encode() + b"\n"))
        rows.append((f"`{example}`", verb.level.name, verb.help, shown(answer)))
    return table(rows)


def spid_table() -> str:
    """Every SPID command with the frame that means 235/25, or left, and each controller's answer, in hex.

    Controllers that get the same frame and answer alike share a row. An answer equal to that of a read is not repeated.
    """
    rows: list[tuple[str, ...]] = [("K", "what it does", "for", "sent", "answer")]
    for row in spid.ROWS:
        models: dict[tuple[str, str], list[str]] = {}
        for model in row.models:
            sent, answer = _exchange(row.command, model)
            as_read = row.command is not Command.STATUS and answer == _exchange(Command.STATUS, model)[1]
            answer_text = f"as `{Command.STATUS:02X}`" if as_read else _hex(answer)
            models.setdefault((_hex(sent), answer_text), []).append(model.value)
        rows += [(f"`{row.command:02X}`", row.help, ", ".join(names), *cells) for cells, names in models.items()]
    return table(rows)


def _exchange(command: Command, model: Model) -> tuple[bytes, bytes]:
    sent = spid.encode(_example(command, model), model, PULSES[model])
    return sent, b"".join(SpidSession(Example(), model).receive(sent))


def dcu1_table() -> str:
    """An example of every DCU-1 command, and its answer."""
    rows: list[tuple[str, ...]] = [("example", "what it does", "answer")]
    for verb in dcu1.VERBS:
        example = _DCU1_EXAMPLES.get(verb.text, verb.text + ";")
        answer = b"".join(Dcu1Session(Example()).receive(example.encode()))
        rows.append((f"`{example}`", verb.help, shown(answer)))
    return table(rows)


def prosistel_table() -> str:
    """Every Prosistel command for azimuth, as each model writes it, and its answer."""
    rows: list[tuple[str, ...]] = [("D", "Combi-Track", "what it does", "answer of D", "of Combi-Track")]
    for verb in prosistel.VERBS:
        sent, answers = [], []
        for model, form in prosistel.FORMS.items():
            number = "" if verb.text != "G" else f"{AZIMUTH_DEG * form.per_degree:g}"
            text = f"G{1000 * form.per_degree - 1}" if verb.text == "G999" else verb.text
            said = f"\x02A{text}{number}\r".encode()
            sent.append(shown(said))
            answers.append(shown(b"".join(ProsistelSession(Example(), model).receive(said))))
        rows.append((*sent, verb.help, *answers))
    return table(rows)


def rc2800_table() -> str:
    """An example of every command of the RC2800PX, and its answer."""
    rows: list[tuple[str, ...]] = [("example", "what it does", "answer")]
    for verb in rc2800.VERBS:
        example = verb.text + verb.takes
        answer = b"".join(Rc2800Session(Example()).receive(example.encode() + b"\r"))
        rows.append((f"`{example}`", verb.help, shown(answer)))
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
    """A frame in hex, one group for each field."""
    if not octets:
        return ""
    digits = iter(octets.hex().upper())
    return f"`{' '.join(''.join(islice(digits, 2 * size)) for size in _FIELDS[len(octets)])}`"
