"""Whether the campaign finds each planted bug: run `python -m benchmarks.drills.planted [NAME ...]`.

Plants one bug at a time in a copy of the source, and runs the campaign there, on the kind of rotor that the bug's own
script is about, until it finds the bug or its hours are used up. Prints the table of docs/drills.md; the exit code is 1
where a bug was not found. `--scripts` plays a short script for each bug instead,
which tells in a minute whether the judges can see it. `--apply NAME` and `--take-back NAME` change the
checkout itself, for a person who wants to look.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Sequence
from dataclasses import asdict

from benchmarks.drills.boxes import KINDS
from benchmarks.drills.planted.hunt import ROOT, CampaignError, Hunt, copied, hunt, seen
from benchmarks.drills.planted.patch import Bug, Misfit, bugs, plant, take_back

HOURS = 5.0
COLUMNS = ("planted bug", "found after", "on")


def main(arguments: list[str] | None = None) -> int:
    options = _parser().parse_args(arguments)
    known = bugs()
    unknown = [name for name in [*options.names, options.apply, options.take_back] if name and name not in known]
    if unknown:
        print(f"no bug called {unknown[0]!r}; --list names them all", file=sys.stderr)
        return 2
    chosen = [known[name] for name in options.names] or list(known.values())
    try:
        if options.list:
            for bug in chosen:
                print(f"{bug.name}: {bug.wrong}")
            return 0
        if options.apply or options.take_back:
            return _change(known, options.apply, options.take_back)
        if options.scripts:
            return _play_scripts(chosen)
        return _hunt_all(chosen, hours=options.hours, seed=options.seed, kind=options.kind, as_json=options.json)
    except (CampaignError, Misfit) as fault:
        print(fault, file=sys.stderr)
        return 2


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.drills.planted", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME", help="the bugs to look for; all, where none is named")
    parser.add_argument("--hours", type=float, default=HOURS, help="simulated hours for each bug, at most")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--kind", choices=list(KINDS), default="", help="on this kind of rotor")
    parser.add_argument("--json", action="store_true", help="the result as JSON")
    parser.add_argument("--list", action="store_true", help="say what each bug is, and run nothing")
    parser.add_argument(
        "--scripts", action="store_true", help="play each bug's own script: can its judge see it at all?"
    )
    parser.add_argument("--apply", metavar="NAME", help="plant this bug in the checkout itself")
    parser.add_argument("--take-back", metavar="NAME", help="take it out again")
    return parser


def _change(known: dict[str, Bug], planted: str | None, taken_back: str | None) -> int:
    if planted:
        plant(known[planted], ROOT)
        print(f"planted in {', '.join(known[planted].paths)}; --take-back {planted} ends it")
    if taken_back:
        take_back(known[taken_back], ROOT)
        print(f"taken back from {', '.join(known[taken_back].paths)}")
    return 0


def _play_scripts(chosen: list[Bug]) -> int:
    unseen = 0
    for bug, judge in seen(chosen):
        unseen += not judge
        print(f"{bug.name:36} {judge or 'NOT SEEN'}", flush=True)
    print(f"{len(chosen) - unseen} of {len(chosen)} planted bugs seen by their judges")
    return 1 if unseen else 0


def _hunt_all(chosen: list[Bug], *, hours: float, seed: int, kind: str, as_json: bool) -> int:
    hunts: list[Hunt] = []
    if not as_json:
        print(f"{_cells(COLUMNS)}\n{'|'.join(['--'] * len(COLUMNS))}", flush=True)
    with copied() as sound:
        for bug in chosen:
            hunts.append(hunt(bug, sound, hours=hours, seed=seed, kind=kind))
            if not as_json:
                print(_row(hunts[-1]), flush=True)
    missed = [each.bug.name for each in hunts if each.find is None]
    if as_json:
        print(json.dumps([_content(each) for each in hunts], indent=1))
    else:
        print(f"{len(hunts) - len(missed)} of {len(hunts)} planted bugs found")
        if also_without := dict.fromkeys(drawn for each in hunts for drawn in each.also_without):
            print(f"not counted, for they show without the planted bug too: {', '.join(also_without)}")
    return 1 if missed else 0


def _row(each: Hunt) -> str:
    if each.find is None:
        return _cells([each.bug.name, f"not in {each.hours:.1f} h", ""])
    return _cells([each.bug.name, f"{each.find.after_h:.2f} h", each.find.kind])


def _cells(cells: Sequence[str]) -> str:
    return " | ".join(cells).rstrip("| ")


def _content(each: Hunt) -> dict[str, object]:
    found = asdict(each.find) if each.find else None
    return {"bug": each.bug.name, "hours": each.hours, "found": found, "also_without": each.also_without}


if __name__ == "__main__":
    sys.exit(main())
