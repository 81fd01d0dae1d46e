"""Whether the campaign finds each planted bug: run `python -m benchmarks.drills.planted [NAME ...]`.

Plants one bug at a time in a copy of the source, and runs the campaign there, on the kind of rotor that the bug's own
script is about, until it finds the bug or its hours are used up. Prints the table of docs/drills.md; the exit code is 1
where a bug was not found. `--scripts` plays a short script for each bug instead, which tells in a minute whether the
judges can see it.
"""

from __future__ import annotations

import argparse
import sys

from benchmarks.drills.boxes import KINDS
from benchmarks.drills.planted.hunt import CampaignError, copied, hunt, seen
from benchmarks.drills.planted.patch import Bug, Misfit, bugs

HOURS = 5.0
COLUMNS = ("planted bug", "found after", "on")


def main(arguments: list[str] | None = None) -> int:
    options = _parser().parse_args(arguments)
    known = bugs()
    unknown = [name for name in options.names if name not in known]
    if unknown:
        print(f"no bug called {unknown[0]!r}; --list names them all", file=sys.stderr)
        return 2
    chosen = [known[name] for name in options.names] or list(known.values())
    try:
        if options.list:
            for bug in chosen:
                print(f"{bug.name}: {bug.wrong}")
            return 0
        if options.scripts:
            return _play_scripts(chosen)
        return _hunt_all(chosen, hours=options.hours, seed=options.seed, kind=options.kind)
    except (CampaignError, Misfit) as fault:
        print(fault, file=sys.stderr)
        return 2


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.drills.planted", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME", help="the bugs to look for; all, where none is named")
    parser.add_argument("--hours", type=float, default=HOURS, help="simulated hours for each bug, at most")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--kind", choices=list(KINDS), default="", help="on this kind of rotor")
    parser.add_argument("--list", action="store_true", help="say what each bug is, and run nothing")
    parser.add_argument(
        "--scripts", action="store_true", help="play each bug's own script: can its judge see it at all?"
    )
    return parser


def _play_scripts(chosen: list[Bug]) -> int:
    unseen = 0
    for bug, judge in seen(chosen):
        unseen += not judge
        print(f"{bug.name:36} {judge or 'NOT SEEN'}", flush=True)
    print(f"{len(chosen) - unseen} of {len(chosen)} planted bugs seen by their judges")
    return 1 if unseen else 0


def _hunt_all(chosen: list[Bug], *, hours: float, seed: int, kind: str) -> int:
    print(f"{' | '.join(COLUMNS)}\n{'|'.join(['--'] * len(COLUMNS))}", flush=True)
    missed, also_without = 0, dict[str, None]()
    with copied() as sound:
        for bug in chosen:
            each = hunt(bug, sound, hours=hours, seed=seed, kind=kind)
            cells = (f"{each.find.after_h:.2f} h", each.find.kind) if each.find else (f"not in {each.hours:.1f} h",)
            print(bug.name, *cells, sep=" | ", flush=True)
            missed += each.find is None
            also_without |= dict.fromkeys(each.also_without)
    print(f"{len(chosen) - missed} of {len(chosen)} planted bugs found")
    if also_without:
        print(f"not counted, for they show without the planted bug too: {', '.join(also_without)}")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
