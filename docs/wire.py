"""The command tables of docs/reference/wire.md, made from the code's own tables, answered by the code's own sessions.

Knows Markdown and one example of each command. Does not know what any command does or answers: it asks.
"""

from __future__ import annotations

from rotator import __version__
from rotator.exchange.orders import Order
from rotator.exchange.sources import Refusal
from rotator.exchange.status import AxisStatus, Status
from rotator.protocols import gs232, rotctld, rotctld_earth
from rotator.protocols.gs232 import Dialect
from rotator.protocols.gs232_session import Gs232Session
from rotator.protocols.rotctld_session import RotctldSession

AZIMUTH_DEG, ELEVATION_DEG = 235.0, 25.0
LONGEST_SHOWN = 40

_GS232_EXAMPLES = {"M": "M235", "W": "W235 025"}
"""Commands that take numbers; all others have none."""
_TIMED_LIST = b"W010 235 025 240 030 245 035\r"
"""Sent before T and N, which need a loaded list."""
_ROTCTLD_EXAMPLES = {
    "set_pos": "235 25",
    "reset": "1",
    "move": "CW -1",
    "set_level": "SPEED 2",
    "get_level": "SPEED",
    "set_func": "?",
    "get_func": "?",
    "set_parm": "?",
    "get_parm": "?",
    "set_conf": "max_az 540",
    "get_conf": "max_az",
    "send_cmd": "C2",
    "pause": "5",
}


class Example:
    """A box whose antenna is at 235/25 and which accepts every order."""

    def status(self) -> Status:
        return Status(0.0, AxisStatus(0, 450, AZIMUTH_DEG), AxisStatus(0, 180, ELEVATION_DEG))

    def note_refused(self, refused: Refusal | bytes) -> None:
        """There is no log."""

    def order(self, _order: Order) -> Refusal | None:
        return None


def gs232_table() -> str:
    """Every GS-232 command and its answer; both answers where the two dialects differ."""
    rows: list[tuple[str, ...]] = [("command", "what it does", "answer")]
    for verb in gs232.VERBS:
        example = _GS232_EXAMPLES.get(verb.text, verb.text)
        a, b = (_gs232_answer(dialect, example) for dialect in (Dialect.A, Dialect.B))
        rows.append((f"`{verb.text}`", verb.help, a if a == b else f"A: {a}, B: {b}"))
    return table(rows)


def rotctld_table() -> str:
    """Every rotctld command that the box knows: an example, its long name, and the answer to the example.

    Those that only calculate share the last row.
    """
    rows: list[tuple[str, ...]] = [("example", "long form", "what it does", "answer")]
    calculate = [verb for verb in rotctld.VERBS if verb.name in rotctld_earth.NAMES]
    for verb in (each for each in rotctld.VERBS if each not in calculate):
        request = rotctld.Request(verb.name, tuple(_ROTCTLD_EXAMPLES.get(verb.name, "").split()))
        session = RotctldSession(Example())
        answer = b"".join(session.receive(rotctld.encode(request)))
        answer_text = "the connection ends" if session.closed else shown(answer)
        example = rotctld.encode(request).decode().strip()
        if verb.letter.isascii():
            example = verb.letter + example[1:]
        rows.append((f"`{example}`", f"`\\{verb.name}`", verb.help, answer_text))
    names = (" ".join(parts) for parts in zip(*((each.letter, f"\\{each.name}") for each in calculate), strict=True))
    return table(
        [*rows, (*(f"`{each}`" for each in names), "Locators, degrees and distances, as Hamlib calculates them")]
    )


def _gs232_answer(dialect: Dialect, example: str) -> str:
    session = Gs232Session(Example(), dialect, may_calibrate=True)
    if example in ("T", "N"):
        session.receive(_TIMED_LIST)
    return shown(b"".join(session.receive(example.encode() + b"\r")))


def shown(answer: bytes) -> str:
    """An answer as the page shows it: escaped text, a number of lines where it is long."""
    if not answer:
        return ""
    if len(answer) > LONGEST_SHOWN:
        return f"{len(answer.splitlines())} lines"
    # The page must not change with each release.
    text = answer.decode("latin-1").replace(__version__, "VERSION").encode("unicode_escape").decode()
    return f"`{text}`"


def table(rows: list[tuple[str, ...]]) -> str:
    """A Markdown table; the first row is its head. A row ends with its last cell that has a text."""
    head, *lines = (" | ".join(cell.replace("|", r"\|") for cell in row).rstrip("| ") for row in rows)
    return "\n".join([head, "|".join("--" for _ in rows[0]), *lines, ""])
