"""Writes what the program itself knows into the pages: `make reference`, or `python -m docs.generate`.

Each table stands between `<!-- name: begin -->` and `<!-- name: end -->`. The tests compare page and program.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from docs import session
from docs.keys import reference
from docs.wire import gs232_table, rotctld_table
from docs.wire_datagrams import pstrotator_table, pstrotatoraz_table
from docs.wire_makers import dcu1_table, easycomm_table, prosistel_table, rc2800_table, spid_table
from docs.wire_telescopes import lx200_table, stellarium_table
from rotator.control.rights import TABLE, Deed, State
from rotator.doctor.checks import CONFIGURATION, OF_THE_MACHINE, OF_THE_STATION
from rotator.doctor.finding import Check
from rotator.protocols.console import VERBS
from rotator.protocols.programs import PROGRAMS
from rotator.store.whole import write_whole

DOCS = Path(__file__).resolve().parent


def console_table() -> str:
    rows = ["say | what it does", "--|--"]
    for verb in VERBS:
        usage = verb.usage.replace("|", "\\|")
        rows.append(f"`{usage}` | {verb.help}")
    return "\n".join(rows) + "\n"


def checks_table() -> str:
    """One row for each check of the doctor, in the order of the report."""
    checks: tuple[Check[...], ...] = (CONFIGURATION, *OF_THE_MACHINE, *OF_THE_STATION)
    return "\n".join(["check | looks at", "--|--", *(f"{check.name} | {check.looks_at}" for check in checks)])


def programs_table() -> str:
    rows = ["program | link | set in the program | how we know", "--|--|--|--"]
    for program in PROGRAMS:
        protocols = ", ".join(f"`{protocol}`" for protocol in program.protocols)
        link = f"{protocols}; {program.where}" if program.where else protocols
        rows.append(f"{program.name} | {link} | {program.settings} | {program.known}")
    return "\n".join(rows) + "\n"


def rights_table() -> str:
    """The table for docs/safety.md. States that allow the same orders share a column, and orders that the same states
    allow share a row."""
    columns: dict[tuple[str, ...], list[str]] = {}
    for state in State:
        columns.setdefault(tuple(TABLE[state][deed].value for deed in Deed), []).append(state.value)
    rows: dict[tuple[str, ...], list[str]] = {}
    for deed, *cells in zip(Deed, *columns, strict=True):
        rows.setdefault(tuple(cells), []).append(deed.value)
    head = " | ".join(["order", *map("; ".join, columns.values())])
    lines = [" | ".join(["; ".join(deeds), *cells]) for cells, deeds in rows.items()]
    return "\n".join([head, "|".join(["--"] * (1 + len(columns))), *lines])


PARTS: dict[str, dict[str, Callable[[], str]]] = {
    "reference/keys.md": {"reference": reference},
    "reference/checks.md": {"checks": checks_table},
    "reference/console.md": {"console": console_table},
    "reference/programs.md": {"programs": programs_table},
    "reference/wire.md": {
        "gs232": gs232_table,
        "rotctld": rotctld_table,
        "easycomm": easycomm_table,
        "spid": spid_table,
        "dcu1": dcu1_table,
        "pstrotator": pstrotator_table,
        "pstrotatoraz": pstrotatoraz_table,
        "lx200": lx200_table,
        "stellarium": stellarium_table,
        "prosistel": prosistel_table,
        "rc2800": rc2800_table,
    },
    "safety.md": {"rights": rights_table},
    "paths/termite.md": {"session": session.block},
}


def renewed(text: str, parts: dict[str, Callable[[], str]]) -> str:
    """The page with each of its tables made anew."""
    for name, make in parts.items():
        before, _, rest = text.partition(f"<!-- {name}: begin -->\n")
        _, mark, after = rest.partition(f"<!-- {name}: end -->")
        text = f"{before}<!-- {name}: begin -->\n\n{make().rstrip()}\n\n{mark}{after}"
    return text


def main() -> None:
    for page, parts in PARTS.items():
        text = (DOCS / page).read_text(encoding="utf-8")
        write_whole(DOCS / page, renewed(text, parts))


if __name__ == "__main__":
    main()
