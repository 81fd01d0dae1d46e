"""Writes what the program itself knows into the pages: `make reference`, or `python -m docs.generate`.

Each table stands between `<!-- name: begin -->` and `<!-- name: end -->`. The tests compare page and program.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from docs import session
from docs.keys import reference
from rotator.control import rights
from rotator.doctor.checks import checks_table
from rotator.protocols.console import VERBS
from rotator.protocols.reference.datagrams import pstrotator_table, pstrotatoraz_table
from rotator.protocols.reference.gs232 import gs232_table, rotctld_table
from rotator.protocols.reference.makers import dcu1_table, easycomm_table, prosistel_table, rc2800_table, spid_table
from rotator.protocols.reference.programs import programs_table
from rotator.protocols.reference.telescopes import lx200_table, stellarium_table
from rotator.store.whole import write_whole

DOCS = Path(__file__).resolve().parent


def console_table() -> str:
    rows = ["say | what it does", "--|--"]
    for verb in VERBS:
        usage = verb.usage.replace("|", "\\|")
        rows.append(f"`{usage}` | {verb.help}")
    return "\n".join(rows) + "\n"


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
    "safety.md": {"rights": rights.table},
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
